// The robot and its world as a functional core: commands and the time go in, acknowledgements, observations
// and products come out. Between events everything is a function of time (a drive and a motion of the arm are
// worked out whole when they start), so results do not depend on how advance() is sliced. Copyable.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/arm_unit.hpp"
#include "sim_svc/battery.hpp"
#include "sim_svc/camera.hpp"
#include "sim_svc/command_ledger.hpp"
#include "sim_svc/disturbance.hpp"
#include "sim_svc/gripper.hpp"
#include "sim_svc/nav.hpp"
#include "sim_svc/radio.hpp"
#include "sim_svc/reporter.hpp"

namespace roci::sim {

struct WorldSetup {
  RobotParameters robot;
  Ground ground;
  std::vector<Window> windows;
  Pose start;
  std::string arm_pose;
  std::vector<double> arm_joints;
  double battery_j = 0;
};

enum class Action { execute, cancel, query };

struct Request {
  ActivityKey key;
  Action action = Action::execute;
  std::string component;
  std::string command;
  std::map<std::string, std::string> arguments;
  std::uint64_t epoch = 0;  ///< of the commanding executive
};

/// A command that a component took up; what bench/kill counts.
struct Begun {
  Time at{};
  Task task;
};

class World {
 public:
  World(WorldSetup setup, std::uint64_t seed);

  static bool has_component(std::string_view name);
  static std::string component_names();  ///< "nav, arm, ..."

  // Each of these first brings the world to `now`, which never lies before the `now` of an earlier call.
  // advance(0) gives the first observation of every timeline.
  std::vector<Output> advance(Time now);
  std::vector<Output> command(Time now, const Request&);
  std::vector<Output> path_found(Time now, const ActivityKey&, std::vector<terrain::Point> way);
  std::vector<Output> path_refused(Time now, const ActivityKey&, Failure);
  std::vector<Output> motion_found(Time now, const ActivityKey&, const std::vector<JointTarget>&);
  std::vector<Output> motion_refused(Time now, const ActivityKey&, Failure);
  std::vector<Output> disturb(Time now, const Disturbance&);

  /// Nothing leaves the world by itself before this time. It may turn out that nothing happens then, either.
  std::optional<Time> next_change() const;

  const std::vector<Begun>& begun() const { return begun_; }

 private:
  template <class Visit>
  void each(Visit visit) {
    visit(nav_), visit(arm_), visit(camera_), visit(gripper_), visit(radio_);
  }
  template <class Visit>
  void each(Visit visit) const {
    visit(nav_), visit(arm_), visit(camera_), visit(gripper_), visit(radio_);
  }
  // Visits the component of that name; false: there is none.
  template <class Visit>
  bool with(std::string_view component, Visit visit);
  // Fails or cancels the component's running task, if it has one.
  template <class Component>
  void break_off(Component&, Time now, Stage, Failure why);

  void advance_to(Time now);
  void happen(Time t);
  void settle(Time t);
  void publish(Time t, bool numbers);
  void execute(Time now, const Request&);
  void cancel(Time now, const Request&);
  template <class Component>
  void begin(Component&, Time now, const Request&);
  template <class Component>
  void stop_by_command(Component&, Time now, const ActivityKey&);
  bool runs(std::string_view component, const ActivityKey&) const;
  void acknowledge(const ActivityKey&, Stage, std::string code, std::string reason, Time at);
  std::vector<Output> done(Time now);

  RobotView view() const;
  Surroundings surroundings(const RobotView&);
  Time next_tick() const;
  std::optional<Time> next_event() const;
  double peak_power_w() const;
  bool moving() const;

  RobotParameters robot_;
  Ground ground_;
  std::vector<Window> windows_;
  Nav nav_;
  ArmUnit arm_;
  Camera camera_;
  Gripper gripper_;
  Radio radio_;
  Battery battery_;
  std::map<std::string, Image> images_;
  std::map<std::string, ActivityKey, std::less<>> running_;  // by component
  std::map<std::string, Time, std::less<>> faults_;          // by component: until when
  CommandLedger ledger_;
  std::vector<Begun> begun_;
  Reporter reporter_;
  bool task_ended_ = false;  // since the last publish()
  Time now_{};               // of the last event
  Time next_report_{};       // of the numbers
  std::vector<Output> out_;
};

template <class Visit>
bool World::with(std::string_view component, Visit visit) {
  bool found = false;
  each([&](auto& one) {
    if (one.name() != component) return;
    found = true;
    visit(one);
  });
  return found;
}

template <class Component>
void World::break_off(Component& component, Time now, Stage stage, Failure why) {
  const auto running = running_.find(component.name());
  if (running == running_.end()) return;
  component.halt(now);
  acknowledge(running->second, stage, std::move(why.code), std::move(why.reason), now);
  running_.erase(running);
  task_ended_ = true;
}

}  // namespace roci::sim
