// The world, its robots and their components hand each other these plain values.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"
#include "core/terrain/grid.hpp"
#include "sim_svc/world/data_store.hpp"

namespace roci::sim::world {

/// Says where a body stands: metres in the map frame, radians from east towards north.
struct Pose {
  double x = 0;
  double y = 0;
  double heading = 0;
  bool operator==(const Pose&) const = default;
};

/// Names one task for good; the world itself only compares it.
struct TaskKey {
  std::string activity;
  std::uint32_t attempt = 0;
  std::string commander{};  ///< empty where commanders are not told apart
  std::uint64_t epoch = 0;  ///< commander's epoch when it first issued the command
  auto operator<=>(const TaskKey&) const = default;
};

/// Describes one command as a component runs it.
struct Task {
  TaskKey key;
  std::string command;
  std::map<std::string, std::string> arguments;
  /// Bounds a repair: a component that repairs something by itself is done with it by then (R146). Empty:
  /// there is no bound.
  std::optional<temporal::Time> latest_end{};
};

/// Says why something did not succeed, by a stable code and plain words.
struct Failure {
  std::string code;
  std::string reason;
  bool operator==(const Failure&) const = default;
};

/// Says how a running task ended by itself; it succeeded if this is empty.
using Ending = std::optional<Failure>;

/// Says what became of a task. One that is `repairing` (R146) goes on while its component deals with a
/// trouble.
enum class TaskStage { accepted, rejected, repairing, completed, failed, cancelled };

/// Holds the results of a task that ran and ended.
struct Results {
  temporal::Duration duration{};                  ///< runs from its begin to its end
  double energy_j = 0;                            ///< that its component used for it
  std::map<std::string, temporal::Value> values;  ///< go by name, as the component has them
  bool operator==(const Results&) const = default;
};

/// Describes something physical that a component has just done: a motion that began, an image that was taken, a
/// sample that was picked. It does not come again by being asked for twice.
struct PhysicalEffect {
  std::string kind;
  std::string object;  ///< that it was done to
};

/// Holds such an effect with its cause. All effects in a world are reported, whoever sent the command: they show
/// what an owner's rules let pass, not what the owner was asked for (bench/kill counts them).
struct Effect {
  temporal::Time at{};
  std::string robot;
  std::string component;
  PhysicalEffect effect;
  TaskKey cause;
};

// These leave the world. All values carry the exact time at which they came about.

/// Holds the newest word on a task; the last one has a stage other than `accepted` and `repairing`.
struct TaskReport {
  TaskKey key;
  TaskStage stage = TaskStage::accepted;
  std::string code;
  std::string reason;
  temporal::Time at{};
  std::optional<Results> results{};  ///< set for a task that ran and ended
  bool operator==(const TaskReport&) const = default;
};

/// Holds a timeline's new value; `timeline` is its whole name, `<robot>.<…>`, or that of a window.
struct Observed {
  std::string timeline;
  temporal::Value value;
  temporal::Time at{};
  bool ended = false;  ///< what it is about is forgotten; nothing more will be said of it
  bool operator==(const Observed&) const = default;
};

/// Describes an image that a robot has taken.
struct Image {
  std::string id;
  std::string robot;
  std::string source;  ///< activity that took it
  std::uint64_t bytes = 0;
  bool sent = false;
  temporal::Time taken{};
  Pose taken_from;
  std::vector<std::uint8_t> preview;  ///< binary PGM file
  /// `image`: on board, until it is sent; `panorama`: a view that the robot takes for itself, which is not kept.
  std::string kind = "image";
  bool operator==(const Image&) const = default;
};

/// Describes a rock that no map shows, met by a robot; all robots know it by the same id.
struct RockSeen {
  std::string id;
  std::string robot;
  double x = 0;       ///< m
  double y = 0;       ///< m
  double radius = 0;  ///< m
  temporal::Time at{};
  bool own_map = false;  ///< it goes on the robot's own map alone, and not on everybody's
  bool operator==(const RockSeen&) const = default;
};

/// Describes ground that a robot has measured and that somebody must not drive over, as a circle.
struct SoilMarked {
  std::string id;
  std::string robot;  ///< robot that has found it
  std::string instrument;
  std::string judged_for;  ///< who must not go there
  double x = 0;            ///< m
  double y = 0;            ///< m
  double radius = 0;       ///< m
  temporal::Time at{};
  bool own_map = false;  ///< as of RockSeen
  bool operator==(const SoilMarked&) const = default;
};

/// Says that a drive waits for way-points (World::answer with a Way or a Failure).
struct PathWanted {
  TaskKey key;
  std::string service;  ///< who is asked
  std::string robot;
  Pose from;
  double x = 0;  ///< m
  double y = 0;  ///< m
  bool operator==(const PathWanted&) const = default;
};

/// Says that a move of an arm waits for a trajectory (World::answer with a Trajectory or a Failure).
struct MotionWanted {
  TaskKey key;
  std::string service;  ///< who is asked
  std::string robot;
  std::string from;                      ///< pose by name
  std::vector<double> joints;            ///< say where the arm stands, rad or m
  std::string to;                        ///< pose by name
  double payload_kg = 0;                 ///< that the tool holds, as the robot believes it to be
  std::vector<double> payload_size_m{};  ///< edges of its box along x, y and z of the tool; empty: a point
  bool operator==(const MotionWanted&) const = default;
};

/// Holds one output of the world; a Product says what has become of it by now.
using Output =
    std::variant<TaskReport, Observed, Image, RockSeen, PathWanted, MotionWanted, Product, SoilMarked>;
using Outputs = std::vector<Output>;

// Other services answer a component's wish with these.

/// Holds the way-points of a drive, in metres, the place itself the last one.
struct Way {
  std::vector<terrain::Point> points;
};

/// Holds a commanded point of a joint-space trajectory: seconds since its start, rad (or m) per joint.
struct JointTarget {
  double time_s = 0;
  std::vector<double> joints;
};

/// Holds the points of a motion in ascending order of time.
struct Trajectory {
  std::vector<JointTarget> targets;
};

using Answer = std::variant<Way, Trajectory, Failure>;

}  // namespace roci::sim::world
