// A task component is data alone: commands that take time and power and lead from state to state. With it
// somebody else's robot flies without any code.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/hollow_commands.hpp"
#include "sim_svc/components/paced_work.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds a state whose words may hold arguments of the command in braces: going-to ({to}).
struct StateTemplate {
  std::string name;
  std::vector<std::string> arguments;
};

/// Says what a command does with one of the component's numbers.
struct NumberChange {
  double by = 0;             ///< added evenly over the duration
  std::optional<double> to;  ///< the value at the end, instead
};

/// Describes a command of a task component.
struct TaskCommand {
  std::string name;
  std::vector<std::string> arguments{};
  double duration_s = 0;
  double duration_noise = 0;  ///< standard deviation as a share of the duration
  double power_w = 0;         ///< while it runs; negative: it charges the battery
  /// Says by how much, in J, the battery must have risen when it is checked, unless it is full then; else the
  /// task is broken off and fails `no-gain`. 0: it is not checked.
  double gains_j = 0;
  std::optional<double> gains_within_s{};  ///< time of the check since the start; empty: at the end
  std::optional<StateTemplate> during{};   ///< while it runs; empty: the command's name
  std::optional<StateTemplate> then{};     ///< holds when it is done; empty: the state before
  std::optional<StateTemplate> stopped{};  ///< holds when it is broken off; empty: the state before
  std::optional<StateTemplate> failed{};   ///< holds when too little was gained; empty: as when broken off
  std::map<std::string, std::string> needs{};  ///< component → name of the state it must be in at the start
  std::map<std::string, NumberChange> changes{};  ///< go by the name of the number
  /// Maps things, as family.name with arguments in braces (hole.{hole}), to the state that they are left in when
  /// the command is done.
  std::map<std::string, StateTemplate> leaves{};
};

/// Describes a numeric timeline of the component, `<robot>.<component>.<name>`.
struct TaskNumber {
  std::string name;
  double start = 0;
  double resolution = 1e-3;
};

/// Holds the settings of a task component.
struct TaskSettings {
  StateTemplate start{"idle", {}};
  std::vector<TaskCommand> commands;
  std::vector<TaskNumber> numbers;
  std::map<std::string, StateTemplate> things{};  ///< family.name → the state at the start
};

/// Runs the tasks. A task that is broken off leaves the numbers as they are by then; a number set `to` a
/// value has it only at the end.
class TaskComponent final : public world::Component {
 public:
  TaskComponent(TaskSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override;
  std::vector<world::StateForm> state_forms() const override;
  std::vector<world::ThingForm> thing_forms() const override;
  temporal::State state() const override { return state_; }
  bool busy() const override { return run_.has_value(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  /// Delays the end of a running task; what it has done stays done.
  void slow_down(double pace, temporal::Time until, temporal::Time now, world::Surroundings&) override {
    work_.slow_down(pace, until, now);
  }
  void hollow_next(const std::string& command) override { hollow_.add(command); }
  void halt(temporal::Time now, world::Surroundings&) override;
  void settle(temporal::Time now, world::Body&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override;
  bool moves() const override { return run_ && !settings_.commands[run_->command].changes.empty(); }
  std::vector<world::NamedNumber> numbers() const override;
  /// Returns the states of all things that were in one at the start or that tasks have left in one.
  std::vector<world::NamedState> states() const override;
  /// Returns the component's numbers, as the task left them.
  std::map<std::string, temporal::Value> results() const override;
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  struct Run {
    std::size_t command = 0;  // index into the settings
    temporal::State then;
    temporal::State stopped;
    temporal::State failed;
    temporal::State before;
    std::vector<double> numbers_before;
    double energy_before_j = 0;              // in the battery
    std::optional<temporal::Time> gain_due;  // when the battery is looked at, unless the task ends before
    std::map<std::string, temporal::State> leaves;
  };

  TaskSettings settings_;
  temporal::State state_;
  std::vector<double> values_;  // one per number
  std::map<std::string, temporal::State> things_;
  std::optional<Run> run_;
  PacedWork work_;  // of the run
  HollowCommands hollow_;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
