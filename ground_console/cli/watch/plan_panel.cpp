#include <algorithm>

#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/watch/axis.hpp"
#include "ground_console/cli/watch/plan_rows.hpp"

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

// A name with arguments of its own, "base.driving(dock, gate)", says all.
std::string label_of(const PlanRow& row) {
  std::string out(2 * row.depth, ' ');
  out += row.activity->name();
  if (row.activity->name().find('(') == std::string::npos) {
    for (const v1::Property& argument : arguments_of(*row.activity)) {
      const bool is_name = argument.value().find_first_not_of("0123456789.-") != std::string::npos;
      if (is_name) out += " " + argument.value();
    }
  }
  return out;
}

void draw_windows(const lib::MissionView& view, const Axis& axis, std::size_t row, Canvas& canvas) {
  canvas.put(row, 4, "windows", Style::dim);
  for (const v1::PredictedWindow& window : view.mission()->windows()) {
    axis.draw(row, {window.opens_us(), window.closes_us()}, "▁", Style::active, canvas);
  }
}

}  // namespace

void draw_plan(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  if (!view.plan() || area.height < 3 || area.width < Axis::kLeast) return;
  const Axis axis(view, area);
  std::size_t row = area.row;
  canvas.put(row, area.column, "Plan " + std::to_string(view.plan()->version()), Style::title);
  axis.draw_ends(row++, canvas);
  if (view.mission() && !view.mission()->windows().empty()) draw_windows(view, axis, row++, canvas);
  const PlanRows shown = plan_rows(view, area.row + area.height - row);
  if (shown.gone + shown.more > 0) {
    std::string left_out = shown.gone > 0 ? std::to_string(shown.gone) + " over" : "";
    if (shown.more > 0) left_out += (left_out.empty() ? "" : ", ") + std::to_string(shown.more) + " more";
    canvas.put(area.row, area.column + 10, "(" + left_out + ")", Style::dim, axis.label() - 11);
  }
  for (const PlanRow& one : shown.rows) {
    const v1::PlanActivity& activity = *one.activity;
    const v1::StepStatus* step = view.step(activity.id());
    const StepLook look = step_look(step);
    canvas.put(row, area.column + 2, look.sign, look.style);
    const std::string folded = one.folded == 0 ? "" : " +" + std::to_string(one.folded);
    const std::size_t room = axis.label() - 5 - folded.size();
    const std::size_t end = canvas.put(row, area.column + 4, label_of(one), look.style, room);
    canvas.put(row, end, folded, Style::dim);
    axis.draw(row, {view.now_us(), view.now_us()}, "│", Style::dim, canvas);
    const Span span = span_of(activity, step, view.now_us());
    axis.draw(row, span, "░", Style::dim, canvas);
    const bool begun = step != nullptr && step->started_us() != kNotYet;
    if (begun) axis.draw(row, {span.from, std::min(span.to, view.now_us())}, "█", look.style, canvas);
    ++row;
  }
}

}  // namespace roci::console::cli::watch
