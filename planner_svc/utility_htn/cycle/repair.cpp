// What gives way where the plan does not hold any more: what is late moves what follows it, and what conflicts is moved
// or taken out (R76, R81).
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::cycle {

using temporal::Duration, temporal::Time;

namespace {

constexpr char kNoLongerFits[] = "it no longer fits";
constexpr char kNoTimeLeft[] = "no time is left at which the rest of it fits";

}  // namespace

// Takes what is only planned out of a block that cannot be finished; what is committed ends by itself.
void Cycle::abandon(Block& begun, const std::string& why, Report& report) {
  for (std::size_t i = 0; i < begun.links.size(); ++i) {
    if (begun.links[i].stage != Stage::planned) continue;
    timelines_.remove(task_id(begun.number, i));
    begun.links[i].stage = Stage::failed;
    report.changed = true;
  }
  if (!why.empty())
    report.notes.push_back(network_.tasks[chains_.chains[begun.chain].task].id + " is broken off: " + why);
}

// Returns whether something of the block that is only planned moves the timeline before or while the conflict lasts.
bool Cycle::contributes(const Block& one, const temporal::timelines::Conflict& conflict) const {
  return std::ranges::any_of(one.links, [&](const Link& each) {
    if (each.stage != Stage::planned || each.start > conflict.to) return false;
    return std::ranges::any_of(network_.tasks[each.task].impacts, [&](const model::Impact& impact) {
      const bool passes =
          impact.moment == temporal::ImpactWhen::during && impact.kind == temporal::ImpactKind::delta;
      return impact.timeline == conflict.timeline && (!passes || each.end >= conflict.from);
    });
  });
}

// Returns the block that has to give way to a conflict: the one whose constraint is broken if something of it is only
// planned; else, of those that contribute to it, the last one that has not begun, or the last one of which something is
// only planned. There is none where what is committed is in conflict with itself.
Block* Cycle::culprit(const temporal::timelines::Conflict& conflict) {
  const auto movable = [](const Block& one) {
    return std::ranges::any_of(one.links, [](const Link& each) { return each.stage == Stage::planned; });
  };
  if (conflict.task) {
    Block* const own = block(block_of(*conflict.task));
    if (own != nullptr && movable(*own)) return own;
  }
  Block* out = nullptr;
  const auto rank = [](const Block& one) { return std::pair(!one.begun(), one.links.front().start); };
  for (Block& one : blocks_)
    if (contributes(one, conflict) && (out == nullptr || rank(one) > rank(*out))) out = &one;
  return out;
}

// Takes out what has not begun and is predicted to break a rule of the mission (R114), as things stand now.
bool Cycle::keep_rules(Time now, Report& report) {
  const std::vector<double> newest = values_now(now);
  const std::vector<model::TaskIndex> closed = this->closed(now);
  std::vector<std::uint32_t> order, before;
  for (const Block* one : by_start()) order.push_back(one->number);
  for (const std::uint32_t number : order) {
    const Block& one = *block(number);
    const bool breaks = !one.begun() && predicted(one.chain, newest, before, closed) < temporal::RankVector{};
    if (!breaks) before.push_back(one.chain);
    if (breaks) drop(one, "it breaks a rule of the mission", report);
  }
  return before.size() < order.size();
}

// Conflicts behind the commit window are mended by moving what has begun to later, and taking out what has not; the
// latter is scheduled anew at once.
bool Cycle::repair(Time now, Report& report) {
  const Time from = now + network_.cycle.commit_window;
  bool changed = keep_rules(now, report);
  std::set<std::uint32_t> shifted;
  for (std::size_t rounds = 2 * blocks_.size(); rounds > 0; --rounds) {
    const auto conflicts = timelines_.conflicts(from, temporal::no_bound);
    Block* gives_way = nullptr;
    for (std::size_t i = 0; i < conflicts.size() && gives_way == nullptr; ++i)
      gives_way = culprit(conflicts[i]);
    if (gives_way == nullptr) break;
    changed = true;
    if (!gives_way->begun()) {
      drop(*gives_way, kNoLongerFits, report);
    } else if (const std::uint32_t number = gives_way->number;
               !shifted.insert(number).second || !make_room(number, from, report)) {
      abandon(*block(number), kNoTimeLeft, report);
    }
  }
  if (changed) keep_rules(now, report);  // the map may have led through what was taken out
  if (changed && to_schedule_) schedule(now, report);
  return changed;
}

// Returns whether some planned link no longer stands between the gaps behind the one before.
bool Cycle::out_of_order(const Block& one) const {
  const auto& gaps = chains_.chains[one.chain].links;
  for (std::size_t i = 1; i < one.links.size(); ++i) {
    if (one.links[i].stage != Stage::planned) continue;
    const Duration gap = one.links[i].start - one.links[i - 1].end;
    if (gap < gaps[i].shortest_gap || gap > gaps[i].longest_gap) return true;
  }
  return false;
}

// Takes out a block that has not begun; its request waits for another place.
void Cycle::drop(const Block& waiting, const std::string& why, Report& report) {
  report.notes.push_back(chains_.chains[waiting.chain].name + " is taken out: " + why);
  take_out(waiting);
  blocks_.erase(blocks_.begin() + (&waiting - blocks_.data()));
  to_schedule_ = true;
}

// Puts the rest of a block that has begun where it fits. Where it finds no place beside all others, the rests of all
// that has begun are placed anew, in the order in which they would go on; and what has not begun gives way, that which
// comes first before the others, and is scheduled again. What is fixed stands.
bool Cycle::make_room(std::uint32_t number, Time from, Report& report) {
  while (!shift(*block(number), from) && !place_rests(number, from)) {
    const Block* next = nullptr;
    for (const Block& one : blocks_)
      if (!one.begun() && !network_.tasks[chains_.chains[one.chain].task].fixed &&
          (next == nullptr || one.links.front().start < next->links.front().start))
        next = &one;
    if (next == nullptr) return false;
    drop(*next, kNoLongerFits, report);
  }
  return true;
}

// Returns whether the rests of all blocks that have begun find places, that of `first` before the others;
// else nothing is changed.
bool Cycle::place_rests(std::uint32_t first, Time from) {
  const auto rest = [](const Block& one) {
    return std::ranges::find(one.links, Stage::planned, &Link::stage);
  };
  std::vector<std::pair<Time, std::uint32_t>> rests;
  for (const Block& one : blocks_)
    if (one.begun() && !one.failed() && rest(one) != one.links.end())
      rests.emplace_back(one.number == first ? Time::min() : rest(one)->start, one.number);
  std::ranges::sort(rests);
  const std::size_t mark = timelines_.mark();
  const std::vector<Block> before = blocks_;
  for (const auto& [start, number] : rests) lift(*block(number));
  const bool fit =
      std::ranges::all_of(rests, [&](const auto& one) { return lower(*block(one.second), from); });
  if (fit) return true;
  timelines_.undo(mark);
  blocks_ = before;
  return false;
}

// What follows a link that is late is late itself. Where the cycle repairs it is given a place beside all others; else
// nothing is searched for (R100): it is pushed, and the executive waits with it until its preconditions hold (task
// push, R98).
bool Cycle::keep_order(Time now, Report& report) {
  const Time from = now + network_.cycle.commit_window;
  std::vector<std::uint32_t> late;
  for (const Block& one : blocks_)
    if (one.begun() && !one.failed() && out_of_order(one)) late.push_back(one.number);
  for (const std::uint32_t number : late) {
    if (settings_.repairs) {
      if (!make_room(number, from, report)) abandon(*block(number), kNoTimeLeft, report);
    } else {
      push(*block(number), from);
    }
  }
  return !late.empty();
}

// Puts what is only planned of a block off, whatever conflicts follow.
void Cycle::push(Block& late, Time from) {
  const auto& gaps = chains_.chains[late.chain].links;
  for (std::size_t i = 1; i < late.links.size(); ++i) {
    Link& each = late.links[i];
    if (each.stage != Stage::planned) continue;
    const Duration length = each.end - each.start;
    each.planned = each.start = std::max(from, late.links[i - 1].end + gaps[i].shortest_gap);
    each.end = each.start + length;
    timelines_.move(task_id(late.number, i), each.start, each.end);
  }
}

// Places what is only planned of a block anew, each link as early as it can be.
bool Cycle::shift(Block& late, Time from) {
  lift(late);
  return lower(late, from);
}

void Cycle::lift(const Block& late) {
  for (std::size_t i = 0; i < late.links.size(); ++i)
    if (late.links[i].stage == Stage::planned) timelines_.remove(task_id(late.number, i));
}

// From the first link on that finds no place, they stand where they stood.
bool Cycle::lower(Block& late, Time from) {
  const auto& gaps = chains_.chains[late.chain].links;
  bool fits = true;
  for (std::size_t i = 0; i < late.links.size(); ++i) {
    Link& each = late.links[i];
    if (each.stage != Stage::planned) continue;
    auto seen = footprint(late, i);
    seen.duration = length(late, i);
    std::optional<Placement> found;
    if (fits) {
      const Time before = i == 0 ? from : late.links[i - 1].end;
      const Time earliest = std::max(from, before + (i == 0 ? Duration{0} : gaps[i].shortest_gap));
      const Time latest = i == 0 ? temporal::no_bound : temporal::plus(before, gaps[i].longest_gap);
      found = soonest(late, i, seen, {earliest, latest});
    }
    fits = found.has_value();
    if (found) {
      each.planned = each.start = found->start;
      each.end = found->start + found->length;
      seen.duration = found->length;
    }
    timelines_.place(task_id(late.number, i), seen, each.start);
  }
  return fits;
}

}  // namespace roci::planner::utility_htn::cycle
