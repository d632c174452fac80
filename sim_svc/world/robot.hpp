// A robot is a body with components, each with its running task. It decides which commands its components
// take up, ends their tasks, and settles the energy that they use.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"
#include "sim_svc/world/reporter.hpp"

namespace roci::sim::world {

/// Names the command that every component takes: its running task is broken off, and nothing else happens.
inline constexpr char kStopCommand[] = "stop";

/// Says how often the robot's numbers are reported, in s.
struct TelemetryParameters {
  double moving_s = 10;  ///< while something moves
  double idle_s = 60;
};

/// Describes a battery, what draws from it, and how full it is at the start.
struct PowerSetup {
  PowerParameters parameters;
  double start_j = 0;
};

/// Makes the component with its own source of noise.
using MakeComponent = std::function<std::unique_ptr<Component>(RandomStream noise)>;

/// Says how one component of a robot is made.
struct ComponentSetup {
  std::string name;
  std::string type;
  MakeComponent make;
};

/// Says what a robot is made of.
struct RobotSetup {
  std::string name;
  std::optional<Pose> pose;         ///< empty: it stands nowhere on the map
  std::optional<PowerSetup> power;  ///< empty: its power never ends
  TelemetryParameters telemetry;
  std::vector<ComponentSetup> components;
  std::optional<ThermalParameters> thermal{};  ///< empty: it is warm enough everywhere
  std::optional<double> data_bytes{};          ///< room for data products; empty: it makes none
};

/// Describes a command that a component took up; bench/kill counts these.
struct Begun {
  temporal::Time at{};
  std::string robot;
  std::string component;
  Task task;
};

/// Holds what of a robot outlives the process that speaks for it.
struct RobotMemory {
  std::optional<Pose> pose;
  std::optional<double> energy_j;       ///< in its battery
  std::map<std::string, Image> images;  ///< on board or sent, by id
  std::map<std::string, Memory> components;
  std::map<std::string, double> temperatures_k{};  ///< by thermal zone
  DataMemory data{};
};

/// Runs the tasks of one robot's components; the world calls it in order of time.
class Robot {
 public:
  /// Makes a robot; `first` says that it is the first one of the world. Its first component of a type draws
  /// from the stream named as the type; all other streams also have the component's or the robot's name.
  Robot(RobotSetup, bool first, std::uint64_t seed);

  const std::string& name() const { return name_; }
  /// Returns where it stands on the map, if it does, at the time up to which it was settled.
  const std::optional<Pose>& pose() const { return body_.pose; }
  std::string component_names() const;  ///< "nav, arm, …"
  bool runs(const TaskKey&) const;
  /// Returns it as of the time up to which the robot was settled.
  RobotMemory memory(temporal::Time now) const;
  /// Restores a memory of `at`, before the first task.
  void restore(const RobotMemory&, temporal::Time at);
  /// Returns whether it has sent data that are not received yet.
  bool has_data_under_way() const;
  /// Returns when a task ends or numbers are due.
  temporal::Time next_change() const;
  /// Returns when the battery will be empty if everything goes on at its peak power, or nothing if never.
  std::optional<temporal::Time> flat_at(temporal::Time now) const;

  // All that follows happens at `now`, up to which the robot has been settled; its reports go to `out`.

  /// Takes the command up or refuses it. Returns whether a task began.
  bool begin(const std::string& component, const Task&, temporal::Time now, Environment&, Outputs& out);
  /// Breaks the task off if it runs.
  void halt(const TaskKey&, TaskStage, const Failure& why, temporal::Time now, Environment&, Outputs& out);
  /// Goes on with the task if it waits for an answer.
  void answer(const TaskKey&, const Answer&, temporal::Time now, Environment&, Outputs& out);
  /// Lets every task end or change whose time it is.
  void finish_due(temporal::Time now, Environment&, Outputs& out);
  /// Lets every component do what it does of its own accord.
  void run_routines(temporal::Time now, Environment&, Outputs& out);
  void break_component(const std::string& component, temporal::Time until, temporal::Time now, Environment&,
                       Outputs& out);
  void slow_component(const std::string& component, double pace, temporal::Time until, temporal::Time now,
                      Environment&, Outputs& out);
  void hollow_success(const std::string& component, const std::string& command);
  void ground_changed(temporal::Time now, Environment&, Outputs& out);
  void lose_energy(double joules);
  /// Leaves no more than this in the battery.
  void drop_energy(double to_j);
  void set_surroundings(double kelvin, temporal::Time now, Environment&, Outputs& out);
  void add_heat(const std::string& zone, double joules, temporal::Time now, Environment&, Outputs& out);
  void change_rate(const std::string& component, double factor, temporal::Time now);
  /// Tells components that windows or heat differ from what could be foreseen.
  void surroundings_changed(temporal::Time now, Environment&, Outputs& out);
  void heed(const DownlinkSchedule&);
  /// Lets the panel give this share of its modelled power until then.
  void lose_generation(double share, temporal::Time until);
  void suffer(const Mishap&, temporal::Time now, Environment&, Outputs& out);

  /// Settles energy and body over [from, to], at most a tick long, with the tasks as they run.
  void settle(temporal::Time from, temporal::Time to, Environment&, Outputs& out);

  void report_components(temporal::Time now, Reporter&, Outputs& out) const;
  void report_things(temporal::Time now, Reporter&, Outputs& out);
  /// Reports the numbers if a task has ended since the last time, or the telemetry's period is over.
  void report_numbers_if_due(temporal::Time now, Reporter&, Outputs& out);
  /// Lets the next numbers come within the telemetry's period if something has begun to move.
  void hasten_numbers(temporal::Time now);

 private:
  struct Running {
    TaskKey key;
    temporal::Time since{};
    double energy_j = 0;
  };
  struct Part {
    std::string name;
    std::unique_ptr<Component> component;
    std::optional<Running> running;
    temporal::Time out_of_order_until{};
    std::optional<std::uint64_t> states_reported{};  // their version
  };

  Part* part(std::string_view name);
  Part* part_that_runs(const TaskKey&);
  Surroundings around(Environment& environment, Outputs& out) {
    return {name_, environment, body_, components_, out};
  }
  void note_effects(const Part&, const TaskKey& cause, temporal::Time now, Surroundings&);
  void break_off(Part&, TaskStage, const Failure& why, temporal::Time now, Environment&, Outputs& out);
  void conclude(Part&, TaskStage, const Failure& why, std::map<std::string, temporal::Value> values,
                temporal::Time now, Outputs& out);
  Ending refusal_of(const Part&, const Task&) const;
  bool flat() const { return body_.battery && body_.battery->flat(); }
  bool moves() const;

  double heaters_j(temporal::Time from, temporal::Time to);
  void leave_behind(Outputs& out);

  std::string name_;
  Body body_;
  std::optional<PowerParameters> power_;
  double generation_ = 1;  // share of the modelled power, until dim_until_
  temporal::Time dim_until_{};
  TelemetryParameters telemetry_;
  std::vector<Part> parts_;
  ComponentSet components_;
  bool task_ended_ = false;  // since its numbers were last reported
  temporal::Time next_report_{};
};

}  // namespace roci::sim::world
