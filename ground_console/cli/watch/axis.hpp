// The panels of the plan share this time axis: mission time to columns.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {

/// Holds a span of mission time, in microseconds.
struct Span {
  std::int64_t from;
  std::int64_t to;
};

/// When an activity was, is, or is expected to be; `step` is null while nothing is known of it.
/// Of what was skipped and never began: now.
Span span_of(const v1::PlanActivity& activity, const v1::StepStatus* step, std::int64_t now);

/// Reaches from the first start to the last end of the view's plan, which must be there, beside the labels.
class Axis {
 public:
  static constexpr std::size_t kLabel = 36;  ///< columns, at least
  static constexpr std::size_t kLeast = kLabel + 24;

  /// `area` is at least kLeast wide.
  Axis(const lib::MissionView& view, const Rectangle& area);

  std::size_t column() const { return column_; }
  /// Columns to the left of it; more where a plan has levels and the area is wide.
  std::size_t label() const { return label_; }
  std::size_t width() const { return width_; }
  std::size_t column_of(std::int64_t time) const;
  std::int64_t time_at(std::size_t column) const;  ///< the latest that column_of() puts there

  void draw_ends(std::size_t row, Canvas& canvas) const;
  void draw(std::size_t row, Span span, const char* glyph, Style style, Canvas& canvas) const;

 private:
  std::int64_t first_;
  std::int64_t last_;
  std::size_t label_;
  std::size_t column_;
  std::size_t width_;
};

}  // namespace roci::console::cli::watch
