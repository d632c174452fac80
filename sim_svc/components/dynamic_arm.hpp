// This is an arm with dynamics of its own (type `dynamic_arm`): what its moves take is not what was planned.
#pragma once

#include <optional>

#include "sim_svc/components/arm.hpp"
#include "sim_svc/components/driven_motion.hpp"

namespace roci::sim::components {

/// Holds the settings of a dynamic arm (README.md).
struct DynamicArmSettings {
  ArmSettings common;  ///< start_joints has one value for each joint of the arm; `motion` plays no part
  DrivenArmParameters drive;
  JointsWear wear;  ///< at the start
};

/// Simulates an arm whose motions are worked out by its motors, its inertia, its friction, and the load that it
/// truly holds (PayloadHolder), while its controller knows of the told load alone. Joints wear by use and by mishap
/// (JointWear).
class DynamicArm final : public Arm {
 public:
  DynamicArm(DynamicArmSettings, world::RandomStream noise);

  std::optional<std::string> spared_from(const world::Mishap&) const override;
  /// Computes the rest of a running motion anew.
  void suffer(const world::Mishap&, temporal::Time now, world::Surroundings&) override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  /// Returns the wear, too.
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 protected:
  ArmTrace track(const std::vector<world::JointTarget>&, temporal::Time now,
                 const world::ComponentSet&) override;

 private:
  std::size_t moment_at(temporal::Time) const;
  std::optional<Eigen::Index> joint_named(const std::string&) const;

  DrivenArmParameters drive_;
  JointsWear wear_;
  std::optional<DrivenMotion> motion_;
};

}  // namespace roci::sim::components
