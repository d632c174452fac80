#include "ground_console/cli/timelines.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::console::cli {
namespace {

temporal::Progress progress_of(const lib::MissionView& view) {
  temporal::Progress out;
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    const v1::StepStatus* step = view.step(activity.id());
    if (step == nullptr) continue;
    temporal::ActivityProgress& at = out[activity.id()];
    at.state =
        static_cast<temporal::ActivityState>(std::min<std::uint32_t>(step->state(), v1::ACTIVITY_CANCELLED));
    if (step->started_us() >= 0) at.started = temporal::Time(step->started_us());
    if (step->ended_us() >= 0) at.ended = temporal::Time(step->ended_us());
  }
  return out;
}

temporal::ObservedValues observed_of(const lib::MissionView& view) {
  temporal::ObservedValues out;
  for (const auto& [name, observation] : view.timelines())
    out[name] = {temporal::Time(observation.sampled_us()), services::wire::from_wire(observation.observed())};
  return out;
}

double seconds_of(temporal::Time time) { return temporal::to_seconds(time); }

}  // namespace

Timelines timelines_of(const lib::MissionView& view, const std::vector<std::string>& names) {
  Timelines out;
  const temporal::ObservedValues observed = observed_of(view);
  if (view.plan()) {
    const temporal::FlexiblePlan plan = services::wire::from_wire(*view.plan());
    if (temporal::check(plan).empty())
      out = temporal::project(plan, progress_of(view), temporal::Time(view.now_us()), {}, observed);
  }
  for (const auto& [name, seen] : observed)
    if (!out.contains(name)) out[name] = {{seen.sampled, seen.value, temporal::ProjectionKind::executed, ""}};
  if (!names.empty()) {
    std::erase_if(out, [&](const auto& timeline) {
      return std::find(names.begin(), names.end(), timeline.first) == names.end();
    });
  }
  return out;
}

nlohmann::json timelines_json(const lib::MissionView& view, const Timelines& timelines,
                              const MissionWords& words) {
  nlohmann::json out{{"time_s", static_cast<double>(view.now_us()) / 1e6},
                     {"plan_version", view.plan() ? view.plan()->version() : 0},
                     {"timelines", nlohmann::json::object()},
                     {"units", nlohmann::json::object()}};
  for (const auto& [name, changes] : timelines) {
    nlohmann::json& list = out["timelines"][name] = nlohmann::json::array();
    if (const std::string unit = words.unit_of(name); !unit.empty()) out["units"][name] = unit;
    for (const temporal::ProjectedChange& change : changes) {
      list.push_back({{"time_s", seconds_of(change.time)},
                      {"value", temporal::to_text(change.value)},
                      {"kind", temporal::to_string(change.kind)},
                      {"activity", change.activity}});
    }
  }
  return out;
}

std::string timelines_text(const Timelines& timelines, const MissionWords& words) {
  std::string out;
  for (const auto& [name, changes] : timelines) {
    const std::string unit = words.unit_of(name);
    out += printable(name + (unit.empty() ? "" : " [" + unit + "]")) + "\n";
    for (const temporal::ProjectedChange& change : changes) {
      out += "  " + lib::clock_text(change.time.count()) + "  " +
             padded(temporal::to_string(change.kind), 10) +
             printable(padded(temporal::to_text(change.value), 16) + " " + change.activity) + "\n";
    }
  }
  return out;
}

std::string timelines_table(const Timelines& timelines, const MissionWords& words) {
  using temporal::ProjectionKind;
  std::vector<std::vector<std::string>> rows{
      {"TIMELINE", "NOW", "SINCE", "PLANNED LAST", "PROJECTED LAST", "UNIT"}};
  for (const auto& [name, changes] : timelines) {
    const temporal::ProjectedChange* last[3]{};  // by kind
    const auto slot = [](ProjectionKind kind) {
      return kind == ProjectionKind::executed ? 0 : kind == ProjectionKind::planned ? 1 : 2;
    };
    for (const temporal::ProjectedChange& change : changes) last[slot(change.kind)] = &change;
    const auto value = [&](int kind) {
      return last[kind] == nullptr ? "" : temporal::to_text(last[kind]->value);
    };
    const auto at = [&](int kind) {
      return last[kind] == nullptr ? "" : value(kind) + " at " + lib::clock_text(last[kind]->time.count());
    };
    rows.push_back({name, value(0), last[0] == nullptr ? "" : lib::clock_text(last[0]->time.count()), at(1),
                    at(2), words.unit_of(name)});
  }
  return table_text(rows);
}

}  // namespace roci::console::cli
