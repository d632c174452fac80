#include "planner_svc/utility_htn/cycle/cycle.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "planner_svc/utility_htn/cycle/claims.hpp"
#include "planner_svc/utility_htn/cycle/early_end.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::cycle {

using model::TaskIndex;
using temporal::Duration, temporal::Time;
using temporal::timelines::Constraint, temporal::timelines::Index;

namespace {

constexpr double kNothingReported = -std::numeric_limits<double>::infinity();

// A search places and takes back all the time, and few tasks stand on one timeline: so changes shall be cheap.
temporal::timelines::Extent lines_from(Time origin) { return {.origin = origin, .block = 24}; }

bool is_request(const model::Task& task) { return !task.is_template; }

}  // namespace

const char* to_string(Activity part) {
  constexpr const char* kNames[] = {"commit", "consolidate", "schedule", "repair", "optimize"};
  return kNames[static_cast<std::size_t>(part)];
}

Cycle::Cycle(const model::Network& network, const flattening::Chains& chains,
             const assessor::Assessor& assessor, const search::Scheduler& scheduler, Time origin,
             Settings settings)
    : network_(network),
      chains_(chains),
      assessor_(assessor),
      scheduler_(scheduler),
      settings_(settings),
      timelines_(network.timelines, lines_from(origin)),
      past_{.values = model::priors(network)},
      sessions_(network, chains),
      plan_end_(network.cycle.plan_end),
      observations_(network, settings.noticeable) {
  for (const auto& definition : network.timelines) past_.internal.push_back(definition.initial);
  for (TaskIndex task = 0; task < network.tasks.size(); ++task)
    if (is_request(network.tasks[task])) requested_.insert(task);
}

Block* Cycle::block(std::uint32_t number) {
  const auto found = std::ranges::lower_bound(blocks_, number, {}, &Block::number);
  return found != blocks_.end() && found->number == number ? &*found : nullptr;
}

Link* Cycle::link(TaskId task) {
  Block* const of = block(block_of(task));
  return of != nullptr && link_of(task) < of->links.size() ? &of->links[link_of(task)] : nullptr;
}

std::string Cycle::set_value(model::ParameterIndex parameter, double value) {
  const model::Parameter& known = network_.parameters[parameter];
  if (!known.permits(value))
    return known.name + " = " + model::to_text(value) + " is not between " + model::to_text(known.lowest) +
           " and " + model::to_text(known.highest) + "; the value before stays";
  if (past_.values[parameter] == value) return {};
  past_.values[parameter] = value;
  // What has not begun is placed anew: its starts are those of the value before.
  // The rest of what has begun takes what it takes now.
  for (Block& one : blocks_) {
    take_out(one);
    if (one.begun()) last_anew(one);
    if (one.begun() || !settings_.schedules_again) put_in(one);
  }
  if (settings_.schedules_again) std::erase_if(blocks_, [](const Block& one) { return !one.begun(); });
  to_schedule_ = to_optimize_ = true;
  return {};
}

void Cycle::resume(const Past& past, std::vector<Block> blocks, std::uint32_t last_block, Time since) {
  past_ = past;
  observations_.await_nothing();
  for (const TaskIndex task : past.withdrawn) requested_.erase(task);
  std::erase_if(requested_, [&](TaskIndex task) { return failed_too_often(task); });
  requested_.insert(past.contingent.begin(), past.contingent.end());
  last_block_ = last_block;
  timelines_ = temporal::timelines::Timelines(network_.timelines, lines_from(since));
  for (Index i = 0; i < network_.timelines.size(); ++i)
    if (network_.timelines[i].is_remembered()) {
      timelines_.observe(i, since, past_.internal[i]);
      observations_.note(i, since, past_.internal[i]);
    }
  blocks_ = std::move(blocks);
  for (const Block& one : blocks_) put_in(one);
  to_schedule_ = to_optimize_ = true;
}

