// This file finds exactly the starts at which a task would break bounds in some blocks of one timeline (R75).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/temporal/timelines/effect.hpp"
#include "core/temporal/timelines/line.hpp"

namespace roci::temporal::timelines {

/// Holds buffers that are reused from question to question.
struct Scratch {
  std::vector<Knot> knots;
  std::vector<Micros> cuts;
  std::vector<Stretch> bad;
};

/// Finds starts of a task at which bounds on a timeline would be broken. What the task does to the value at any place
/// is, between few starts at which it changes its form, a straight function of the start:
/// bad starts are unions of intervals.
class StartSearch {
 public:
  /// Appends to `bad` the bad starts within `window`. The line does not change meanwhile;
  /// what stands in `scratch` is of no account.
  StartSearch(const Line& line, const Effect& effect, Stretch window, std::vector<Stretch>& bad,
              Scratch& scratch)
      : line_(line),
        effect_(effect),
        window_(window),
        bad_(bad),
        joined_(scratch.knots),
        cuts_(scratch.cuts) {
    cuts_.clear();
  }

  /// Looks from here on at the blocks from `first` to `last`.
  void enter(std::size_t first, std::size_t last);
  /// Keeps bounds of others between the two positions, where they hold without the task.
  void keep_for_others(const Bounds& bounds, Position from, Position to);
  /// Keeps a constraint of the task itself.
  void keep(const Constraint& constraint, const Bounds& bounds);

 private:
  /// Holds a place at which the value is checked, with the value there without the task.
  struct Point {
    Micros time = 0;
    Side side = Side::after;
    Exact base = 0;
    Reset reset{};
  };

  Exact value_with(const Point& point, Micros start) const;
  Exact base_at(Micros time, Exact Knot::*at_knot) const;
  std::size_t knot_not_before(Micros time) const;
  Stretch interior(std::size_t knot) const { return {knots_[knot].time + 1, knots_[knot + 1].time - 1}; }
  Exact base_inside(std::size_t knot, Micros time) const {
    return knots_[knot].after + knots_[knot].rate * (time - knots_[knot].time);
  }
  Point at_knot(std::size_t knot, Side side) const {
    return {knots_[knot].time, side, knots_[knot].at(side), knots_[knot].reset(side)};
  }

  void keep_inside(const Bounds& bounds, std::size_t knot, Stretch times);
  void look_at(const Bounds& bounds, const Point& point, Stretch starts);
  void look_at_start(const Bounds& bounds, std::size_t knot, Stretch times);
  void look_at_end(const Bounds& bounds, std::size_t knot, Stretch times, Side side);
  void keep_pre(const Bounds& bounds);
  void keep_maintenance(const Bounds& bounds);
  void keep_post(const Bounds& bounds);

  void cut_at_reset(const Reset& reset);
  void cut_at_knots(Stretch starts);
  template <class ValueAt>
  void in_pieces(const Bounds& bounds, Stretch starts, ValueAt value_at);

  const Line& line_;
  const Effect& effect_;
  Stretch window_;
  std::vector<Stretch>& bad_;
  std::span<const Knot> knots_{};
  std::size_t count_ = 0;      ///< of knots to look at; one more may close the last stretch
  std::vector<Knot>& joined_;  ///< knots of several blocks
  std::vector<Micros>& cuts_;  ///< starts at which the value changes its form
};

}  // namespace roci::temporal::timelines
