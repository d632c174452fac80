// Disturbances are what a scenario may do to the world: faults, rocks, losses and changes.
#pragma once
#include <optional>
#include <string>
#include <variant>

#include "sim_svc/world/environment.hpp"

namespace roci::sim::world {

/// Breaks a component: its task fails, and so does every new one until `until`. With a pace its tasks get on until
/// then at this share of their usual speed instead, at 0 not at all.
struct ComponentFault {
  std::string robot;
  std::string component;
  temporal::Time until{};
  std::optional<double> pace{};  ///< 0 … 1; only for a component that can be slowed
};

/// Puts a rock that no map shows there from now on.
struct RockFall {
  Rock rock;
};

/// Lets a soil lie there from now on; the world knows soils of that name.
struct SoilChange {
  SoilArea area;
};

/// Takes energy from the robot's battery at once.
struct EnergyLoss {
  std::string robot;
  double joules = 0;
};

/// Lets the panel give less than its model says, from now until `until`.
struct GenerationLoss {
  std::string robot;
  double share = 1;  ///< of the told power that is left, 0 … 1
  temporal::Time until{};
};

/// Breaks a module for good.
struct ModuleFailure {
  std::string module;
};

/// Blocks a slot, in which nothing can be placed any more; nobody sees that before the slot is localized.
struct SlotBlock {
  std::string slot;
};

/// Makes a joint of an arm move heavily from now on; friction and growth are shares of the joint's effort
/// limit.
struct JointWear {
  std::string joint;
  double friction = 0;  ///< Coulomb friction beside the joint's own
  double growth = 0;    ///< by which it grows for each rad or m of travel
};

/// Lets the walls of a trench fall in.
struct TrenchCollapse {
  std::string site;
  double share = 0.5;  ///< of its depth that is left, 0 … 1
};

/// Names what can go wrong within a component, whichever has the thing that is named.
using Mishap = std::variant<ModuleFailure, SlotBlock, JointWear, TrenchCollapse>;

/// Lets a mishap befall the first component of the robot that has the thing.
struct ComponentMishap {
  std::string robot;
  Mishap what;
};

/// Lets the next success of the command be hollow: nothing but time and energy has changed.
struct HollowSuccess {
  std::string robot;
  std::string component;
  std::string command;
};

/// Leaves no more than this in the robot's battery.
struct EnergyDrop {
  std::string robot;
  double to_j = 0;
};

/// Sets the temperature of the surroundings of all robots from now on.
struct SurroundingsChange {
  double kelvin = 0;
};

/// Heats a thermal zone at once, or, negative, cools it.
struct SuddenHeat {
  std::string robot;
  std::string zone;
  double joules = 0;
};

/// Sets the share of its usual rate at which a component sends from now on.
struct RateChange {
  std::string robot;
  std::string component;
  double factor = 1;  ///< above 0
};

/// Shuts a window until then, as an object before the antenna would.
struct ViewBlock {
  std::string window;
  temporal::Time until{};
};

using Disturbance =
    std::variant<ComponentFault, RockFall, EnergyLoss, GenerationLoss, ComponentMishap, HollowSuccess,
                 EnergyDrop, SurroundingsChange, SuddenHeat, RateChange, ViewBlock, SoilChange>;

/// Returns whether a repetition would add to the effect. What has happened to a robot is part of its world's
/// memory, so such a disturbance does not come again when the simulating process is restarted.
bool adds_up(const Disturbance&);

}  // namespace roci::sim::world
