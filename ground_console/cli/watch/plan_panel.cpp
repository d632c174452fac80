#include <algorithm>

#include "ground_console/cli/watch/panels.hpp"

namespace roci::console {
namespace {

constexpr std::size_t kLabel = 36;

struct Span {
  std::int64_t from;
  std::int64_t to;
};

// When an activity was, is, or is expected to be.
Span span_of(const v1::PlanActivity& activity, const v1::StepStatus* step, std::int64_t now) {
  if (step == nullptr) return {now, now};
  const bool begun = step->started_us() != kNotYet;
  const std::int64_t from = begun ? step->started_us() : step->earliest_start_us();
  if (step->ended_us() != kNotYet) return {from, step->ended_us()};
  return {from, std::max(from + activity.duration_lower_us(), begun ? now : from)};
}

struct Look {
  const char* sign;
  Style style;
};

Look look_of(const v1::StepStatus* step) {
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
  for (const v1::Property& argument : activity.arguments()) {
    const bool is_name = argument.value().find_first_not_of("0123456789.-") != std::string::npos;
    if (is_name) out += " " + argument.value();
  }
  return out;
}

// The time axis: mission time to columns.
class Axis {
 public:
  Axis(const MissionView& view, std::size_t column, std::size_t width)
      : first_(view.now_us()), last_(view.now_us()), column_(column), width_(width) {
    for (const v1::PlanActivity& activity : view.plan()->activities()) {
      const Span span = span_of(activity, view.step(activity.id()), view.now_us());
      first_ = std::min(first_, span.from);
      last_ = std::max(last_, span.to);
    }
    last_ = std::max(last_, first_ + 1);
  }

  std::size_t column_of(std::int64_t time) const {
    const double share = static_cast<double>(time - first_) / static_cast<double>(last_ - first_);
    return column_ + static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(width_ - 1));
  }

  void draw_ends(std::size_t row, Canvas& canvas) const {
    const std::string to = clock_text(last_);
    canvas.put(row, column_, clock_text(first_), Style::dim);
    canvas.put(row, column_ + width_ - std::min(width_, to.size()), to, Style::dim);
  }

  void draw(std::size_t row, Span span, const char* glyph, Style style, Canvas& canvas) const {
    if (span.to < first_ || span.from > last_) return;
    for (std::size_t column = column_of(span.from); column <= column_of(span.to); ++column) {
      canvas.put(row, column, glyph, style);
    }
  }

 private:
  std::int64_t first_;
  std::int64_t last_;
  std::size_t column_;
  std::size_t width_;
};

void draw_windows(const MissionView& view, const Axis& axis, std::size_t row, Canvas& canvas) {
  canvas.put(row, 4, "windows", Style::dim);
  for (const v1::PredictedWindow& window : view.mission()->windows()) {
    axis.draw(row, {window.opens_us(), window.closes_us()}, "▁", Style::active, canvas);
  }
}

// The first activity to be shown when not all fit: the past scrolls out.
std::size_t first_shown(const MissionView& view, std::size_t room) {
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

void draw_plan(const MissionView& view, const Rectangle& area, Canvas& canvas) {
  if (!view.plan() || area.height < 3 || area.width < kLabel + 24) return;
  const auto& activities = view.plan()->activities();
  const Axis axis(view, area.column + kLabel, area.width - kLabel);
  std::size_t row = area.row;
  canvas.put(row, area.column, "Plan " + std::to_string(view.plan()->version()), Style::title);
  axis.draw_ends(row++, canvas);
  if (view.mission() && !view.mission()->windows().empty()) draw_windows(view, axis, row++, canvas);
  const std::size_t room = area.row + area.height - row;
  const std::size_t first = first_shown(view, room);
  for (std::size_t i = first; i < std::min(first + room, activities.size()); ++i, ++row) {
    const v1::PlanActivity& activity = activities[i];
    const v1::StepStatus* step = view.step(activity.id());
    const Look look = look_of(step);
    canvas.put(row, area.column + 2, look.sign, look.style);
    canvas.put(row, area.column + 4, label_of(activity), look.style, kLabel - 5);
    axis.draw(row, {view.now_us(), view.now_us()}, "│", Style::dim, canvas);
    const Span span = span_of(activity, step, view.now_us());
    axis.draw(row, span, "░", Style::dim, canvas);
    const bool begun = step != nullptr && step->started_us() != kNotYet;
    if (begun) axis.draw(row, {span.from, std::min(span.to, view.now_us())}, "█", look.style, canvas);
  }
}

}  // namespace roci::console
