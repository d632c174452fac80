#include "planner_svc/utility_htn/cycle/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner_svc/utility_htn/cycle/early_end.hpp"
#include "planner_svc/utility_htn/search/robust.hpp"

namespace roci::planner::utility_htn::cycle {

using model::TaskIndex;
using temporal::Duration, temporal::Time;
using temporal::timelines::Index;

namespace {

bool waits(const Link& link) { return link.stage == Stage::planned || link.stage == Stage::committed; }

// Nothing is expected to be later than it is by more than this.
constexpr Duration kFarthestExpectation = std::chrono::hours(1);

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
      deviation_(network.timelines.size(), 0.0) {
  for (const auto& definition : network.timelines) past_.internal.push_back(definition.initial);
  for (TaskIndex task = 0; task < network.tasks.size(); ++task)
    if (is_request(network.tasks[task])) requested_.insert(task);
}

void Cycle::observe(Index timeline, Time sampled, double value) {
  const auto& definition = network_.timelines[timeline];
  const double foreseen = timelines_.value(timeline, sampled);
  timelines_.observe(timeline, sampled, value);
  if (const auto known = reported_.find(timeline);
      known == reported_.end() || known->second.sampled <= sampled)
    reported_.insert_or_assign(timeline, Reported{sampled, value});
  if (definition.kind == temporal::timelines::Kind::state) {
    to_optimize_ |= foreseen != value;
    return;
  }
  deviation_[timeline] += std::abs(value - foreseen);
  const double first = std::max(std::abs(definition.initial), 1e-9);
  to_optimize_ |= deviation_[timeline] > settings_.noticeable * first;
}

Block* Cycle::block(std::uint32_t number) {
  const auto found = std::ranges::lower_bound(blocks_, number, {}, &Block::number);
  return found != blocks_.end() && found->number == number ? &*found : nullptr;
}

Link* Cycle::link(TaskId task) {
  Block* const of = block(block_of(task));
  return of != nullptr && link_of(task) < of->links.size() ? &of->links[link_of(task)] : nullptr;
}

void Cycle::begun(TaskId task, Time at) {
  Link* const one = link(task);
  if (one == nullptr || !waits(*one)) return;
  to_optimize_ |= one->start != at;
  *one = {one->task, one->planned, at, at + length(*block(block_of(task)), link_of(task)), Stage::running};
  timelines_.move(task, at, one->end);
}

void Cycle::tried_again(TaskId task, Time at) {
  Link* const one = link(task);
  if (one == nullptr || one->stage != Stage::running) return;
  one->end = std::max(one->start, at) + length(*block(block_of(task)), link_of(task));
  timelines_.move(task, one->start, one->end);
  to_optimize_ = true;
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
  if (const model::Task& done = network_.tasks[one->task]; succeeded && !done.commands.empty())
    for (const model::Impact& impact : done.impacts)
      if (model::sets_reported_state(network_, impact)) unreported_[impact.timeline] = at;
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
  std::erase_if(unreported_, [&](const auto& unreported) {
    const auto [timeline, since] = unreported;
    const auto newest = reported_.find(timeline);
    if (newest == reported_.end() || newest->second.sampled > since) return true;
    if (now < since + network_.cycle.process_interval) return false;
    observe(timeline, now, newest->second.value);
    return true;
  });
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

std::string Cycle::set_value(model::ParameterIndex parameter, double value) {
  const model::Parameter& known = network_.parameters[parameter];
  if (!known.permits(value))
    return known.name + " = " + std::to_string(value) + " is not between " + std::to_string(known.lowest) +
           " and " + std::to_string(known.highest) + "; the value before stays";
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

void Cycle::resume(const Past& past, std::vector<Block> blocks, std::uint32_t last_block, Time now) {
  past_ = past;
  unreported_.clear();
  for (const TaskIndex task : past.withdrawn) requested_.erase(task);
  last_block_ = last_block;
  timelines_ = temporal::timelines::Timelines(network_.timelines, lines_from(now));
  for (Index i = 0; i < network_.timelines.size(); ++i)
    if (network_.timelines[i].is_remembered()) timelines_.observe(i, now, past_.internal[i]);
  blocks_ = std::move(blocks);
  for (const Block& one : blocks_) put_in(one);
  to_schedule_ = to_optimize_ = true;
}

Report Cycle::run(Time now) {
  Report report;
  report.notes = std::exchange(notes_, {});
  const auto does = [&](Activity what, bool changes) {
    if (!changes) return;
    report.done.push_back(what);
    report.changed = true;
  };
  // Before the past is folded: what is left of a failed block may have its time there.
  for (Block& one : blocks_)
    if (one.failed()) abandon(one, "", report);
  believe_reports(now);
  fit_downlinks();
  does(Activity::commit, commit(now));
  if (consolidate(now)) report.done.push_back(Activity::consolidate);  // the plan is the same
  forget_over(report);
  report.changed |= settings_.repairs && end_with_budget(now, report);
  does(Activity::schedule, schedule(now, report));
  const bool surprised = to_optimize_ || report.changed;
  const bool reordered = surprised && keep_order(now, report);
  does(Activity::repair, (settings_.repairs && surprised && repair(now, report)) || reordered);
  if (settings_.optimizes) does(Activity::optimize, optimize(now, report));
  if (settings_.repairs && report.changed) settle(now, report);
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

// What should have begun or ended by now and has not is expected to be late by as much again, an hour more at most
// (R76). So what is long overdue moves the plan a few times and not in every cycle.
// Returns whether what is expected has changed.
bool Cycle::follow(Time now) {
  bool changed = false;
  for (Block& one : blocks_)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      const Link before = one.links[i];
      if (before.stage == Stage::committed) await_start(one, i, now);
      if (before.stage == Stage::running && before.end <= now) {
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
// and holds what it needs until then.
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
  if (const Time free = free_for(late); free > late.start) {
    late.start = free;
    late.end = std::max(late.end, free + length);
  }
}

// Returns when what the link claims is given back by all that runs, and by all that waits longer than it does.
Time Cycle::free_for(const Link& waiting) const {
  Time out{0};
  for (const model::Impact& claim : network_.tasks[waiting.task].impacts) {
    const auto& timeline = network_.timelines[claim.timeline];
    if (!timeline.is_claim()) continue;
    double taken = model::evaluate(claim.amount, past_.values);
    Time given_back{0};
    for (const Block& one : blocks_)
      for (const Link& holder : one.links) {
        const bool holds = holder.stage == Stage::running ||
                           (holder.stage == Stage::committed && holder.planned < waiting.planned);
        if (!holds || &holder == &waiting || holder.end <= waiting.start) continue;
        for (const model::Impact& impact : network_.tasks[holder.task].impacts) {
          if (impact.timeline != claim.timeline) continue;
          taken += model::evaluate(impact.amount, past_.values);
          given_back = std::max(given_back, holder.end);
        }
      }
    if (taken > timeline.highest) out = std::max(out, given_back);
  }
  return out;
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
    } else if (++failures_[task] >= settings_.most_failures) {
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

// Returns when something begins behind the link that claims what the link claims and does not give way.
Time Cycle::free_until(const Link& of) const {
  Time out = temporal::no_bound;
  for (const model::Impact& claim : network_.tasks[of.task].impacts) {
    if (!network_.timelines[claim.timeline].is_claim()) continue;
    for (const Block& one : blocks_)
      for (const Link& each : one.links) {
        const model::Task& task = network_.tasks[each.task];
        const bool stands = task.fixed || each.stage == Stage::committed;
        if (stands && is_placed(each) && each.start >= of.end &&
            std::ranges::find(task.impacts, claim.timeline, &model::Impact::timeline) != task.impacts.end())
          out = std::min(out, each.start);
      }
  }
  return out;
}

// Data that turned out larger or smaller than foreseen make planned downlinks longer or shorter (R127); what would run
// into something fixed or committed goes with a later one.
void Cycle::fit_downlinks() {
  if (delivery_ == nullptr) return;
  sessions_.look(blocks_, *delivery_);
  for (Block& one : blocks_)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      Link& each = one.links[i];
      if (each.stage != Stage::planned || !one.begun() || one.failed()) continue;
      const Duration now = each.end - each.start;
      Duration takes = length(one, i);
      if (takes > now) takes = std::max(now, std::min(takes, free_until(each) - each.start));
      if (takes == now) continue;
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
  const auto newest = reported_.find(network_.budget);
  const double reported = newest != reported_.end() ? newest->second.value : kNothingReported;
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

search::Problem Cycle::problem_for(Time now, const std::set<TaskIndex>& candidates,
                                   std::span<const double> newest) {
  search::Problem problem{network_, past_.values, chains_, assessor_, scheduler_, timelines_};
  problem.from = now + network_.cycle.commit_window;
  problem.until = plan_end_;
  problem.budget = budget();
  problem.timelines_now = newest;
  problem.first_id = TaskId{1} << 63U;
  for (const Block* one : by_start()) {
    search::Placed standing{one->chain, {}};
    for (const Link& each : one->links) standing.starts.push_back(each.start);
    problem.committed.push_back(std::move(standing));
  }
  problem.closed = closed_but(candidates, now);
  problem.standing = data();
  if (delivery_ != nullptr) delivery_->join(problem, now);
  return problem;
}

Cycle::Found Cycle::plan_for(Time now, const std::set<TaskIndex>& candidates, Report& report,
                             const search::Plan* known) {
  const std::vector<double> newest = values_now(now);
  search::Problem problem = problem_for(now, candidates, newest);
  const auto beats = [](const auto& worth, double cost, const auto& known_worth, double known_cost) {
    return worth > known_worth || (worth == known_worth && cost < known_cost - 1e-6);
  };
  if (!settings_.robust) {
    search::Outcome outcome = search::search(problem);
    report.explored += outcome.statistics.entries;
    const search::Plan& plan = outcome.plan;
    const bool better = known == nullptr || beats(plan.utility, plan.cost, known->utility, known->cost);
    return {std::move(outcome.plan), better};
  }
  const search::RobustSettings judging;
  search::RobustOutcome robust = search::search_robust(problem, judging, network_.exploration_bound);
  report.explored += robust.explored;
  const search::Candidate& chosen = robust.candidates[robust.chosen];
  const bool better = known == nullptr || beats(chosen.judged, chosen.plan.cost,
                                                search::judged(problem, *known, judging), known->cost);
  return {std::move(robust.outcome.plan), better};
}

bool Cycle::schedule(Time now, Report& report) {
  if (!to_schedule_ || (scheduled_ && !settings_.schedules_again)) return false;
  to_schedule_ = false;
  scheduled_ = true;
  const std::set<TaskIndex> waiting_requests = candidates(now);
  if (waiting_requests.empty()) return false;
  const search::Plan plan = plan_for(now, waiting_requests, report).plan;
  adopt(plan);
  return !plan.placed.empty();
}

void Cycle::adopt(const search::Plan& plan) {
  for (const search::Placed& placed : plan.placed) {
    Block added{++last_block_, placed.chain, {}};
    const auto& links = chains_.chains[placed.chain].links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Duration length = duration(links[i].task);
      added.links.push_back(
          {links[i].task, placed.starts[i], placed.starts[i], placed.starts[i] + length, Stage::planned});
    }
    put_in(added);
    blocks_.push_back(std::move(added));
  }
}

temporal::RankVector Cycle::predicted(std::uint32_t chain, std::span<const double> newest,
                                      std::span<const std::uint32_t> before,
                                      std::span<const TaskIndex> closed) const {
  const auto existing =
      delivery_ != nullptr ? delivery_->products() : std::span<const assessor::ExistingProduct>{};
  return assessor_.predicted(chain, {network_, past_.values, chains_, newest, existing, before, closed});
}

// Returns what has not begun as a plan, assessed as a search assesses its own.
search::Plan Cycle::planned(Time now) const {
  const std::vector<double> newest = values_now(now);
  const std::vector<TaskIndex> closed = this->closed(now);
  std::vector<std::uint32_t> before;
  search::Plan out;
  for (const Block* one : by_start()) {
    if (!one->begun()) {
      out.utility += predicted(one->chain, newest, before, closed);
      out.cost += flattening::cost(network_, chains_.chains[one->chain], past_.values);
      search::Placed standing{one->chain, {}};
      for (const Link& each : one->links) standing.starts.push_back(each.start);
      out.placed.push_back(std::move(standing));
    }
    before.push_back(one->chain);
  }
  return out;
}

// Plans all anew that has not begun, and changes the plan only for a better one (R101).
bool Cycle::optimize(Time now, Report& report) {
  if (!to_optimize_) return false;
  to_optimize_ = false;
  std::ranges::fill(deviation_, 0.0);
  const search::Plan old = planned(now);
  std::vector<Block> before;
  for (const Block& one : blocks_)
    if (!one.begun()) before.push_back(one);
  for (const Block& one : before) take_out(one);
  std::erase_if(blocks_, [](const Block& one) { return !one.begun(); });
  const Found found = plan_for(now, candidates(now), report, &old);
  if (found.better) {
    adopt(found.plan);
    return true;
  }
  for (Block& one : before) {
    put_in(one);
    blocks_.push_back(std::move(one));
  }
  std::ranges::sort(blocks_, {}, &Block::number);
  return false;
}

}  // namespace roci::planner::utility_htn::cycle
