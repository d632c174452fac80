// What is observed and executed, taken into the plan (R76): what runs, ends, fails or is late stands in the timelines
// as it was, or as it is now expected.
#include <algorithm>

#include "planner_svc/utility_htn/cycle/claims.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::cycle {

using temporal::Duration, temporal::Time;
using temporal::timelines::Constraint, temporal::timelines::Index;

namespace {

// Nothing is expected to be later than it is by more than this.
constexpr Duration kFarthestExpectation = std::chrono::hours(1);

}  // namespace

// What was sampled before the past was folded, and is heard after that, counts from its edge on if nothing newer is
// known: a state is reported when it changes, and not again.
void Cycle::observe(Index timeline, Time sampled, double value) {
  const bool newest = observations_.is_newest(timeline, sampled);
  const Time anchored = newest ? std::max(sampled, timelines_.past()) : sampled;
  const double foreseen = timelines_.value(timeline, anchored);
  timelines_.observe(timeline, anchored, value);
  to_optimize_ |= observations_.take(timeline, sampled, value, foreseen);
}

// What a task makes of a timeline that nobody reports counts more than what the ground said before.
void Cycle::note_made(const model::Task& by, temporal::ImpactWhen when, Time at) {
  for (const model::Impact& impact : by.impacts)
    if (impact.moment == when && impact.kind == temporal::ImpactKind::assign &&
        network_.timelines[impact.timeline].is_remembered())
      observations_.note(impact.timeline, at, model::evaluate(impact.amount, past_.values));
}

void Cycle::begun(TaskId task, Time at) {
  Link* const one = link(task);
  if (one == nullptr || !waits(*one)) return;
  to_optimize_ |= one->start != at;
  one->start = at;
  one->end = at + length(*block(block_of(task)), link_of(task));
  one->stage = Stage::running;
  one->told = Duration{0};
  timelines_.move(task, at, one->end);
  note_made(network_.tasks[one->task], temporal::ImpactWhen::at_start, at);
}

void Cycle::tried_again(TaskId task, Time at) {
  Link* const one = link(task);
  if (one == nullptr || one->stage != Stage::running) return;
  one->generated = 0;
  one->end = std::max(one->start, at) + length(*block(block_of(task)), link_of(task));
  timelines_.move(task, one->start, one->end);
  to_optimize_ = true;
}

void Cycle::generated(TaskId task, const std::string& product) {
  Link* const one = link(task);
  if (one == nullptr || is_over(one->stage)) return;
  const auto& products = network_.tasks[one->task].products;
  const auto found = std::ranges::find(products, product, &model::Product::name) - products.begin();
  if (found < std::min<std::ptrdiff_t>(std::ssize(products), 64)) one->generated |= std::uint64_t{1} << found;
}

void Cycle::ended(TaskId task, Time at, bool succeeded, const std::string& cause) {
  Link* const one = link(task);
  if (one == nullptr || is_over(one->stage)) return;
  const bool placed =
      is_placed(*one) && timelines_.placed(task);  // consolidation has forgotten what should be over
  to_optimize_ |= one->end != at || !succeeded;
  one->start = std::min(one->start, at);
  one->end = at;
  one->stage = succeeded ? Stage::succeeded : Stage::failed;
  if (succeeded && placed) timelines_.move(task, one->start, at);
  if (succeeded) observations_.await(network_.tasks[one->task], at);
  if (succeeded) note_made(network_.tasks[one->task], temporal::ImpactWhen::at_end, at);
  if (succeeded || !placed) return;
  timelines_.remove(task);  // what failed has no effect; what it has cost is observed
  doom(task);
  edit_network(one->task);
  const model::Task& failed = network_.tasks[one->task];
  notes_.push_back(failed.id + " failed" + (cause.empty() ? "" : ": " + cause));
}

// What a command was to bring about and nobody has reported for a whole interval has not come about:
// the report before it stands.
void Cycle::believe_reports(Time now) {
  for (const auto& [timeline, value] : observations_.take_unconfirmed(now)) observe(timeline, now, value);
}

// What follows a link that has failed never gets what it waits for.
void Cycle::doom(TaskId failed) {
  Block& of = *block(block_of(failed));
  for (std::size_t i = link_of(failed) + 1; i < of.links.size(); ++i) {
    if (of.links[i].stage != Stage::committed) continue;
    timelines_.remove(task_id(of.number, i));
    of.links[i].stage = Stage::doomed;
  }
}

