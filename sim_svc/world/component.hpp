// A robot is made of components. Each one runs at most one task at a time and answers for its own state,
// numbers and energy; what it knows of the others it learns from their capabilities.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/body.hpp"
#include "sim_svc/world/component_set.hpp"
#include "sim_svc/world/disturbance.hpp"
#include "sim_svc/world/downlink_schedule.hpp"
#include "sim_svc/world/environment.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::world {

/// Holds what a component may see and change outside itself while it acts.
struct Surroundings {
  const std::string& robot;  ///< robot whose part it is
  Environment& environment;
  Body& body;
  const ComponentSet& components;  ///< components of the same robot, itself included
  Outputs& out;
  std::vector<PhysicalEffect> effects{};  ///< what the component does to the world
};

/// Describes a command of a component with the arguments that it needs.
struct CommandForm {
  std::string name;
  std::vector<std::string> arguments;
  std::string instead{};              ///< an argument that may be given in the place of
  std::vector<std::string> spared{};  ///< these of `arguments`

  /// Returns the arguments that are needed beside those given.
  std::vector<std::string> missing(const std::function<bool(const std::string&)>& is_given) const;
};

/// Describes a state timeline beside the component's own, `<robot>.<name>`, of a thing that it handles
/// (sample.soil).
struct NamedState {
  std::string name;
  temporal::State state;
};

/// Describes a state that a component may be in, with how many arguments it has then.
struct StateForm {
  std::string name;
  std::size_t arguments{};
  auto operator<=>(const StateForm&) const = default;
};

/// Describes a state timeline that a component always has beside its own, `<robot>.<name>`.
struct NamedForm {
  std::string name;
  std::vector<StateForm> states;
};

/// Describes a family of state timelines of things that a component handles, `<robot>.<family>.<thing>`.
struct ThingForm {
  std::string family;
  std::vector<StateForm> states;
};

/// Describes a number timeline of the component, `<robot>.<component>.<name>`, reported in steps of
/// `resolution`.
struct NamedNumber {
  std::string name;
  double value = 0;
  double resolution = 1e-3;
};

/// Holds what of a component outlives the process that speaks for it, by names of its own.
using Memory = std::map<std::string, temporal::Value>;

/// Says what the robot asks of each of its parts. begin() is called only while it is not busy; next_change()
/// and finish() only matter while it is. Between calls everything is a function of time, so that results do
/// not depend on how the world is sliced. `stop` needs no code: the robot halts the component.
class Component {
 public:
  virtual ~Component() = default;

  /// Takes in the parts of its robot, itself included, before anything else; they live as long as it does.
  virtual void meet(const ComponentSet&) {}

  virtual std::vector<CommandForm> commands() const = 0;
  /// Returns every state that it can be in; none: it does not say. Who checks a mission reads it.
  virtual std::vector<StateForm> state_forms() const { return {}; }
  /// Returns the families of things whose states it reports.
  virtual std::vector<ThingForm> thing_forms() const { return {}; }
  /// Returns the state timelines beside its own that belong to no family.
  virtual std::vector<NamedForm> named_forms() const { return {}; }
  /// Returns the timelines of the windows without which its tasks fail.
  virtual std::vector<std::string> awaited_windows() const { return {}; }
  /// Returns the value of the timeline `<robot>.<component>`.
  virtual temporal::State state() const = 0;
  virtual bool busy() const = 0;

