// A line is one timeline: what happens on it in the order of time, and what is asked of it, in blocks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/temporal/timelines/block.hpp"
#include "core/temporal/timelines/event.hpp"

namespace roci::temporal::timelines {

/// Holds the changes and the asks of one timeline from its past on; what was before is in one value and one rate.
/// Courses and summaries of blocks are computed when they are asked for and cached until something before them
/// changes, so not even const functions may be called from two threads at once.
class Line {
 public:
  /// Blocks have at most `block` changes and asks, but for those of one instant.
  Line(Bounds range, Exact initial, Micros past, Micros end, std::size_t block);

  const Bounds& range() const { return range_; }
  Micros past() const { return past_; }
  Micros end() const { return end_; }
  std::size_t events() const { return events_; }
  std::size_t asks() const { return asks_; }

  /// O(log n) to find the block, and the size of a block.
  void add(const Event& event);
  void erase(const Event& event);
  /// Does the same for each block that the ask reaches into.
  void add(const Ask& ask);
  void erase(const Ask& ask);

  /// Changes what the folded past has left.
  void amend(Exact value, Exact rate);
  /// Sets an observation; another of the same instant goes.
  void observe(Micros time, Exact value);
  /// Folds what happens before `now`; asks that end before go, those that began before begin at `now`. O(n).
  void fold(Micros now);

  /// Returns the projected value; before the past it is the value that the past has left.
  Exact value(Position at) const;

  std::size_t blocks() const { return blocks_.size(); }
  const Block& block(std::size_t i) const { return blocks_[i]; }
  /// Returns the block that holds the instant; the first one for an instant in the past.
  std::size_t block_of(Micros time) const;
  /// Returns the instant of the next block, or the end of the timeline.
  Micros closing(std::size_t i) const { return i + 1 < blocks_.size() ? blocks_[i + 1].first() : end_; }
  const Summary& summary(std::size_t i) const;
  /// Returns the knots of one block: the first stands at its beginning, the last at its closing. They hold until the
  /// line changes or another block is asked for.
  std::span<const Knot> knots(std::size_t i) const;
  /// Replaces `knots` by those of the blocks from `first` to `last`: the first stands at the beginning of the first
  /// block, the last at the closing of the last one, with what acts before that instant alone unless it is
  /// the end of the timeline.
  void knots(std::size_t first, std::size_t last, std::vector<Knot>& knots) const;

 private:
  const Course& course(std::size_t i) const;
  void changed(std::size_t i);
  void forget_knots() { knots_of_ = kNone; }
  void split(std::size_t i);

  Bounds range_;
  Micros past_;
  Micros end_;
  std::size_t block_;
  std::size_t events_ = 0;
  std::size_t asks_ = 0;
  std::vector<Block> blocks_;
  mutable std::vector<Course> courses_;  ///< at the beginning of each block
  mutable std::size_t known_ = 1;        ///< so many of them hold
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  mutable std::vector<Knot> knots_;  ///< of one block, since most questions are about the same
  mutable std::size_t knots_of_ = kNone;
};

}  // namespace roci::temporal::timelines