Report Cycle::run(Time now) {
  Report report;
  report.notes = std::exchange(notes_, {});
  searched_ = {};
  const auto does = [&](Activity what, bool changes) {
    if (!changes) return;
    report.done.push_back(what);
    report.changed = true;
  };
  // Before the past is folded: what is left of a failed block may have its time there.
  for (Block& one : blocks_)
    if (one.failed()) abandon(one, "", report);
  believe_reports(now);
  fit_downlinks(now);
  does(Activity::commit, commit(now));
  if (consolidate(now)) report.done.push_back(Activity::consolidate);  // the plan is the same
  forget_over(report);
  report.changed |= settings_.repairs && end_with_budget(now, report);
  does(Activity::schedule, schedule(now, report));
  const bool surprised = to_optimize_ || report.changed;
  const bool reordered = surprised && keep_order(now, report);
  does(Activity::repair, (settings_.repairs && surprised && repair(now, report)) || reordered);
  if (settings_.optimizes) does(Activity::optimize, optimize(now, report));
  if (settings_.repairs && (surprised || report.changed)) settle(now, report);
  tell_losses(now, report);
  return report;
}

search::PlannedData Cycle::data() const { return data_of(blocks_, network_, chains_, past_.values); }

// What starts before the end of the commit window is the executive's from now on (R78).
bool Cycle::commit(Time now) {
  bool any = false;
  for (Block& one : blocks_) {
    if (one.failed()) continue;
    for (Link& each : one.links) {
      if (each.stage != Stage::planned || each.start >= now + network_.cycle.commit_window) continue;
      each.stage = Stage::committed;
      each.told = each.end - each.start;
      any = true;
    }
  }
  return any;
}

// Returns whether anything was folded that had been kept.
bool Cycle::consolidate(Time now) {
  to_optimize_ |= follow(now);
  const temporal::timelines::Kept before = timelines_.kept();
  timelines_.consolidate(now);
  const temporal::timelines::Kept after = timelines_.kept();
  for (Index i = 0; i < network_.timelines.size(); ++i)
    if (network_.timelines[i].is_remembered()) past_.internal[i] = timelines_.value(i, now);
  return after.tasks != before.tasks || after.events != before.events || after.asks != before.asks;
}

// Blocks that are over leave; their requests are done, or wait for another try.
void Cycle::forget_over(Report& report) {
  std::erase_if(blocks_, [&](const Block& one) {
    if (!one.over()) return false;
    report.changed = true;
    const TaskIndex task = chains_.chains[one.chain].task;
    if (!one.failed()) {
      past_.done.insert(task);
      past_.contingent.erase(task);
      past_.failures.erase(task);
    } else if (++past_.failures[task]; failed_too_often(task)) {
      give_up(task);
      report.notes.push_back(network_.tasks[task].id + " is withdrawn: it failed " +
                             std::to_string(settings_.most_failures) + " times");
    }
    to_schedule_ = true;
    return true;
  });
}

void Cycle::last_anew(Block& begun) const {
  for (std::size_t i = 0; i < begun.links.size(); ++i)
    if (waits(begun.links[i])) begun.links[i].end = begun.links[i].start + length(begun, i);
}

void Cycle::take_out(const Block& gone) {
  for (std::size_t i = 0; i < gone.links.size(); ++i)
    if (is_placed(gone.links[i])) timelines_.remove(task_id(gone.number, i));
}

void Cycle::put_in(const Block& placed) {
  for (std::size_t i = 0; i < placed.links.size(); ++i) {
    const Link& each = placed.links[i];
    if (!is_placed(each)) continue;
    timelines_.place(task_id(placed.number, i), footprint(placed, i), each.start);
    timelines_.move(task_id(placed.number, i), each.start, each.end);
  }
}

Duration Cycle::duration(TaskIndex task) const {
  return temporal::seconds(model::duration_s(network_.tasks[task], past_.values));
}

Duration Cycle::length(const Block& block, std::size_t link) const {
  const TaskIndex task = block.links[link].task;
  return delivery_ != nullptr && network_.tasks[task].downlinks
             ? sessions_.length(blocks_, block, link, *delivery_, past_.values)
             : duration(task);
}

// Returns until when a downlink that stands may last, at most until the wanted time: something that is fixed or
// committed may need the same then, what it needs itself ends, as a view of Earth does, or the mission does.
Time Cycle::room_until(const Link& of, Time wanted) const {
  Time out = std::min({wanted, free_until(network_, blocks_, of), plan_end_, network_.tasks[of.task].closes});
  for (const Constraint& needed : network_.tasks[of.task].constraints) {
    const bool lasting = needed.phase == temporal::timelines::Phase::maintenance &&
                         network_.timelines[needed.timeline].kind == temporal::timelines::Kind::state;
    if (!lasting || !needed.admits(timelines_.value(needed.timeline, of.start))) continue;
    for (const auto& each : timelines_.trajectory(needed.timeline, of.start, out))
      if (!needed.admits(each.value)) out = std::min(out, std::max(of.start, each.time));
  }
  return out;
}