void Cycle::nothing_runs(Time now) {
  for (Block& one : blocks_)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      Link& each = one.links[i];
      if (each.stage == Stage::committed) each.stage = Stage::planned;
      if (each.stage == Stage::planned) each.told = Duration{0};
      if (each.stage == Stage::running) ended(task_id(one.number, i), now, false, "the plan has ended");
    }
  to_optimize_ = true;
}

// What should have begun or ended by now and has not is expected to be late by as much again, an hour more at most
// (R76). So what is long overdue moves the plan a few times and not in every cycle.
// Returns whether what is expected has changed.
bool Cycle::follow(Time now) {
  bool changed = false;
  // What runs goes first, since what is committed may wait for its end.
  for (const Stage stage : {Stage::running, Stage::committed})
    for (Block& one : blocks_)
      for (std::size_t i = 0; i < one.links.size(); ++i) {
        const Link before = one.links[i];
        if (before.stage != stage) continue;
        if (stage == Stage::committed) await_start(one, i, now);
        if (stage == Stage::running && before.end <= now) {
          // What is due just now may have ended; what is overdue has not.
          const Time due = before.start + length(one, i);
          if (due < now) one.links[i].end = expected(due, now);
          if (due > now) one.links[i].end = due;  // it was expected to end with the budget, and lasts
        }
        if (one.links[i] == before) continue;
        changed |= one.links[i].end != before.end;
        timelines_.move(task_id(one.number, i), one.links[i].start, one.links[i].end);
      }
  return changed;
}

Time Cycle::expected(Time due, Time now) const {
  return now + std::clamp(now - due, network_.cycle.process_interval, kFarthestExpectation);
}

// A link starts behind the one before it. The first that is late may begin at any time,
// and holds what it needs until then. Tasks that set one internal state are expected in the order that was planned.
void Cycle::await_start(Block& of, std::size_t index, Time now) {
  Link& late = of.links[index];
  const Duration length = this->length(of, index);
  if (index > 0 && !is_over(of.links[index - 1].stage)) {
    const Duration gap = chains_.chains[of.chain].links[index].shortest_gap;
    late.start = std::max({late.start, now, of.links[index - 1].end + gap});
    late.end = late.start + length;
  } else if (late.start < now) {
    late.start = now;
    if (late.end - length < now) late.end = expected(late.planned, now) + length;
  }
  if (const Time free = free_from(network_, past_.values, blocks_, late); free > late.start) {
    late.start = free;
    late.end = std::max(late.end, free + length);
  }
  if (const Time ready = set_before(late); ready > late.start) {
    late.start = ready;
    late.end = std::max(late.end, ready + length);
  }
}

// Returns when the last task ends that is late, leaves an internal state which the link sets or needs just so, and
// should have ended before the link starts; 0 where there is none. A late task that takes away what the link needs is
// not waited for: the executive starts the link while the state holds.
Time Cycle::set_before(const Link& waiting) const {
  const model::Task& task = network_.tasks[waiting.task];
  const auto goes_behind = [&](const model::Impact& left) {
    if (left.kind != temporal::ImpactKind::assign || left.moment != temporal::ImpactWhen::at_end ||
        !network_.timelines[left.timeline].is_remembered())
      return false;
    bool concerns =
        std::ranges::find(task.impacts, left.timeline, &model::Impact::timeline) != task.impacts.end();
    for (const Constraint& needed : task.constraints) {
      if (needed.timeline != left.timeline) continue;
      if (!needed.admits(model::evaluate(left.amount, past_.values))) return false;
      concerns = true;
    }
    return concerns;
  };
  Time out{0};
  for (const Block& one : blocks_)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      const Link& each = one.links[i];
      const bool goes_first =
          each.planned < waiting.planned && (each.stage == Stage::running || each.stage == Stage::committed);
      if (!goes_first) continue;
      const Time should_start = each.stage == Stage::running ? each.start : each.planned;
      if (each.end <= waiting.start || should_start + length(one, i) > waiting.planned) continue;
      if (std::ranges::any_of(network_.tasks[each.task].impacts, goes_behind)) out = std::max(out, each.end);
    }
  return out;
}

}  // namespace roci::planner::utility_htn::cycle
