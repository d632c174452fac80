#include "core/temporal/timelines/placement.hpp"

#include <algorithm>
#include <initializer_list>

#include "core/temporal/timelines/start_search.hpp"

namespace roci::temporal::timelines {
namespace {

/// Bounds what the task can change a value by.
struct Hull {
  Exact lowest = kBeyond;
  Exact highest = -kBeyond;
  void include(Exact change) {
    lowest = std::min(lowest, change);
    highest = std::max(highest, change);
  }
  /// Includes sums of one of `deltas` and both ends of what rates make.
  void include(std::initializer_list<Exact> deltas, Exact by_rates, Exact behind) {
    for (const Exact delta : deltas) {
      include(delta + by_rates);
      include(delta + by_rates + behind);
    }
  }
};

/// Returns by how much a task without assignments changes values from `first` to `last`; `resets`: with changes of
/// others that override what it has done so far, or a part of it.
Hull change_within(const Effect& effect, Stretch window, Stretch times, bool resets) {
  Hull hull;
  const Exact running = effect.start.rate * effect.duration;
  const Exact both = effect.start.delta + effect.end.delta;
  if (times.first <= window.last) hull.include(0);
  if (resets) hull.include(0);
  if (times.last >= window.first && times.first <= window.last + effect.duration) {
    hull.include({effect.start.delta}, 0, running);
    if (resets) hull.include({0}, 0, running);
  }
  if (times.last >= window.first + effect.duration) {
    const Exact behind =
        (effect.start.rate + effect.end.rate) * (times.last - window.first - effect.duration);
    hull.include({both}, running, behind);
    if (resets) hull.include({both, effect.end.delta, 0}, 0, running);
    if (resets) hull.include({both, effect.end.delta, 0}, 0, behind);
    if (resets) hull.include({both, effect.end.delta, 0}, running, behind);
  }
  return hull;
}

std::uint64_t states_of(const Effect& effect) {
  std::uint64_t states = 0;
  for (const Effect::Step* step : {&effect.start, &effect.end})
    if (step->assign) states |= std::uint64_t{1} << (state_of(*step->assign) & 63);
  return states;
}

/// Looks block by block, and only into those in which the task could break something.
class BlockByBlock {
 public:
  BlockByBlock(const Line& line, const Effect& effect, Stretch window, std::vector<Stretch>& bad,
               Scratch& scratch)
      : line_(line), effect_(effect), window_(window), search_(line, effect, window, bad, scratch) {}

  void keep(std::span<const Constraint* const> own) {
    const bool harmless = effect_.none();
    for (std::size_t i = line_.block_of(window_.first); i < line_.blocks(); ++i) {
      const Block& block = line_.block(i);
      const Stretch times{block.first(), line_.closing(i)};
      const bool own_reach = times.first <= window_.last + effect_.duration && !own.empty();
      if (harmless && !own_reach) return;
      resets_ = resets_ || block.resets();
      const Hull hull = change_within(effect_, window_, times, resets_);
      entered_ = false;
      if (own_reach) keep_own(i, own, hull);
      if (!harmless && !keeps_others(i, hull)) keep_others(i);
    }
  }

 private:
  void enter(std::size_t block) {
    if (!entered_) search_.enter(block, block);
    entered_ = true;
  }

  void keep_own(std::size_t i, std::span<const Constraint* const> own, const Hull& hull) {
    const Summary& summary = line_.summary(i);
    for (const Constraint* constraint : own) {
      const Bounds bounds = bounds_of(*constraint);
      const bool kept = bounds.states != 0
                            ? ((summary.states | states_of(effect_)) & ~bounds.states) == 0
                            : summary.lowest + std::min<Exact>(hull.lowest, 0) >= bounds.lowest &&
                                  summary.highest + std::max<Exact>(hull.highest, 0) <= bounds.highest;
      if (kept) continue;
      enter(i);
      search_.keep(*constraint, bounds);
    }
  }

  /// Returns whether the task keeps all bounds of the range and of others in the block, wherever it starts.
  bool keeps_others(std::size_t i, const Hull& hull) const {
    if (line_.range().states != 0) return line_.block(i).asks().empty();
    if (hull.lowest == 0 && hull.highest == 0) return true;
    const Summary& summary = line_.summary(i);
    return summary.fine && summary.room_below + hull.lowest >= 0 && summary.room_above >= hull.highest;
  }

  void keep_others(std::size_t i) {
    enter(i);
    search_.keep_for_others(line_.range(), {line_.past(), Side::before}, {line_.end(), Side::after});
    for (const Ask& ask : line_.block(i).asks()) search_.keep_for_others(ask.bounds, ask.from, ask.to);
  }

  const Line& line_;
  const Effect& effect_;
  Stretch window_;
  StartSearch search_;
  bool resets_ = false;
  bool entered_ = false;
};

}  // namespace

void find_bad_starts(const Line& line, const Effect& effect, std::span<const Constraint* const> own,
                     Stretch window, std::vector<Stretch>& bad, Scratch& scratch) {
  const bool assigns = effect.start.assign || effect.end.assign;
  if (!assigns || line.range().states != 0) {
    BlockByBlock(line, effect, window, bad, scratch).keep(own);
    return;
  }
  // What an assigned number replaces is looked up far from where it matters: all at once.
  StartSearch search(line, effect, window, bad, scratch);
  const std::size_t first = line.block_of(window.first);
  search.enter(first, line.blocks() - 1);
  for (const Constraint* constraint : own) search.keep(*constraint, bounds_of(*constraint));
  search.keep_for_others(line.range(), {line.past(), Side::before}, {line.end(), Side::after});
  for (std::size_t i = first; i < line.blocks(); ++i)
    for (const Ask& ask : line.block(i).asks())
      if (i == first || ask.from.time >= line.block(i).first())
        search.keep_for_others(ask.bounds, ask.from, ask.to);
}

}  // namespace roci::temporal::timelines
