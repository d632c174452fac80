// A block is a part of a timeline: as many changes as fit into a few cache lines, with their sum, so that a
// long timeline can be searched by blocks.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/temporal/timelines/event.hpp"

namespace roci::temporal::timelines {

/// Sums up a block's values, and how far they are from the bounds that are asked for there.
struct Summary {
  bool fine = true;            ///< all bounds of the range and of all asks hold everywhere
  Exact room_below = kBeyond;  ///< the least distance of the value to a lowest bound, if all are fine
  Exact room_above = kBeyond;
  Exact lowest = kBeyond;
  Exact highest = -kBeyond;
  std::uint64_t states = 0;  ///< bits of those that are there
};

/// Holds what happens from its first instant up to that of the next block, and every ask that reaches into it.
class Block {
 public:
  /// Splits when it has more than `most` changes and asks.
  Block(Micros first, std::size_t most) : first_(first), most_(most) {}

  Micros first() const { return first_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<Ask>& asks() const { return asks_; }
  bool resets() const;

  /// O(size of the block).
  void add(const Event& event);
  /// Returns whether the event was there; only its place in the order counts, not its amount.
  bool erase(const Event& event);
  void add(const Ask& ask);
  void erase(const Ask& ask);

  /// Cuts off the later part of a block that has grown too large; returns nothing if it has not,
  /// or if all happens at one instant.
  std::optional<Block> split();

  /// Returns the course at `end` for one at first(). O(1) as long as the block has not changed.
  Course run(const Course& at_first, Micros end) const;
  /// Returns the course at a place in the block, which lies before `end`.
  Course at(const Course& at_first, Position place) const;
  /// Appends the knots: the first stands at first(), the last at `closing`. That one has only what acts before the
  /// instant, unless this is the last block, which holds what happens at the end of the timeline, too.
  void knots(const Course& at_first, Micros closing, std::vector<Knot>& knots) const;
  /// Returns whether summary() holds for this course; O(1), also where all values have shifted.
  bool summarized(const Bounds& range, const Course& at_first, Micros closing) const;
  /// Makes the summary anew from the block's knots for this course.
  void summarize(const Bounds& range, const Course& at_first, Micros closing,
                 std::span<const Knot> knots) const;
  const Summary& summary() const { return summary_; }

 private:
  /// Sums up what the block makes of a course: from `reset` on (else from the first instant) these sums.
  struct Sum {
    bool known = false;
    bool resets = false;
    Reset reset{};
    Exact assigned = 0;
    Exact rate_before = 0;  ///< up to the reset
    Exact delta = 0;
    Exact rate = 0;
    Exact moment = 0;  ///< rates × the time from the reset (the first instant) until they begin
  };
  void changed();
  const Sum& sum() const;

  Micros first_;
  std::size_t own_asks_ = 0;  ///< those that begin here
  std::size_t most_;
  std::vector<Event> events_;
  std::vector<Ask> asks_;
  mutable Sum sum_{};
  mutable bool summarized_ = false;
  mutable Course summarized_at_{};
  mutable Micros summarized_to_ = 0;
  mutable Summary summary_{};
};

}  // namespace roci::temporal::timelines
