// What moves keeps to the energy that a sol has for downlinks (R111): a downlink is placed in a sol that lasts for it,
// and where a sol is overdrawn all the same, something gives way.
#include <algorithm>
#include <utility>

#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::cycle {

using temporal::Duration, temporal::Time;

namespace {

constexpr int kMostTurns = 4;

}  // namespace

// Returns the other downlinks of what has begun that have their place, those that were made longer with the length of
// the network if they are to take the least. What has not begun gives way and is not among them.
std::vector<search::PlannedDownlink> Cycle::others_begun(TaskId but, bool at_least) const {
  std::vector<search::PlannedDownlink> out;
  for (const Block& one : blocks_) {
    if (!one.begun()) continue;
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      const Link& each = one.links[i];
      const TaskId id = task_id(one.number, i);
      if (id == but || !is_placed(each) || !network_.tasks[each.task].downlinks) continue;
      const bool planned = each.stage == Stage::planned;
      if (planned && !timelines_.placed(id)) continue;  // it is placed anew, too
      const Time end = planned && at_least ? each.start + duration(each.task) : each.end;
      out.push_back({each.task, each.start, end, id});
    }
  }
  return out;
}

// Returns the soonest place of a link within these starts. A downlink goes to the first sol that has energy for it
// beside the downlinks of what has begun, and is as long as its data take and the energy of that sol lasts; only where
// there is no such place those that were made longer have to be shorter. A downlink that takes more than a limit by
// itself goes anywhere, since no sol is better than another.
std::optional<Cycle::Placement> Cycle::soonest(const Block& of, std::size_t link,
                                               temporal::timelines::Footprint seen,
                                               temporal::timelines::Interval starts) const {
  const model::TaskIndex task = of.links[link].task;
  const Time latest_end = std::min(plan_end_, network_.tasks[task].closes);
  const auto first = [&](Time from) -> std::optional<Time> {
    const Time latest = std::min(starts.latest, temporal::plus(latest_end, -seen.duration));
    return from <= latest ? timelines_.first_valid_start(seen, {from, latest}) : std::nullopt;
  };
  const Duration least = duration(task);
  const bool limited = delivery_ != nullptr && network_.tasks[task].downlinks &&
                       delivery_->permits_alone(task, least, past_.values);
  if (!limited) {
    const std::optional<Time> start = first(starts.earliest);
    return start ? std::optional(Placement{*start, seen.duration}) : std::nullopt;
  }
  for (const bool at_least : {false, true}) {
    const std::vector<search::PlannedDownlink> others = others_begun(task_id(of.number, link), at_least);
    std::optional<Placement> shortest;
    seen.duration = least;
    for (auto start = first(starts.earliest); start;) {
      const Time end_of_sol = delivery_->end_of_sol(*start, past_.values);
      seen.duration = least;
      if (delivery_->permits(task, *start, least, others, past_.values)) {
        const Duration permitted = sessions_.longest(blocks_, of, link, *start, *delivery_, past_.values);
        seen.duration = sessions_.wanted(blocks_, of, link, *delivery_, past_.values, permitted);
        if (!shortest) shortest = Placement{*start, least};
        start = first(*start);
        if (start && *start < end_of_sol) return Placement{*start, seen.duration};
      } else {
        start = first(end_of_sol);
      }
    }
    if (shortest) return shortest;
  }
  return std::nullopt;
}

// Returns when the last downlink of the block starts that lies in one of the sols and may still be moved; of what has
// begun, one for which another sol may last.
std::optional<Time> Cycle::overdraws(const Block& one, const std::set<std::uint32_t>& sols) const {
  std::optional<Time> out;
  for (const Link& each : one.links)
    if (each.stage == Stage::planned && network_.tasks[each.task].downlinks &&
        sols.contains(delivery_->sol_of(each.start, past_.values)) &&
        (!one.begun() || delivery_->permits_alone(each.task, duration(each.task), past_.values)))
      out = each.start;
  return out;
}

// Places the rest of a block that has begun anew, so that its downlinks keep the limits of their sols.
// Returns false, with nothing changed, where there is no place for it.
bool Cycle::defer(std::uint32_t number, Time from) {
  const std::size_t mark = timelines_.mark();
  std::vector<Block> before = blocks_;
  if (shift(*block(number), from)) return true;
  timelines_.undo(mark);
  blocks_ = std::move(before);
  return place_rests(number, from);
}

// Has something give way that overdraws one of these sols: what has not begun is taken out, the last one first; then
// the rest of what has begun goes to later sols, the last one first; and if none finds a place there, that whose
// downlinks are worth least is broken off. Returns whether anything could.
bool Cycle::make_way(const std::set<std::uint32_t>& sols, std::set<std::uint32_t>& tried, Time from,
                     Report& report) {
  const auto worth = [&](const Block& one) {
    temporal::RankVector out;
    for (const Link& each : one.links)
      if (network_.tasks[each.task].downlinks) out += model::utility(network_.tasks[each.task], past_.values);
    return out;
  };
  const Block *waiting = nullptr, *last = nullptr;
  Block* cheapest = nullptr;
  Time sends{0};  // the downlink of `last`
  for (Block& one : blocks_) {
    const std::optional<Time> start = one.failed() ? std::nullopt : overdraws(one, sols);
    if (!start) continue;
    if (!one.begun()) {
      if (waiting == nullptr || one.links.front().start > waiting->links.front().start) waiting = &one;
      continue;
    }
    if (!tried.contains(one.number) && (last == nullptr || *start > sends)) {
      last = &one;
      sends = *start;
    }
    if (cheapest == nullptr || worth(one) < worth(*cheapest)) cheapest = &one;
  }
  if (waiting != nullptr) {
    drop(*waiting, "downlinks of its sol take more than its limit", report);
  } else if (last != nullptr) {
    tried.insert(last->number);
    if (!defer(last->number, from)) return true;  // others may
  } else if (cheapest != nullptr) {
    abandon(*cheapest, "downlinks of its sol take more than its limit, and no later one lasts for it",
            report);
  } else {
    return false;
  }
  report.changed = true;
  return true;
}

// What has moved to another sol, or takes longer than foreseen, may take more of a sol than its limit permits:
// downlinks that were made longer take less, and then something gives way. Returns whether anything was changed: what
// is committed may overdraw its sol by itself.
bool Cycle::keep_limits(Time now, Report& report) {
  if (delivery_ == nullptr) return false;
  const auto overdrawn = [&] { return delivery_->overdrawn_sols(data().downlinks, past_.values); };
  if (overdrawn().empty()) return false;
  const std::vector<Block> before = blocks_;
  fit_downlinks(now);
  std::set<std::uint32_t> tried;
  for (auto sols = overdrawn(); !sols.empty(); sols = overdrawn())
    if (!make_way(sols, tried, now + network_.cycle.commit_window, report)) break;
  return blocks_ != before;
}

// Downlinks of other lengths, and what gave way to a limit, may leave the rest in conflict: then that is repaired, and
// may overdraw a sol in its turn.
void Cycle::settle(Time now, Report& report) {
  bool repaired = false;
  for (int turn = 0; turn < kMostTurns && keep_limits(now, report); ++turn) {
    repaired |= keep_order(now, report);
    repaired |= repair(now, report);
  }
  if (repaired && std::ranges::find(report.done, Activity::repair) == report.done.end())
    report.done.insert(std::ranges::upper_bound(report.done, Activity::repair), Activity::repair);
}

}  // namespace roci::planner::utility_htn::cycle
