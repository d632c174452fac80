// The functions of an arm are mission data: their names, parameters and meaning stand in mission.yaml under
// `arm:`, and no name of them in code but the two that are there by default.
//
//   arm:
//     model: arm/arm.urdf
//     poses: arm/poses.yaml
//     module: ef_arm                                # the PDDL module; default: arm
//     functions:                                    # default: arm_move_time, arm_move_energy (pose, pose)
//       move_dur: {parameters: [slot, slot], gives: duration, from: "?1", to: "?2"}
//       carry_energy: {parameters: [module, slot], gives: energy, from: home, to: "?2",
//                      payload: {mass_kg: "?1.mass_kg", size_m: [0.4, 0.4, "?1.z_m"]}}
//
// `?N` is the N-th argument, `?N.key` a property of the object that stands there; a place without a question mark
// is a pose of the mission by its name.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arm_svc/setup.hpp"

namespace roci::mission {
class Entry;
}

namespace roci::arm {

/// Says what a function of the arm returns: seconds or joules.
enum class Quantity { duration, energy };

/// Names a property of the object that stands as an argument; arguments count from 0.
struct ArgumentProperty {
  std::size_t argument = 0;
  std::string key;
};

/// Names a place: an argument (counted from 0), or a pose by name.
using PlaceTerm = std::variant<std::size_t, std::string>;
using NumberTerm = std::variant<double, ArgumentProperty>;

/// Describes the payload that a function assumes.
struct PayloadTerm {
  NumberTerm mass_kg = 0.0;
  std::optional<std::array<NumberTerm, 3>> size_m;  ///< nothing: a point
};

/// Says what a declared function means.
struct ArmFunction {
  std::string name;
  std::vector<std::string> parameters;  ///< types of the arguments
  Quantity gives = Quantity::duration;  ///< s or J
  PlaceTerm from;
  PlaceTerm to;
  std::optional<PayloadTerm> payload = std::nullopt;
};

/// Describes a PDDL module with its functions.
struct ArmModule {
  std::string name = "arm";
  std::vector<ArmFunction> functions;
};

/// Returns the module `arm` with arm_move_time and arm_move_energy, from and to a pose.
ArmModule default_module();

/// Reads `module` and `functions` of the mission's section `arm`. Throws mission::FileError with the place and the
/// remedy: a parameter that the function does not have, a pose that is none of the setup's, a name that is no name
/// of PDDL, a quantity that is neither duration nor energy.
ArmModule read_module(const mission::Entry& arm, const ArmSetup& setup);

}  // namespace roci::arm
