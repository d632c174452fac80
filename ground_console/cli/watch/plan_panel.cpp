#include <algorithm>

#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/watch/axis.hpp"

namespace roci::console::cli::watch {
namespace {

struct StepLook {
  const char* sign;
  Style style;
};

StepLook step_look(const v1::StepStatus* step) {
  if (step == nullptr) return {" ", Style::dim};
  switch (step->state()) {
    case v1::ACTIVITY_SUCCEEDED:
      return {"✔", Style::good};
    case v1::ACTIVITY_DISPATCHED:
    case v1::ACTIVITY_RUNNING:
      return {"▶", Style::active};
    case v1::ACTIVITY_FAILED:
      return {"✘", Style::bad};
    case v1::ACTIVITY_SKIPPED:
    case v1::ACTIVITY_CANCELLED:
      return {"–", Style::warning};
    case v1::ACTIVITY_WAITING:
      break;
  }
  return {" ", Style::dim};
}

std::string label_of(const v1::PlanActivity& activity) {
  std::string out = activity.name();
  for (const v1::Property& argument : arguments_of(activity)) {
    const bool is_name = argument.value().find_first_not_of("0123456789.-") != std::string::npos;
    if (is_name) out += " " + argument.value();
  }
  return out;
}

void draw_windows(const lib::MissionView& view, const Axis& axis, std::size_t row, Canvas& canvas) {
  canvas.put(row, 4, "windows", Style::dim);
  for (const v1::PredictedWindow& window : view.mission()->windows()) {
    axis.draw(row, {window.opens_us(), window.closes_us()}, "▁", Style::active, canvas);
  }
}

// The first activity to be shown when not all fit: the past scrolls out.
std::size_t first_shown(const lib::MissionView& view, std::size_t room) {
  const auto& activities = view.plan()->activities();
  std::size_t first = 0;
  while (first + room < activities.size()) {
    const v1::StepStatus* step = view.step(activities[first].id());
    if (step == nullptr || step->ended_us() == kNotYet) break;
    ++first;
  }
  return first;
}

}  // namespace

void draw_plan(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  if (!view.plan() || area.height < 3 || area.width < Axis::kLeast) return;
  const auto& activities = view.plan()->activities();
  const Axis axis(view, area);
  std::size_t row = area.row;
  canvas.put(row, area.column, "Plan " + std::to_string(view.plan()->version()), Style::title);
  axis.draw_ends(row++, canvas);
  if (view.mission() && !view.mission()->windows().empty()) draw_windows(view, axis, row++, canvas);
  const std::size_t room = area.row + area.height - row;
  const std::size_t first = first_shown(view, room);
  for (std::size_t i = first; i < std::min(first + room, activities.size()); ++i, ++row) {
    const v1::PlanActivity& activity = activities[i];
    const v1::StepStatus* step = view.step(activity.id());
    const StepLook look = step_look(step);
    canvas.put(row, area.column + 2, look.sign, look.style);
    canvas.put(row, area.column + 4, label_of(activity), look.style, Axis::kLabel - 5);
    axis.draw(row, {view.now_us(), view.now_us()}, "│", Style::dim, canvas);
    const Span span = span_of(activity, step, view.now_us());
    axis.draw(row, span, "░", Style::dim, canvas);
    const bool begun = step != nullptr && step->started_us() != kNotYet;
    if (begun) axis.draw(row, {span.from, std::min(span.to, view.now_us())}, "█", look.style, canvas);
  }
}

}  // namespace roci::console::cli::watch