  /// Begins the task, or says why it cannot. The arguments that commands() names are there.
  virtual Ending begin(const Task&, temporal::Time now, Surroundings&) = 0;
  /// Returns when a running task ends or changes by itself, or nothing while it waits for an answer.
  virtual std::optional<temporal::Time> next_change() const = 0;
  /// Says, at next_change(), how the task ended; if it goes on, the component is still busy().
  virtual Ending finish(Surroundings&) = 0;
  /// Returns when it next does something of its own accord, beside any task; nothing while it does not know.
  virtual std::optional<temporal::Time> next_routine() const { return std::nullopt; }
  /// Does of its own accord what is due. It is called after the tasks at every event of the world, and passes a turn
  /// over while it is not `able` (out of order, battery empty); afterwards next_routine() lies after `now`.
  virtual void run_routine(temporal::Time /*now*/, bool /*able*/, Surroundings&) {}
  /// Slows its tasks to this share of their usual speed until then; it is not called for a component that
  /// cannot be slowed (ComponentType::can_be_slowed).
  virtual void slow_down(double /*pace*/, temporal::Time /*until*/, temporal::Time /*now*/, Surroundings&) {}
  /// Makes the next success of the command hollow: time and energy are used, and nothing else changes. It is not
  /// called for a component that cannot do so (ComponentType::can_be_hollow).
  virtual void hollow_next(const std::string& /*command*/) {}
  /// Takes in which data are to go with which downlink from now on.
  virtual void heed(const DownlinkSchedule&) {}
  /// Sends data at this share of the usual rate from now on; it is not called for a component without a rate
  /// (ComponentType::has_rate).
  virtual void change_rate(double /*factor*/, temporal::Time /*now*/) {}
  /// Breaks the running task off at once.
  virtual void halt(temporal::Time now, Surroundings&) = 0;

  /// Returns whether the task waits for another service (PathWanted, MotionWanted). answer() goes on with
  /// that service's answer, which is no Failure: that one ends the task.
  virtual bool waits_for_answer() const { return false; }
  virtual Ending answer(const Answer&, temporal::Time now, Surroundings&);

  /// Says whether the mishap can befall this component: nothing if it has no things of that kind, else why it cannot
  /// (no such name); that text is empty if it can.
  virtual std::optional<std::string> spared_from(const Mishap&) const { return std::nullopt; }
  /// Suffers a mishap from which it is not spared.
  virtual void suffer(const Mishap&, temporal::Time /*now*/, Surroundings&) {}

  /// Brings what the component says, and the body that it moves, up to `now`.
  virtual void settle(temporal::Time /*now*/, Body&) {}
  /// Returns the thermal zones of the body in which it works. Who checks a mission reads it.
  virtual std::vector<std::string> zones() const { return {}; }
  /// Returns the zone that it keeps warm for work now, whose heater then counts as its task's; empty: none.
  virtual std::string held_zone() const { return {}; }
  /// Takes in that a window, or the heat of the body, differs from now on from what could be foreseen.
  virtual void surroundings_changed(temporal::Time /*now*/, Surroundings&) {}
  /// Takes in that the ground has changed.
  virtual void ground_changed(temporal::Time /*now*/, Surroundings&) {}

  /// Returns what the running task uses in [from, to), in J; if it is negative, it charges the battery.
  virtual double energy_j(temporal::Time /*from*/, temporal::Time /*to*/) const { return 0; }
  /// Returns a power in W that is no less than the task will use at any time.
  virtual double peak_power_w() const { return 0; }

  virtual std::vector<NamedState> states() const { return {}; }
  /// Returns a number that changes when states() does, so that many states are not looked at for nothing. Nothing: it
  /// does not count.
  virtual std::optional<std::uint64_t> states_version() const { return std::nullopt; }
  virtual std::vector<NamedNumber> numbers() const { return {}; }
  /// Returns whether the robot's numbers change quickly now, so that they are reported often.
  virtual bool moves() const { return false; }
  /// Returns named values of the task that finish() has just ended.
  virtual std::map<std::string, temporal::Value> results() const { return {}; }

  /// Returns how the component would stand if its task were broken off now.
  virtual Memory memory() const { return {}; }
  /// Takes up what memory() returned in an earlier process, before the first task. Names that it does not know, and
  /// values that it cannot use, change nothing.
  virtual void restore(const Memory&) {}
};

}  // namespace roci::sim::world
