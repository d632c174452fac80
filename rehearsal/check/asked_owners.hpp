// The mission's own services run in this process, and are asked for function values as the planner would ask
// them.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/mission/findings.hpp"
#include "core/mission/service_list.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"
#include "planner_svc/function_owners_service.hpp"
#include "services/service.hpp"

namespace roci::rehearsal::check {

/// Runs those services of a mission that are linked here, live over inproc, each on a thread of its own, but no
/// executive and no world: what owns functions answers, and nothing is commanded.
class AskedOwners final : public planner::engine::FunctionSource {
 public:
  /// What a service says against its files goes to `findings`. Throws services::transport::TransportError where
  /// the transport inproc is not installed.
  AskedOwners(const std::filesystem::path& mission, const mission::ServiceList& services,
              const std::string& scenario, mission::Findings& findings);
  ~AskedOwners() override;
  AskedOwners(const AskedOwners&) = delete;
  AskedOwners& operator=(const AskedOwners&) = delete;

  /// The functions that are offered, by module, once those of these modules are or they were awaited in vain.
  const std::map<std::string, std::vector<std::string>>& offered(const std::vector<std::string>& modules);
  /// The call that the next values are wanted for: its robot and objects go to the owners.
  void begin(const planner::engine::Request& request) { request_ = &request; }
  std::vector<planner::engine::FunctionValue> evaluate(std::span<const planner::engine::FunctionCall> calls,
                                                       const std::function<bool()>& cancelled) override;

 private:
  // A service goes before its node.
  struct Seat {
    std::unique_ptr<services::Node> node;
    std::unique_ptr<services::Service> service;
    std::thread thread;
  };

  void seat(const std::filesystem::path& mission, const mission::ServiceEntry& entry,
            const std::string& scenario, mission::Findings& findings);
  void await_offer(const std::string& module_name);

  int domain_;
  std::vector<Seat> seats_;
  std::unique_ptr<services::Node> node_;
  std::map<std::string, std::vector<std::string>> offered_;  // module → its functions
  std::set<std::string> awaited_;                            // modules
  std::unique_ptr<planner::FunctionOwners> owners_;
  const planner::engine::Request* request_ = nullptr;
};

}  // namespace roci::rehearsal::check
