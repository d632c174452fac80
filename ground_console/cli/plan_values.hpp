// This file shows the values of external functions on which a plan rests: who gave them, from which map or model, and
// how old they are.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {

/// A value of the running plan, and the version that its owner's model has now.
struct PlanValue {
  v1::FunctionValueUse use;
  std::uint64_t version_now = 0;  ///< 0: its owner offers nothing

  bool is_older() const { return use.model_version() < version_now; }
};

/// Those that an activity of the running plan stands on, as its names tell (core/temporal/function_values.hpp), in the
/// order of the plan. None without a plan.
std::vector<PlanValue> values_of(const lib::MissionView& view, const v1::PlanActivity& activity);

/// Whether nobody has begun the activity, and a value that it stands on is older than its owner's model.
bool stands_on_older_values(const lib::MissionView& view, const v1::PlanActivity& activity);

/// The lines under a plan that has such activities: whose model has which version now. Empty if it has none.
std::string older_values_text(const lib::MissionView& view);

/// The activities of the running plan that have this id, or else this name.
std::vector<const v1::PlanActivity*> activities_named(const lib::MissionView& view, const std::string& name);

/// A table of values for each of these activities: function, arguments, value with unit, accuracy, owner, version of
/// its model, when it was computed and how long ago, in mission time.
std::string values_text(const lib::MissionView& view, const std::vector<const v1::PlanActivity*>& activities);
/// An array of objects: function, arguments, value, unit, accuracy, owner, model_version,
/// model_version_now, computed_us, age_s.
nlohmann::json values_json(const lib::MissionView& view, const v1::PlanActivity& activity);

}  // namespace roci::console::cli
