#include "ground_console/cli/plan_values.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/temporal/function_values.hpp"
#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/table.hpp"

namespace roci::console::cli {
namespace {

// What the names are compared by; numbers and times stay in the message.
std::vector<temporal::FunctionValueUse> names_of(const std::vector<v1::FunctionValueUse>& uses) {
  std::vector<temporal::FunctionValueUse> out;
  for (const v1::FunctionValueUse& use : uses) {
    temporal::FunctionValueUse& names = out.emplace_back();
    names.function = use.function();
    names.arguments = use.arguments();
  }
  return out;
}

std::vector<std::string> objects_of(const v1::PlanActivity& activity) {
  std::vector<std::string> out;
  const auto& arguments = activity.arguments().empty() ? arguments_of(activity) : activity.arguments();
  for (const v1::Property& argument : arguments) out.push_back(argument.value());
  return out;
}

const char* name_of(v1::FunctionAccuracy accuracy) {
  switch (accuracy) {
    case v1::ACCURACY_EXACT:
      return "exact";
    case v1::ACCURACY_LOWER_BOUND:
      return "lower bound";
    case v1::ACCURACY_ESTIMATE:
      break;
  }
  return "estimate";
}

std::string unit_of(const lib::MissionView& view, const v1::FunctionValueUse& use) {
  for (const auto& [key, offer] : view.offers()) {
    if (offer.owner() != use.owner()) continue;
    for (const v1::FunctionSignature& function : offer.functions())
      if (function.name() == use.function()) return function.unit();
  }
  return "";
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

bool has_begun(const lib::MissionView& view, const v1::PlanActivity& activity) {
  const v1::StepStatus* step = view.step(activity.id());
  return step != nullptr && step->state() != v1::ACTIVITY_WAITING;
}

std::int64_t age_us(const lib::MissionView& view, const v1::FunctionValueUse& use) {
  return std::max<std::int64_t>(0, view.now_us() - use.computed_us());
}

std::string version_text(const PlanValue& value) {
  const std::string used = std::to_string(value.use.model_version());
  return value.is_older() ? used + ", now " + std::to_string(value.version_now) : used;
}

}  // namespace

std::vector<PlanValue> values_of(const lib::MissionView& view, const v1::PlanActivity& activity) {
  std::vector<PlanValue> out;
  if (view.plan() == nullptr) return out;
  const auto& uses = view.plan()->function_values();
  for (const std::size_t i : temporal::function_values_of(objects_of(activity), names_of(uses)))
    out.push_back({uses[i], view.model_version(uses[i].owner())});
  return out;
}

bool stands_on_older_values(const lib::MissionView& view, const v1::PlanActivity& activity) {
  return !has_begun(view, activity) && std::ranges::any_of(values_of(view, activity), &PlanValue::is_older);
}

std::string older_values_text(const lib::MissionView& view) {
  if (view.plan() == nullptr) return "";
  std::map<std::string, std::set<std::uint64_t>> used;  // versions by owner
  std::string example;
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    if (!stands_on_older_values(view, activity)) continue;
    if (example.empty()) example = activity.id();
    for (const PlanValue& value : values_of(view, activity))
      if (value.is_older()) used[value.use.owner()].insert(value.use.model_version());
  }
  std::string out;
  for (const auto& [owner, versions] : used) {
    std::string text;
    for (const std::uint64_t version : versions) text += (text.empty() ? "" : ", ") + std::to_string(version);
    out += "\n* stands on values of version " + text + " of " + owner + "'s model, which has version " +
           std::to_string(view.model_version(owner)) + " now; roci plan --why " + example + " shows them\n";
  }
  return out;
}

std::vector<const v1::PlanActivity*> activities_named(const lib::MissionView& view, const std::string& name) {
  std::vector<const v1::PlanActivity*> by_id, by_name;
  if (view.plan() == nullptr) return by_id;
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    if (activity.id() == name) by_id.push_back(&activity);
    if (activity.name() == name) by_name.push_back(&activity);
  }
  return by_id.empty() ? by_name : by_id;
}

std::string values_text(const lib::MissionView& view,
                        const std::vector<const v1::PlanActivity*>& activities) {
  std::string out;
  for (const v1::PlanActivity* activity : activities) {
    out += (out.empty() ? "" : "\n") + activity->id() + " (" + activity->name() + " " +
           joined(objects_of(*activity), " ") + ")\n";
    const auto values = values_of(view, *activity);
    if (values.empty()) {
      out += "  stands on no value of an external function\n";
      continue;
    }
    std::vector<std::vector<std::string>> rows{
        {"FUNCTION", "OF", "VALUE", "ACCURACY", "SAID BY", "MODEL", "COMPUTED", "AGE"}};
    for (const PlanValue& value : values) {
      const v1::FunctionValueUse& use = value.use;
      const std::string unit = unit_of(view, use);
      rows.push_back({use.function(), joined(use.arguments(), " "),
                      lib::value_text(use.number()) + (unit.empty() ? "" : " " + unit),
                      name_of(use.accuracy()), use.owner(), version_text(value),
                      lib::clock_text(use.computed_us()), lib::clock_text(age_us(view, use))});
    }
    out += table_text(rows);
  }
  return out;
}

nlohmann::json values_json(const lib::MissionView& view, const v1::PlanActivity& activity) {
  nlohmann::json out = nlohmann::json::array();
  for (const PlanValue& value : values_of(view, activity)) {
    const v1::FunctionValueUse& use = value.use;
    out.push_back({{"function", use.function()},
                   {"arguments", use.arguments()},
                   {"value", use.number()},
                   {"unit", unit_of(view, use)},
                   {"accuracy", name_of(use.accuracy())},
                   {"owner", use.owner()},
                   {"model_version", use.model_version()},
                   {"model_version_now", value.version_now},
                   {"computed_us", use.computed_us()},
                   {"age_s", static_cast<double>(age_us(view, use)) / 1e6}});
  }
  return out;
}

}  // namespace roci::console::cli
