// A world of robots is a functional core: commands and the time go in, reports, observations and products
// come out. Between events everything is a function of time (a drive and a motion of an arm are worked out
// whole when they start), so results do not depend on how advance() is sliced. The rules for commands (keys,
// epochs, queries) are not its business: whoever owns the robots keeps them (services/owner).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_svc/world/disturbance.hpp"
#include "sim_svc/world/robot.hpp"

namespace roci::sim::world {

/// Says what a world is made of.
struct WorldSetup {
  Ground ground;
  std::vector<Window> windows;
  std::vector<RobotSetup> robots;
};

/// Holds a task for a component.
struct Order {
  std::string robot;  ///< empty: the only one
  std::string component;
  Task task;
};

/// Holds what of a world outlives the process that simulates it, as a robot outlives the one that speaks for
/// it. Disturbances of the ground are no part of it: whoever caused them causes them again.
struct WorldMemory {
  temporal::Time at{};
  std::map<std::string, RobotMemory> robots;
  std::map<std::string, std::string> samples;  ///< as in Environment
};

/// Holds the true state of all robots and of what they share.
class World {
 public:
  /// Makes the world. Throws std::invalid_argument when two robots, or two components of one, have the same
  /// name.
  World(WorldSetup, std::uint64_t seed);

  // Each of these first brings the world to `now`, which never lies before the `now` of an earlier call.
  // advance(0) gives the first observation of every timeline.
  Outputs advance(temporal::Time now);
  /// The component takes the task up or refuses it; the command `stop` breaks off what it runs.
  Outputs begin(temporal::Time now, const Order&);
  /// Breaks the task off, if it runs; it ends in `stage`, for the reason given.
  Outputs halt(temporal::Time now, const TaskKey&, TaskStage stage, const Failure& why);
  /// Takes what another service says to a PathWanted or MotionWanted; it is ignored unless the task still
  /// waits for it.
  Outputs answer(temporal::Time now, const TaskKey&, const Answer&);
  /// Applies a disturbance. One that names a robot or a component that is not there changes nothing.
  Outputs disturb(temporal::Time now, const Disturbance&);

  /// Lets the robot send its data as the schedule says from now on. One of a robot that is not there changes nothing.
  Outputs heed(temporal::Time now, const DownlinkSchedule&);

  WorldMemory memory() const;
  /// Goes on from an earlier world's memory; robots that it does not know stay as they are. Before the first advance().
  void restore(const WorldMemory&);

  bool runs(const TaskKey&) const;
  /// Returns a time before which nothing leaves the world by itself. It may turn out that nothing happens
  /// then, either.
  std::optional<temporal::Time> next_change() const;

  /// Returns whether data were sent that are not received yet.
  bool has_data_under_way() const;

  /// Returns the commands that components took up since the last call, in order.
  std::vector<Begun> take_begun() { return std::exchange(begun_, {}); }
  /// Returns what the components have done since the last call, in order.
  std::vector<Effect> take_effects() { return std::exchange(environment_.effects, {}); }

 private:
  void advance_to(temporal::Time now);
  void settle(temporal::Time t);
  void publish(temporal::Time t);
  void apply(temporal::Time now, const Disturbance&);
  Outputs done(temporal::Time now);
  temporal::Time next_tick() const;
  temporal::Time next_event() const;
  Robot* robot(const std::string& name);
  std::string robot_names() const;

  Environment environment_;
  std::vector<Robot> robots_;
  std::vector<Begun> begun_;
  Reporter reporter_;
  temporal::Time now_{};  // of the last event
  Outputs out_;
};

}  // namespace roci::sim::world
