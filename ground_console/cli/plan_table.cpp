#include "ground_console/cli/plan_table.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "core/temporal/schedule.hpp"
#include "ground_console/cli/levels.hpp"
#include "ground_console/cli/plan_values.hpp"
#include "ground_console/cli/table.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::console::cli {
namespace {

using Schedule = std::optional<std::vector<temporal::Duration>>;

// Of a plan that no executive sends: none.
Schedule schedule_of(const v1::Plan& plan) {
  try {
    const temporal::FlexiblePlan from = services::wire::from_wire(plan);
    if (!temporal::check(from).empty()) return std::nullopt;
    return temporal::earliest_schedule(from.point_count, temporal::all_constraints(from));
  } catch (const services::wire::WireError&) {
    return std::nullopt;
  }
}

std::int64_t start_in(const Schedule& schedule, const v1::Plan& plan, const v1::PlanActivity& activity) {
  if (!schedule || activity.start_point() >= schedule->size()) return -1;
  return plan.origin_us() + (*schedule)[activity.start_point()].count();
}

std::string arguments_text(const v1::PlanActivity& activity) {
  std::vector<std::string> words;
  for (const v1::Property& argument : arguments_of(activity))
    words.push_back(argument.name().empty() ||
                            std::isdigit(static_cast<unsigned char>(argument.name()[0])) != 0
                        ? argument.value()
                        : argument.name() + "=" + argument.value());
  return joined(words, " ");
}

std::string window_of(const v1::StepStatus* step) {
  if (step == nullptr || step->state() != v1::ACTIVITY_WAITING) return "";
  const std::string from = lib::clock_text(step->earliest_start_us());
  const bool open = step->latest_start_us() < 0 || step->latest_start_us() >= std::int64_t{1} << 60;
  return from + "–" + (open ? "" : lib::clock_text(step->latest_start_us()));
}

std::string executed_of(const v1::StepStatus* step) {
  if (step == nullptr || step->started_us() < 0) return "";
  return lib::clock_text(step->started_us()) + "–" +
         (step->ended_us() < 0 ? "" : lib::clock_text(step->ended_us()));
}

// Of an action that was bound to commands the wire has the objects by their positions,
// and the commands say the same in words.
bool is_bound(const v1::PlanActivity& activity) {
  return !activity.commands().empty() && !activity.arguments().empty() &&
         activity.arguments().front().name() == "1";
}

std::string duration_of(const v1::PlanActivity& activity) {
  const std::int64_t tenths = activity.duration_lower_us() / 100'000;
  return lib::value_text(static_cast<double>(tenths) / 10) + " s";
}

}  // namespace

const std::vector<v1::Property>& arguments_of(const v1::PlanActivity& activity) {
  const bool own = !is_bound(activity) && (!activity.arguments().empty() || activity.commands().empty());
  return own ? activity.arguments() : activity.commands().front().arguments();
}

bool has_levels(const v1::Plan& plan) {
  return std::ranges::any_of(plan.activities(), [](const v1::PlanActivity& activity) {
    return !activity.level().empty() || !activity.parent().empty();
  });
}

std::string robot_of(const lib::MissionView& view, const v1::PlanActivity& activity) {
  for (const v1::PlanCommand& command : activity.commands()) {
    if (!command.robot().empty()) return command.robot();
    const auto owner = view.services().find(command.owner());
    if (owner != view.services().end() && !owner->second.robot().empty()) return owner->second.robot();
  }
  return "";
}

std::int64_t planned_start_us(const v1::Plan& plan, const v1::PlanActivity& activity) {
  return start_in(schedule_of(plan), plan, activity);
}

std::string plan_table(const lib::MissionView& view) {
  if (!view.plan()) return "no plan yet\n";
  const v1::Plan& plan = *view.plan();
  const Schedule schedule = schedule_of(plan);
  std::set<std::string> robots;
  for (const v1::PlanActivity& activity : plan.activities()) robots.insert(robot_of(view, activity));
  robots.erase("");
  const bool layered = has_levels(plan), several = robots.size() > 1;
  std::vector<std::string> head{"ACTIVITY"};
  if (layered) head.emplace_back("LEVEL");
  if (several) head.emplace_back("ROBOT");
  for (const char* column : {"WHAT", "ARGUMENTS", "STATE", "PLANNED", "TAKES", "WINDOW", "EXECUTED", "GOALS"})
    head.emplace_back(column);
  std::vector<std::vector<std::string>> rows{std::move(head)};
  for (const auto& [activity, depth] : in_levels(
           plan.activities(), [&](const v1::PlanActivity* one) { return start_in(schedule, plan, *one); })) {
    const v1::StepStatus* step = view.step(activity->id());
    const std::int64_t start = start_in(schedule, plan, *activity);
    std::string state = step == nullptr ? "waiting" : lib::name_of(step->state());
    if (stands_on_older_values(view, *activity)) state += " *";
    std::vector<std::string> row{std::string(2 * depth, ' ') + activity->id()};
    if (layered) row.push_back(activity->level());
    if (several) row.push_back(robot_of(view, *activity));
    for (std::string cell : {activity->name(), arguments_text(*activity), std::move(state),
                             start < 0 ? "" : lib::clock_text(start), duration_of(*activity), window_of(step),
                             executed_of(step), joined(activity->goals_served(), ", ")})
      row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  return "plan " + std::to_string(plan.version()) + ", from " + lib::clock_text(plan.origin_us()) + ", now " +
         lib::clock_text(view.now_us()) + "\n\n" + table_text(rows) + older_values_text(view);
}

}  // namespace roci::console::cli