// Returns whether a downlink that is not committed now, and that nothing fixed cuts short, has a place later where it
// may last as long as this.
bool Cycle::lasts_later(const Block& of, std::size_t link, Duration takes, Time now) {
  const Link& each = of.links[link];
  if (each.start < now + network_.cycle.commit_window) return false;
  if (each.start + takes > free_until(network_, blocks_, each)) return false;
  const std::size_t mark = timelines_.mark();
  timelines_.remove(task_id(of.number, link));
  temporal::timelines::Footprint seen = footprint(of, link);
  seen.duration = takes;
  const Duration gap = chains_.chains[of.chain].links[link].longest_gap;
  const Time latest = link == 0 ? temporal::no_bound : temporal::plus(of.links[link - 1].end, gap);
  const std::optional<Placement> later = soonest(of, link, seen, {each.start, latest});
  timelines_.undo(mark);
  return later && later->length >= takes;
}

// Data that turned out larger or smaller than foreseen make planned downlinks longer or shorter (R127). One that would
// outlast its view of Earth is moved by repair if all of it has room in a later one; else what does not go with it
// waits for another downlink.
void Cycle::fit_downlinks(Time now) {
  if (delivery_ == nullptr) return;
  sessions_.look(blocks_, *delivery_);
  for (Block& one : blocks_)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      Link& each = one.links[i];
      if (each.stage != Stage::planned || !one.begun() || one.failed()) continue;
      if (!network_.tasks[each.task].downlinks) continue;
      Duration takes = length(one, i);
      const Duration room = room_until(each, each.start + takes) - each.start;
      if (takes > room && !lasts_later(one, i, takes, now))
        takes = sessions_.length(blocks_, one, i, *delivery_, past_.values, room);
      if (takes == each.end - each.start) continue;
      each.end = each.start + takes;
      timelines_.move(task_id(one.number, i), each.start, each.end);
      to_optimize_ = true;
    }
}

std::vector<double> Cycle::values_now(Time now) const {
  std::vector<double> out;
  for (Index i = 0; i < network_.timelines.size(); ++i) out.push_back(timelines_.value(i, now));
  return out;
}

temporal::timelines::Footprint Cycle::footprint(const Block& block, std::size_t link) const {
  return flattening::footprint(network_, chains_.chains[block.chain], link, past_.values);
}

std::vector<const Block*> Cycle::by_start() const {
  std::vector<const Block*> out;
  for (const Block& one : blocks_) out.push_back(&one);
  std::ranges::stable_sort(out, {}, [](const Block* one) { return one->links.front().start; });
  return out;
}

// Returns what is in the budget when all that is placed has been paid.
double Cycle::budget() const {
  Time end = plan_end_;
  if (!temporal::bounded(end)) {
    end = Time{0};
    for (const Block& one : blocks_)
      for (const Link& each : one.links) end = std::max(end, each.end);
  }
  return timelines_.value(network_.budget, end) - network_.timelines[network_.budget].lowest;
}

bool Cycle::end_with_budget(Time now, Report& report) {
  const double reported = observations_.newest(network_.budget).value_or(kNothingReported);
  const auto ends = early_end(network_, past_.values, timelines_, blocks_, now, reported);
  if (!ends) {
    if (plan_end_ <= now) plan_end_ = network_.cycle.plan_end;  // it lasts after all
    return false;
  }
  Link& load = block(ends->load)->links.front();
  load.end = plan_end_ = ends->end;
  timelines_.move(task_id(ends->load, 0), load.start, load.end);
  report.notes.push_back("the budget does not last to the end of the mission: it is planned to " +
                         temporal::to_text(plan_end_));
  std::vector<std::uint32_t> beyond;
  for (const Block& other : blocks_) {
    const model::Task& last = network_.tasks[other.links.back().task];
    const bool from_outside = last.fixed && last.commands.empty();
    if (!other.begun() && !from_outside && other.links.back().end > plan_end_) beyond.push_back(other.number);
  }
  for (const std::uint32_t number : beyond) drop(*block(number), "the mission ends before", report);
  to_schedule_ = to_optimize_ = true;
  return true;
}

}  // namespace roci::planner::utility_htn::cycle
