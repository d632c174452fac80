#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim_svc/drive.hpp"
#include "sim_svc/values.hpp"
#include "sim_svc/windows.hpp"

namespace roci::sim {

/// The robot as its components see each other.
struct RobotView {
  Pose pose;
  State nav;
  State arm;
  State camera;
  State gripper;
  State radio;
};

/// What a component may see and change outside itself while it acts.
struct Surroundings {
  const RobotParameters& robot;
  const Ground& ground;
  const std::vector<Window>& windows;
  const RobotView& view;
  std::map<std::string, Image>& images;  ///< on board, by id
  std::vector<Output>& out;
};

/// A command of a component with the arguments that it needs.
struct CommandForm {
  std::string name;
  std::vector<std::string> arguments;
};

/// How a running task ended by itself.
using Ending = std::optional<Failure>;  // empty: it succeeded

}  // namespace roci::sim
