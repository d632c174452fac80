// The methods of a dedicated executive (R145, R146) say which calls to its subsystems carry out one command, what
// their answers must look like, and what is tried where one fails in a known way.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::dedicated::methods {

/// Holds text in which "{name}" stands for an argument of the command, and "{call.value}" for a value that a call
/// of this run has brought.
using Template = std::string;

/// Names a place: an object of the mission with properties x and y, a robot (where it is observed to stand), or
/// coordinates in metres; of the three one is given. Of a robot it may lie so many metres ahead and to its left.
struct Place {
  Template object{};
  Template robot{};
  Template x{};
  Template y{};
  double ahead_m = 0;
  double left_m = 0;
  bool operator==(const Place&) const = default;
};

/// Commands a subsystem. Brings the results that its owner measured, by their names, and `duration_s`.
struct CommandCall {
  std::string owner;  ///< service that executes it
  Template robot;     ///< has the subsystem; empty: the owner's only one
  std::string subsystem;
  std::string command;
  std::map<std::string, Template> arguments{};
};

/// Asks a path planner for a path. Brings length_m, expected_s, expected_j, map_version, and the first way-point after
/// the start as next_x, next_y. Of its way, without the last `short_m` but never without its first point, it brings the
/// points as text (`way`, core/terrain/way.hpp), and where and how it ends as end_x, end_y and end_heading_rad. All
/// else is of the whole path. A way of more than 256 points is not brought. With `map_told_s` it fails (map-too-old)
/// where, as the answer comes, more than `map_within` has passed since that mission time: when the map of another
/// robot, on which the path stands, was told. Errors: no-path (there is none),
/// path-unknown (none was found), path-invalid.
struct PathCall {
  std::string planner;  ///< service that answers
  Place from;
  Place to;
  double short_m = 0;     ///< measured along the way; not negative
  Template map_told_s{};  ///< empty: it may be of any age
  temporal::Duration map_within{0};
};

/// Tells a place in the frame of a robot: x (ahead) and y (to its left) in metres, bearing_rad (to its left), range_m
/// and heading_rad, the world's heading from the robot to the place; world_x and world_y, where the place is. Error:
/// no-pose, as long as it was never observed.
struct TransformCall {
  Place place;
  Template robot;
};

/// Waits until a timeline has a value, a state or a boolean (true, false); a number is brought as `value`. A call
/// without a state waits until there is any.
struct ObserveCall {
  Template timeline;
  Template state{};
  std::vector<Template> arguments{};
};

/// Lets time pass.
struct WaitCall {
  temporal::Duration time{0};
};

/// A value is right within [least, most].
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool admits(double value) const { return value >= least && value <= most; }
};

/// Describes one low-level operation, awaited before the next one begins.
struct Call {
  std::string name;  ///< unique in its method and that method's repairs
  std::variant<CommandCall, PathCall, TransformCall, ObserveCall, WaitCall> what;
  temporal::Duration within = temporal::seconds(600);  ///< error `call-timeout` after that
  std::map<std::string, Range> check{};  ///< numbers that it must bring; else error `wrong-value`
};

/// Names a state of the executive's own timeline; its name is empty where there is none.
struct Shown {
  std::string name{};
  std::vector<Template> arguments{};
};

/// Describes what is done, within the command's own time, where a call has failed with a certain error
/// (R146).
struct Repair {
  std::vector<Call> calls{};
  std::string then{};         ///< the method's call with which it goes on; empty: the one that failed
  bool ends = false;          ///< the command is carried out when the repair is; `then` is empty
  std::uint32_t at_most = 1;  ///< how often in one run
  Shown shows{};              ///< the executive's state meanwhile; else that of the method
  /// Numbers that timelines must have now, e.g. energy for it; else the error stands.
  std::map<std::string, Range> needs{};
};

/// Says how one command is carried out.
struct Method {
  std::string command;
  std::vector<std::string> arguments{};  ///< that the command must have
  std::vector<Call> calls{};
  /// They go by error, or by "call.error" for that call alone; the latter goes first.
  std::map<std::string, Repair> repairs{};
  std::map<std::string, std::string> results{};  ///< what goes up with its success: "call.value" by name
  Shown during{};                                ///< else the command's name and arguments
  Shown then{};                                  ///< else the executive's state of rest
  /// They go by "call.error" for that call alone, by error, or by "*" for any other;
  /// the first of these that is there counts.
  std::map<std::string, Shown> failed{};
  /// What it says of other timelines in the end, by outcome: "done", or an error as above. Timelines are templates.
  std::map<std::string, std::map<Template, Shown>> tells{};
};

/// Describes all that one dedicated executive can do, on the one timeline that it shows.
struct Methods {
  std::string timeline;
  std::string subsystem;  ///< of the commands that it takes
  Shown rest{"idle", {}};
  std::map<std::string, Method> methods{};  ///< by command
};

}  // namespace roci::dedicated::methods
