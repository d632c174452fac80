#include "ground_console/cli/executed_table.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "ground_console/cli/levels.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {
namespace {

using nlohmann::json;

std::vector<InLevels<v1::ExecutedActivity>> ordered(const v1::ExecutedPlan& plan) {
  return in_levels(plan.activities(), [](const v1::ExecutedActivity* one) {
    return one->started_us() < 0 ? std::numeric_limits<std::int64_t>::max() : one->started_us();
  });
}

std::string clock_or_blank(std::int64_t time_us) { return time_us < 0 ? "" : lib::clock_text(time_us); }

std::string results_text(const v1::CommandResult& results) {
  std::vector<std::string> words;
  if (std::isfinite(results.energy_j())) words.push_back(lib::value_text(results.energy_j()) + " J");
  for (const v1::NamedValue& value : results.measured())
    words.push_back(value.name() + "=" + lib::value_text(value.held()));
  return joined(words, " ");
}

}  // namespace

std::string executed_table(const v1::ExecutedPlan& plan) {
  std::vector<std::vector<std::string>> rows{
      {"ACTIVITY", "WHAT", "STATE", "STARTED", "ENDED", "TRIES", "BROUGHT", "WHY"}};
  for (const auto& [one, depth] : ordered(plan))
    rows.push_back({std::string(2 * depth, ' ') + one->id(), one->name(), lib::name_of(one->state()),
                    clock_or_blank(one->started_us()), clock_or_blank(one->ended_us()),
                    one->attempts() == 0 ? "" : std::to_string(one->attempts()), results_text(one->results()),
                    one->cause()});
  return "plan " + std::to_string(plan.version()) + ", from " + lib::clock_text(plan.origin_us()) + ": " +
         lib::name_of(plan.outcome()) + (plan.reason().empty() ? "" : " (" + plan.reason() + ")") + "\n\n" +
         table_text(rows);
}

std::string executed_line(const v1::ExecutedActivity& one) {
  const std::string brought = results_text(one.results());
  return printable(one.id() + "  " + lib::name_of(one.state()) + ", " + clock_or_blank(one.started_us()) +
                   " to " + clock_or_blank(one.ended_us()) + (brought.empty() ? "" : ": " + brought) +
                   (one.cause().empty() ? "" : " (" + one.cause() + ")"));
}

json executed_json(const v1::ExecutedActivity& one) {
  json row{{"id", one.id()},
           {"name", one.name()},
           {"level", one.level()},
           {"parent", one.parent()},
           {"robot", one.robot()},
           {"state", lib::name_of(one.state())},
           {"attempts", one.attempts()},
           {"cause", one.cause()}};
  if (one.started_us() >= 0) row["started_s"] = static_cast<double>(one.started_us()) * 1e-6;
  if (one.ended_us() >= 0) row["ended_s"] = static_cast<double>(one.ended_us()) * 1e-6;
  if (std::isfinite(one.results().energy_j())) row["energy_j"] = one.results().energy_j();
  for (const v1::NamedValue& value : one.results().measured())
    row["values"][value.name()] = lib::value_text(value.held());
  return row;
}

json executed_json(const v1::ExecutedPlan& plan) {
  json activities = json::array();
  for (const auto& [one, depth] : ordered(plan)) {
    activities.push_back(executed_json(*one));
  }
  return {{"executive", plan.executive()},
          {"version", plan.version()},
          {"origin_s", static_cast<double>(plan.origin_us()) * 1e-6},
          {"outcome", lib::name_of(plan.outcome())},
          {"reason", plan.reason()},
          {"activities", activities}};
}

}  // namespace roci::console::cli
