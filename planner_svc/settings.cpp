#include "planner_svc/settings.hpp"

#include "core/mission/mission_file.hpp"

namespace roci::planner {

Settings read_settings(const std::filesystem::path& mission) {
  Settings out;
  const auto planner = roci::mission::load_mission_file(mission).find("planner");
  if (!planner) return out;
  out.function_timeout = temporal::seconds(planner->number_or("function_timeout_s", 20));
  if (const auto simulated = planner->find("simulated")) {
    simulated->allow_only({"base_s", "per_evaluation_s"});
    out.simulated_base_s = simulated->number_or("base_s", out.simulated_base_s);
    out.simulated_per_evaluation_s = simulated->number_or("per_evaluation_s", out.simulated_per_evaluation_s);
  }
  return out;
}

}  // namespace roci::planner
