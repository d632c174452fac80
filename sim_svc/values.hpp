#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"

namespace roci::sim {

using temporal::Duration;
using temporal::seconds;
using temporal::State;
using temporal::Time;
using temporal::to_seconds;
using temporal::Value;

/// Metres in the map frame, radians from east towards north.
struct Pose {
  double x = 0;
  double y = 0;
  double heading = 0;
  bool operator==(const Pose&) const = default;
};

struct ActivityKey {
  std::string activity;
  std::uint32_t attempt = 0;
  std::string commander{};
  std::uint64_t epoch = 0;  ///< of issue
  auto operator<=>(const ActivityKey& other) const {
    return std::tie(activity, attempt) <=> std::tie(other.activity, other.attempt);
  }
  bool operator==(const ActivityKey& other) const {
    return activity == other.activity && attempt == other.attempt;
  }
};

/// One command as a component runs it.
struct Task {
  ActivityKey key;
  std::string command;
  std::map<std::string, std::string> arguments;
};

/// Why something did not succeed: a stable code and plain words.
struct Failure {
  std::string code;
  std::string reason;
  bool operator==(const Failure&) const = default;
};

enum class Stage { accepted, rejected, completed, failed, cancelled, cancel_failed, unknown };

// What leaves the world. All values carry the exact time at which they came about.

struct Ack {
  ActivityKey key;
  Stage stage = Stage::accepted;
  std::string code;
  std::string reason;
  Time at{};
  std::uint64_t newest_epoch = 0;  ///< known to the owner
  bool refused_epoch = false;      ///< the request came from an older one
  bool operator==(const Ack&) const = default;
};

struct Observed {
  std::string timeline;
  Value value;
  Time at{};
  bool operator==(const Observed&) const = default;
};

struct Image {
  std::string id;
  std::string source;  ///< activity that took it
  std::uint64_t bytes = 0;
  bool sent = false;
  Time taken{};
  Pose taken_from;
  std::vector<std::uint8_t> preview;  ///< kPreviewWidth x kPreviewHeight grey values, rows from the top
  bool operator==(const Image&) const = default;
};

struct RockSeen {
  std::string id;
  double x = 0;
  double y = 0;
  double radius = 0;
  Time at{};
  bool operator==(const RockSeen&) const = default;
};

/// A drive waits for way-points (World::path_found or path_refused).
struct PathWanted {
  ActivityKey key;
  Pose from;
  double x = 0;
  double y = 0;
  bool operator==(const PathWanted&) const = default;
};

/// A move of the arm waits for a trajectory (World::motion_found or motion_refused).
struct MotionWanted {
  ActivityKey key;
  std::string from;
  std::vector<double> joints;  ///< where the arm stands
  std::string to;
  bool operator==(const MotionWanted&) const = default;
};

using Output = std::variant<Ack, Observed, Image, RockSeen, PathWanted, MotionWanted>;

}  // namespace roci::sim
