// The client is the ground's door to a running mission: an observer that fills a MissionView and sends goals.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "ground_console/lib/mission_view.hpp"
#include "services/node.hpp"
#include "services/process/connection.hpp"
#include "services/process/run_record.hpp"
#include "services/publisher.hpp"

namespace roci::console::lib {

/// Reports that there is no run to join.
class NoRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where to join: what the command line and the environment say, else the one mission that runs on this
/// machine; with `launcher`, the process id of a roci-launch, that of its own. Throws NoRun when there is none,
/// std::runtime_error when several run, with the remedy.
services::process::Connection choose_run(const services::process::ConnectionFlags& flags,
                                         std::int64_t launcher = 0);

/// The run that the command line names or that is the only one here; nothing if there is none or a choice. With
/// `launcher`, the process id of a roci-launch, that of its own. Its mission folder stands on this machine.
std::optional<services::process::RunRecord> local_run(const services::process::ConnectionFlags& flags,
                                                      std::int64_t launcher = 0);

/// Waits until the launcher with this process id has published its run. False: the process has ended.
bool wait_for_launcher(std::int64_t pid);

/// As choose_run(), but waits until a mission runs; calls `tell_waiting` once if it has to. Wall time.
services::process::Connection wait_for_run(const services::process::ConnectionFlags& flags,
                                           const std::function<void()>& tell_waiting);

/// Observes a running mission, and sends goals and orders to it.
class Client {
 public:
  explicit Client(const services::process::Connection& connection);

  const MissionView& view() const { return view_; }
  /// Whose mission, plan and steps the view shows (MissionView::look_at).
  void look_at(const std::string& executive) { view_.look_at(executive); }

  /// The run is the one of this launcher: it is over, too, when that process has ended.
  void watch_launcher(std::int64_t pid) { launcher_ = pid; }
  /// Every mission that is looked at has its outcome, or the launcher is gone.
  bool over() const;

  /// Handles what comes until `done` or for at most `limit` of wall time; returns whether `done`.
  bool wait(const std::function<bool()>& done, std::chrono::milliseconds limit);

  /// Sends a goal and waits for exec_svc's answer to this very sample, which stands in its journal then;
  /// nothing if none came in time.
  std::optional<v1::GoalStatus> send_goal(const v1::Goal& goal, std::chrono::milliseconds limit);

  /// Sends an order and tells each stage that this very sample reaches, until it is refused or applied; what
  /// takes longer than `limit` after its last stage is not waited for. Returns the last stage; nothing if no
  /// executive answered.
  std::optional<v1::OrderStatus> send_order(const v1::Order& order,
                                            const std::function<void(const v1::OrderStatus&)>& tell,
                                            std::chrono::milliseconds limit);
  /// Sends an order about the task network and tells each stage that this very sample reaches, until it is refused or
  /// in force; what takes longer than `limit` after its last stage is not waited for. Returns the last stage;
  /// nothing if no planner answered.
  std::optional<v1::NetworkStatus> send_network_order(
      const v1::NetworkOrder& order, const std::function<void(const v1::NetworkStatus&)>& tell,
      std::chrono::milliseconds limit);
  /// Has the newest by planner, issuer and id; without issuer and id which network is in force.
  const std::map<std::tuple<std::string, std::string, std::string>, v1::NetworkStatus>& networks() const {
    return networks_;
  }
  /// Asks a path planner of the mission for a way, in wall time; nothing if none answered, and why. It changes nothing.
  std::optional<v1::PathReply> find_path(Place from, Place to, const std::string& service,
                                         std::chrono::milliseconds limit, std::string& why);

  /// Handles for 300 ms what comes right behind the first sample of a topic: other instances, and in simulated time,
  /// where writers keep several samples of each, newer ones.
  void catch_up();
  /// Waits until nothing that is new to the view has come for `quiet`: services tell their newest state one after the
  /// other, as they are found. Gives up after `limit`.
  void settle(std::chrono::milliseconds quiet = std::chrono::milliseconds(700),
              std::chrono::milliseconds limit = std::chrono::milliseconds(5000));

  /// No other console ever has the same.
  const std::string& name() const { return node_.options().name; }

  /// Waits until the mission's state has come down (late joiners get the newest of everything).
  bool wait_for_mission(std::chrono::milliseconds limit);

 private:
  template <class T>
  void follow(const services::topics::Topic<T>& topic);

  MissionView view_;
  std::int64_t launcher_ = 0;  // 0: none is watched
  services::Node node_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Order> orders_;
  services::Publisher<v1::NetworkOrder> network_orders_;
  std::map<std::tuple<std::string, std::string, std::string>, v1::NetworkStatus> networks_;
  std::vector<v1::NetworkStatus> network_stages_;  // of what this console sent, as they came
};

}  // namespace roci::console::lib
