// Components of one robot know of each other by what somebody can do, not by who is there. A component
// implements the capabilities that it has; the others find it by them (ComponentSet), whatever its name and
// type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/values.hpp"

namespace roci::sim::world {

/// Moves the body.
class Mobility {
 public:
  virtual ~Mobility() = default;
  /// Returns the name of the place where the body stands; there is none while it moves.
  virtual std::optional<std::string> place() const = 0;
};

/// Carries a tool from pose to pose.
class Manipulator {
 public:
  virtual ~Manipulator() = default;
  /// Returns the name of the pose in which it rests; there is none while it moves.
  virtual std::optional<std::string> pose() const = 0;
};

/// Holds samples.
class SampleHolder {
 public:
  virtual ~SampleHolder() = default;
  virtual std::optional<std::string> held() const = 0;
};

/// Names a sample by where it was collected.
struct SampleOrigin {
  std::string site;
  std::string target;
  bool operator==(const SampleOrigin&) const = default;
};

/// Brings samples to the inlet of a laboratory.
class SampleCarrier {
 public:
  virtual ~SampleCarrier() = default;
  /// Returns the sample that lies in the inlet.
  virtual std::optional<SampleOrigin> delivered() const = 0;
};

/// Describes a load as a tool holds it.
struct Payload {
  double told_kg = 0;            ///< as the robot believes it to be
  double true_kg = 0;            ///< as it is
  std::vector<double> size_m{};  ///< edges of its box along x, y and z of the tool; empty: a point
};

/// Holds a load at the tool of a manipulator.
class PayloadHolder {
 public:
  virtual ~PayloadHolder() = default;
  virtual std::optional<Payload> payload() const = 0;
};

/// Has a say in whether the body may move.
class BodyInterlock {
 public:
  virtual ~BodyInterlock() = default;
  /// Says why the body must stand still; it may move if there is no reason.
  virtual Ending forbids_driving() const = 0;
};

/// Has a say in whether manipulators may move.
class ManipulatorInterlock {
 public:
  virtual ~ManipulatorInterlock() = default;
  /// Says why manipulators must stand still; they may move if there is no reason.
  virtual Ending forbids_reaching() const = 0;
};

}  // namespace roci::sim::world
