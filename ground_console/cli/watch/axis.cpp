#include "ground_console/cli/watch/axis.hpp"

#include <algorithm>
#include <cmath>

#include "ground_console/cli/plan_table.hpp"

namespace roci::console::cli::watch {

namespace {

constexpr std::int64_t kFarthest = std::int64_t{1} << 60;  // beyond, a time is no bound

}  // namespace

Span span_of(const v1::PlanActivity& activity, const v1::StepStatus* step, std::int64_t now) {
  if (step == nullptr) return {now, now};
  const bool begun = step->started_us() != kNotYet;
  const bool skipped = !begun && step->state() > v1::ACTIVITY_RUNNING;
  if (skipped || (!begun && (step->earliest_start_us() < 0 || step->earliest_start_us() > kFarthest)))
    return {now, now};
  const std::int64_t from = begun ? step->started_us() : step->earliest_start_us();
  if (step->ended_us() != kNotYet) return {from, step->ended_us()};
  return {from, std::max(from + activity.duration_lower_us(), begun ? now : from)};
}

Axis::Axis(const lib::MissionView& view, const Rectangle& area)
    : first_(view.now_us()),
      last_(view.now_us()),
      label_(has_levels(*view.plan()) ? std::max(kLabel, area.width * 2 / 5) : kLabel),
      column_(area.column + label_),
      width_(area.width - label_) {
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    const Span span = span_of(activity, view.step(activity.id()), view.now_us());
    first_ = std::min(first_, span.from);
    last_ = std::max(last_, span.to);
  }
  last_ = std::max(last_, first_ + 1);
}

std::size_t Axis::column_of(std::int64_t time) const {
  const double share = static_cast<double>(time - first_) / static_cast<double>(last_ - first_);
  return column_ + static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(width_ - 1));
}

std::int64_t Axis::time_at(std::size_t column) const {
  const double share = static_cast<double>(column + 1 - column_) / static_cast<double>(width_ - 1);
  const auto begin_of_next =
      first_ + static_cast<std::int64_t>(std::ceil(share * static_cast<double>(last_ - first_)));
  return std::min(last_, begin_of_next - 1);
}

void Axis::draw_ends(std::size_t row, Canvas& canvas) const {
  const std::string to = lib::clock_text(last_);
  canvas.put(row, column_, lib::clock_text(first_), Style::dim);
  canvas.put(row, column_ + width_ - std::min(width_, to.size()), to, Style::dim);
}

void Axis::draw(std::size_t row, Span span, const char* glyph, Style style, Canvas& canvas) const {
  if (span.to < first_ || span.from > last_) return;
  for (std::size_t column = column_of(span.from); column <= column_of(span.to); ++column) {
    canvas.put(row, column, glyph, style);
  }
}

}  // namespace roci::console::cli::watch
