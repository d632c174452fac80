// This part of the planner takes orders of the ground about the model of an engine that plans all the time:
// networks and values of parameters (R83, R116, R118).
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/network_store_service.hpp"
#include "planner_svc/settings.hpp"
#include "roci_idl/health.h"
#include "roci_idl/network.h"
#include "services/publisher.hpp"

namespace roci::planner {

/// Gives each order once: a repeated key is answered with where the order stands. A message that is wrong in itself
/// (no right to it, cut short, another checksum, too large) is refused here, before the engine sees it. What the
/// engine takes is kept in the run folder before it counts as accepted.
class NetworkOrders {
 public:
  /// Calls `heard` when there is something to take(). Settings and node must outlive this object. If what was
  /// kept cannot be read, the event "planner.network_damaged" says so, and the mission's own model is in
  /// force.
  NetworkOrders(services::Node& node, const Settings& settings, const std::filesystem::path& folder,
                std::function<void()> heard);
  NetworkOrders(const NetworkOrders&) = delete;
  NetworkOrders& operator=(const NetworkOrders&) = delete;

  /// Returns the file of the newest model that was taken, or an empty path if the mission's is in force.
  std::filesystem::path model_file() const;
  /// Takes in that the engine does not take what was kept.
  void give_up_kept(const std::string& why);

  bool waiting() const { return !waiting_.empty(); }
  std::vector<engine::ModelChange> take();
  enum class Model {
    same,
    replaced,  ///< model_file() is another one
    unkept,  ///< the engine has a model that could not be kept: it is refused, and the engine is to be made anew
  };
  /// Takes in what the engine made of the changes that were taken; `last_version` is that of the newest plan
  /// before.
  Model answer(const std::vector<engine::ModelAnswer>& answers, const engine::ModelName& model,
               std::uint32_t last_version);
  /// Takes in that the engine has failed at the changes that were taken.
  void fail(const std::string& why);
  /// Takes in that the executive runs this version of the plan.
  void executed(std::uint32_t version);
  /// Takes in that no plan runs and the engine has none to make: accepted changes are in force without a version
  /// of the plan.
  void nothing_to_plan();

 private:
  using Key = std::pair<std::string, std::string>;  // issuer, id

  void hear(const v1::NetworkOrder& order);
  std::vector<std::string> faults_of(const v1::NetworkOrder& order) const;
  NetworkRecord* record(const Key& key);
  void settle(NetworkRecord& one, NetworkStage stage, std::vector<std::string> reasons);
  std::string keep(const std::string* model);
  void tell(const NetworkRecord& one);
  void tell_model();
  void report(v1::Severity severity, const std::string& code, const std::string& text);

  services::Node& node_;
  const Settings& settings_;
  NetworkStore store_;
  std::function<void()> heard_;
  services::Publisher<v1::NetworkStatus> statuses_;
  services::Publisher<v1::Event> events_;
  KeptNetworks kept_;
  std::map<Key, v1::SampleHeader> headers_;  // of the orders that were heard by this process
  std::vector<engine::ModelChange> waiting_;
  std::vector<engine::ModelChange> taken_;
  engine::ModelName model_;
};

}  // namespace roci::planner
