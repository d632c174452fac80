#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim_svc/disturbance.hpp"
#include "sim_svc/event_order.hpp"
#include "sim_svc/windows.hpp"

namespace roci::sim {

enum class Importance { hard, optional, opportunistic };

/// A goal that somebody else than the robot publishes during the run.
struct GoalStimulus {
  std::string issuer;
  std::string id;
  std::string kind;
  Importance importance = Importance::optional;
  double utility = 1;
  std::int32_t priority = 0;
  Time opens{};   ///< 0: any time
  Time closes{};  ///< 0: none
  std::vector<std::pair<std::string, std::string>> arguments;
};

/// The issuer takes a goal back.
struct RecallStimulus {
  std::string issuer;
  std::string id;
};

/// The ground knows of an obstacle and tells those who keep a map.
struct HazardStimulus {
  std::string id;
  Rock rock;
};

struct Stimulus {
  Time at{};
  std::variant<GoalStimulus, RecallStimulus, HazardStimulus, Disturbance> what;
};

/// What happens in a run: scenarios/<name>.yaml of a mission.
struct Scenario {
  std::string description;
  Duration duration{};  ///< the run ends here at the latest
  Pose start;
  std::string arm_pose;
  double battery_j = 0;
  std::optional<double> slip;         ///< instead of the mission's
  std::optional<double> image_noise;  ///< instead of the mission's
  std::vector<Rock> rocks;            ///< there from the start, on no map
  std::vector<Window> windows;        ///< true ones where they differ from the predicted
  std::vector<Stimulus> stimuli;      ///< in order of time
  std::vector<ExpectedEvent> expect;  ///< empty: anything may happen
};

}  // namespace roci::sim
