// The ground's door to a running mission: an observer that fills a MissionView and sends goals.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "ground_console/lib/mission_view.hpp"
#include "services/connection.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::console {

// Where to join: what the command line and the environment say, else the one mission that runs on this
// machine. Throws std::runtime_error when none or several run, with the remedy.
services::Connection choose_run(const services::ConnectionFlags& flags);

class Client {
 public:
  explicit Client(const services::Connection& connection);

  const MissionView& view() const { return view_; }

  // Handles what comes until `done` or for at most `limit` of wall time; returns whether `done`.
  bool wait(const std::function<bool()>& done, std::chrono::milliseconds limit);

  // Sends a goal and waits for exec_svc's answer, which stands in its journal then; nothing if none came in
  // time.
  std::optional<v1::GoalStatus> send_goal(const v1::Goal& goal, std::chrono::milliseconds limit);

  // Waits until the mission's state has come down (late joiners get the newest of everything).
  bool wait_for_mission(std::chrono::milliseconds limit);

 private:
  template <class T>
  void follow(const services::Topic<T>& topic);

  MissionView view_;
  services::Node node_;
  services::Publisher<v1::Goal> goals_;
};

}  // namespace roci::console
