#include "planner_svc/utility_htn/adapter/plan_of.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/temporal/activity_timeline.hpp"

namespace roci::planner::utility_htn::adapter {

using cycle::Block, cycle::Link, cycle::Stage, cycle::TaskId;
using temporal::CommitState, temporal::Condition, temporal::ConditionOp, temporal::ConstraintKind,
    temporal::Duration, temporal::FlexiblePlan, temporal::PlanActivity, temporal::TimePoint;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

namespace {

constexpr char kInitialPrefix[] = "network#";

/// Bounds the wait of a task that names no timeout itself.
constexpr Duration kWait = temporal::seconds(3600);

Condition condition_of(const Definition& timeline, const Constraint& constraint) {
  std::vector<Condition> parts;
  if (timeline.kind == Kind::state) {
    for (std::size_t i = 0; i < timeline.states.size(); ++i)
      if ((constraint.states >> i & 1U) != 0)
        parts.push_back(
            temporal::compare(timeline.name, ConditionOp::eq, value_of(timeline, static_cast<double>(i))));
    return temporal::any_of(parts);
  }
  if (std::isfinite(constraint.lowest))
    parts.push_back(temporal::compare(timeline.name, ConditionOp::ge, constraint.lowest));
  if (std::isfinite(constraint.highest))
    parts.push_back(temporal::compare(timeline.name, ConditionOp::le, constraint.highest));
  return temporal::all_of(parts);
}

Condition condition_of(const model::Network& network, const std::vector<Constraint>& constraints,
                       std::optional<Phase> phase) {
  std::vector<Condition> parts;
  for (const Constraint& one : constraints)
    if (!phase || one.phase == *phase) parts.push_back(condition_of(network.timelines[one.timeline], one));
  if (parts.empty()) return {};
  return parts.size() == 1 ? parts.front() : temporal::all_of(parts);
}

// What a task claims must be free when it starts: tasks that are late may otherwise hold it at once.
Condition claims_of(const model::Network& network, const model::Task& task, const model::Values& values) {
  std::vector<Condition> parts;
  for (const model::Impact& impact : task.impacts) {
    const Definition& timeline = network.timelines[impact.timeline];
    if (timeline.is_claim())
      parts.push_back(temporal::compare(timeline.name, ConditionOp::le,
                                        timeline.highest - model::evaluate(impact.amount, values)));
  }
  return parts.empty() ? Condition{} : temporal::all_of(parts);
}

Condition both(const Condition& a, const Condition& b) {
  if (a.empty()) return b;
  return b.empty() ? a : temporal::all_of({a, b});
}

void command(const model::Task& task, PlanActivity& out) {
  if (task.commands.empty()) return;
  const temporal::PlanCommand& first = task.commands.front();
  out.owner = first.owner;
  if (!first.robot.empty()) out.robot = first.robot;
  out.subsystem = first.subsystem;
  out.command_name = first.command_name;
  out.arguments = first.arguments;
  out.answer_within = std::min(first.answer_within, task.control.answer_within);
  out.then.assign(task.commands.begin() + 1, task.commands.end());
}

void impacts(const model::Network& network, const model::Task& task, const model::Values& values,
             PlanActivity& out) {
  for (const model::Impact& impact : task.impacts) {
    if (impact.kind == temporal::ImpactKind::rate && impact.moment != temporal::ImpactWhen::during) continue;
    const Definition& timeline = network.timelines[impact.timeline];
    const double amount = model::evaluate(impact.amount, values);
    const bool state = impact.kind == temporal::ImpactKind::assign;
    out.impacts.push_back({timeline.name, impact.kind, impact.moment,
                           state ? value_of(timeline, amount) : temporal::Value{amount}});
  }
}

PlanActivity activity_of(const model::Network& network, const model::Values& values, const Frame& frame,
                         const Link& link) {
  const model::Task& task = network.tasks[link.task];
  PlanActivity out;
  out.name = task.id;
  out.robot = frame.robot;
  command(task, out);
  impacts(network, task, values, out);
  out.duration_lower =
      task.downlinks ? link.end - link.start : temporal::seconds(model::duration_s(task, values));
  out.preferred_start = link.start - frame.origin;
  out.pre = both(condition_of(network, task.constraints, Phase::pre), claims_of(network, task, values));
  out.maintenance = condition_of(network, task.constraints, Phase::maintenance);
  out.post = condition_of(network, task.constraints, Phase::post);
  out.skip_if = condition_of(network, task.control.skip_if, std::nullopt);
  out.wait_timeout = temporal::bounded(task.control.wait_timeout) ? task.control.wait_timeout : kWait;
  out.retries = task.control.retries;
  out.may_skip = task.control.may_skip;
  out.lateness = temporal::LatenessPolicy::push;
  out.failure = temporal::FailureScope::of_activity;
  out.commit = link.stage == Stage::planned ? CommitState::planned : CommitState::committed;
  out.priority = task.priority;
  out.goals_served = frame.goals;
  out.utility = model::utility(task, values);
  return out;
}

// A link that follows one without success is skipped.
void depend(const std::string& before, PlanActivity& activity) {
  const Condition failed = temporal::negate(
      temporal::compare(temporal::activity_timeline(before), ConditionOp::eq,
                        temporal::state(temporal::to_string(temporal::ActivityState::succeeded))));
  activity.skip_if = activity.skip_if.empty() ? failed : temporal::any_of({failed, activity.skip_if});
}

using Told = std::unordered_map<std::string, const PlanActivity*>;

void add_block(const model::Network& network, const flattening::Chain& chain, const Block& block,
               const model::Values& values, const Frame& frame, const Told& told, Points& points,
               FlexiblePlan& plan) {
  const TimePoint first = points.of(cycle::task_id(block.number, 0)).first;
  TimePoint last = first;
  TimePoint end_before = temporal::origin_point;  // none
  for (std::size_t i = 0; i < block.links.size(); ++i) {
    const Link& link = block.links[i];
    const TaskId id = cycle::task_id(block.number, i);
    const auto [start, end] = points.of(id);
    last = end;
    if (link.stage == Stage::failed) {
      end_before = temporal::origin_point;  // what is committed behind it is skipped
      continue;
    }
    const std::string name = activity_id(network, link, id);
    const auto known = told.find(name);
    if (known != told.end() && known->second->commit == CommitState::committed) {
      plan.activities.push_back(*known->second);
    } else {
      PlanActivity activity = activity_of(network, values, frame, link);
      activity.id = name;
      activity.start_point = start;
      activity.end_point = end;
      if (i == 0) activity.pre = both(activity.pre, condition_of(network, chain.when, std::nullopt));
      if (i > 0)
        depend(activity_id(network, block.links[i - 1], cycle::task_id(block.number, i - 1)), activity);
      plan.activities.push_back(std::move(activity));
    }
    plan.constraints.push_back({temporal::origin_point, start, ConstraintKind::window,
                                std::max(link.planned - frame.origin, Duration{0}), temporal::no_bound});
    if (end_before != temporal::origin_point)
      plan.constraints.push_back(
          {end_before, start, ConstraintKind::ordering, chain.links[i].shortest_gap, temporal::no_bound});
    end_before = end;
  }
  plan.tokens.push_back({network.tasks[chain.task].id,
                         temporal::state(chain.name, {std::to_string(block.number)}), first, last});
}

}  // namespace

std::pair<TimePoint, TimePoint> Points::of(TaskId task) {
  const auto found = of_.find(task);
  if (found != of_.end()) return found->second;
  TimePoint free = kPast + 1;
  for (auto taken = taken_.begin(); taken != taken_.end() && *taken == free; ++taken) free += 2;
  set(task, free, free + 1);
  return {free, free + 1};
}

void Points::set(TaskId task, TimePoint start, TimePoint end) {
  of_[task] = {start, end};
  for (const TimePoint point : {start, end}) taken_.insert(point & ~TimePoint{1});
}

void Points::keep_only(const std::vector<Block>& blocks, bool initial) {
  const auto number = [](const Block& block) { return block.number; };
  std::erase_if(of_, [&](const auto& entry) {
    if (entry.first == kInitial) return !initial;
    return !std::ranges::binary_search(blocks, cycle::block_of(entry.first), {}, number);
  });
  taken_.clear();
  for (const auto& [task, points] : of_)
    for (const TimePoint point : {points.first, points.second}) taken_.insert(point & ~TimePoint{1});
}

std::uint32_t Points::count() const { return taken_.empty() ? kPast + 1 : *taken_.rbegin() + 2; }

FlexiblePlan plan_of(const model::Network& network, const flattening::Chains& chains,
                     const cycle::Cycle& cycle, const Frame& frame, const FlexiblePlan& told,
                     Points& points) {
  FlexiblePlan out;
  out.id = frame.engine;
  out.version = frame.version;
  out.engine = frame.engine;
  out.origin = frame.origin;
  const cycle::Past& past = cycle.past();
  Told known;
  for (const PlanActivity& activity : told.activities) known.emplace(activity.id, &activity);
  for (const Block& block : cycle.blocks())
    add_block(network, chains.chains[block.chain], block, past.values, frame, known, points, out);
  const auto remember = [&](const std::string& name, temporal::Value value) {
    out.tokens.push_back({name, std::move(value), temporal::origin_point, Points::kPast});
  };
  for (const model::TaskIndex task : past.done) remember("done." + network.tasks[task].id, true);
  for (const model::TaskIndex task : past.withdrawn) remember("withdrawn." + network.tasks[task].id, true);
  for (const model::TaskIndex task : past.contingent) remember("contingent." + network.tasks[task].id, true);
  for (const auto& [task, times] : past.failures)
    remember("failed." + network.tasks[task].id, static_cast<double>(times));
  for (std::size_t i = 0; i < past.values.size(); ++i)
    if (past.values[i] != network.parameters[i].prior)
      remember("parameter." + network.parameters[i].name, past.values[i]);
  for (std::size_t i = 0; i < network.timelines.size(); ++i)
    if (network.timelines[i].is_remembered())
      remember("internal." + network.timelines[i].name, value_of(network.timelines[i], past.internal[i]));
  for (const std::string& activity : frame.measured) remember("measured." + activity, true);
  for (const auto& [sol, joules] : frame.spent_j) remember("downlinks." + std::to_string(sol), joules);
  remember(kPastUntil, temporal::to_seconds(cycle.timelines().past()));
  remember(kLastBlock, static_cast<double>(cycle.last_block()));
  out.point_count = points.count();
  return out;
}

bool is_initial(const PlanActivity& activity) { return activity.id.starts_with(kInitialPrefix); }

PlanActivity initial_activity(const model::Network& network, const cycle::Past& past, const Frame& frame) {
  PlanActivity out;
  out.id = kInitialPrefix + std::to_string(frame.version);
  out.name = "begin";
  out.robot = frame.robot;
  out.lateness = temporal::LatenessPolicy::push;
  out.wait_timeout = kWait;
  out.failure = temporal::FailureScope::of_activity;
  out.commit = CommitState::committed;
  out.goals_served = frame.goals;
  for (std::size_t i = 0; i < network.timelines.size(); ++i)
    if (!network.timelines[i].reported)
      out.impacts.push_back({network.timelines[i].name, temporal::ImpactKind::assign,
                             temporal::ImpactWhen::at_start,
                             value_of(network.timelines[i], past.internal[i])});
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
