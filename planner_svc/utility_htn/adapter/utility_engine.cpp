#include "planner_svc/utility_htn/adapter/utility_engine.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "planner_svc/utility_htn/adapter/fit.hpp"
#include "planner_svc/utility_htn/adapter/products.hpp"
#include "planner_svc/utility_htn/adapter/resolvers.hpp"
#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"

namespace roci::planner::utility_htn::adapter {

using engine::Goal, engine::StepInputs, engine::StepOutput;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::Time;

namespace {

constexpr char kRequest[] = "request";

/// What is refused again and again is sent at last after 2 to the power of this intervals.
constexpr std::uint32_t kLongestPause = 5;

const std::string* argument(const Goal& goal, const std::string& name) {
  const auto found = std::ranges::find(goal.arguments, name, &temporal::Property::name);
  return found == goal.arguments.end() ? nullptr : &found->value;
}

}  // namespace

UtilityEngine::UtilityEngine(const engine::Setup& setup, model::Network network, cycle::Settings settings)
    : setup_(setup),
      network_(std::move(network)),
      chains_(flattening::flatten_all(network_)),
      assessor_(std::make_unique<assessor::SubwayAssessor>(network_, chains_)),
      settings_(settings),
      delivery_(network_) {
  const Resolvers chosen = read_resolvers(setup.resolvers);
  scheduler_ = search::make_scheduler(chosen.scheduler);
  if (chosen.search != cycle::Search::once) settings_.search = chosen.search;
}

UtilityEngine::~UtilityEngine() = default;

std::string UtilityEngine::packed_model() const { return reading::to_binary(network_); }

// The first cycle cannot commit what would have to start at once. What began before it and has no command, as a view of
// Earth, holds for the rest of its time; a command that is late is missed.
void UtilityEngine::begin_fixed(Time origin) {
  if (std::exchange(has_begun_, true)) return;
  const Time first = origin + network_.cycle.commit_window;
  for (model::Task& task : network_.tasks) {
    if (!task.fixed || task.preferred_start >= first) continue;
    if (task.commands.empty()) {
      const double late = temporal::to_seconds(first - task.preferred_start);
      if (late >= model::duration_s(task, cycle_->past().values)) continue;
      task.duration.constant -= late;
    } else if (task.preferred_start < origin) {
      continue;
    }
    task.preferred_start = first;
  }
}

StepOutput UtilityEngine::step(const StepInputs& inputs) {
  if (cycle_ == nullptr) {
    origin_ = next_cycle_ = inputs.now;
    cycle_ =
        std::make_unique<cycle::Cycle>(network_, chains_, *assessor_, *scheduler_, inputs.now, settings_);
    if (settings_.downlinks) cycle_->deliver_by(delivery_);
  }
  hear(inputs);
  StepOutput out;
  for (const engine::ModelChange& one : inputs.model_changes)
    out.model_answers.push_back(change(one, inputs.now));
  out.model = {network_.name, network_.version};
  await_ends(inputs.now);
  if (open_ && !goals_.empty() && inputs.now >= next_cycle_ && !plan_ended_) {
    const bool lost = versions_.give_up();  // for a whole interval nobody has answered
    begin_fixed(inputs.now);
    std::vector<cycle::Block> begun;
    std::ranges::copy_if(cycle_->blocks(), std::back_inserter(begun), &cycle::Block::begun);
    const cycle::Report report = cycle_->run(inputs.now);
    for (const cycle::Activity part : report.done) out.account.parts.emplace_back(to_string(part));
    out.account.explored = report.explored;
    out.account.notes = report.notes;
    while (next_cycle_ <= inputs.now) next_cycle_ += network_.cycle.process_interval;
    const bool again = refused_in_turn_ != 0 && inputs.now >= again_at_;
    if (report.changed || lost || versions_.base().version == 0 || to_tell_ || again) send(inputs, out);
    tell_outlook(report, begun, inputs.now, out);
  }
  out.blocking = blocking_;
  out.doubted = std::exchange(doubted_, {});
  if (open_ && !goals_.empty())
    out.wake = plan_ended_ ? *plan_ended_ + network_.cycle.process_interval : next_cycle_;
  return out;
}

// The word that the plan has ended may come before the word of how its last task ended.
// Who takes that for a failure does it twice.
void UtilityEngine::await_ends(Time now) {
  if (!plan_ended_) return;
  const auto runs = [](const cycle::Link& link) { return link.stage == cycle::Stage::running; };
  const bool any = std::ranges::any_of(
      cycle_->blocks(), [&](const cycle::Block& block) { return std::ranges::any_of(block.links, runs); });
  if (any && now < *plan_ended_ + network_.cycle.process_interval) return;
  plan_ended_.reset();
  cycle_->nothing_runs(now);
}

std::string UtilityEngine::learn(const std::string& parameter, double value) {
  const auto known = std::ranges::find(network_.parameters, parameter, &model::Parameter::name);
  if (known == network_.parameters.end()) return "the network has no parameter '" + parameter + "'";
  if (cycle_ == nullptr) return "nothing is planned yet";
  return cycle_->set_value(static_cast<model::ParameterIndex>(known - network_.parameters.begin()), value);
}

void UtilityEngine::hear(const StepInputs& inputs) {
  if (inputs.executed) {
    // It was reported before the timelines begin anew, which would take it for the past; so it counts as of now.
    for (const engine::Observation& one : inputs.observations)
      newest_.insert_or_assign(one.timeline, one.value);
    go_on_with(*inputs.executed, inputs.now);
  }
  for (const Goal& goal : inputs.goals) hear_goal(goal);
  for (const engine::EndedGoal& ended : inputs.ended_goals) hear_end(ended);
  for (const engine::Observation& observation : inputs.observations)
    if (!inputs.executed || !tasks_move(observation.timeline)) hear_observation(observation);
  for (const engine::StepStatus& step : inputs.steps) hear_step(step, inputs.now);
  for (const engine::CommandResult& result : inputs.results)
    if (task_of(result.activity)) measurements_.hear(result);
  measure();
  for (const engine::DataProduct& product : inputs.products) hear_product(product, inputs.now);
  if (inputs.receipt) hear_receipt(*inputs.receipt, inputs.now);
}

std::optional<model::TaskIndex> UtilityEngine::requested_by(const Goal& goal) const {
  if (goal.kind != kRequest) return std::nullopt;
  const std::string* const name = argument(goal, "task");
  if (name == nullptr) return std::nullopt;
  const auto task = std::ranges::find(network_.tasks, *name, &model::Task::id);
  if (task == network_.tasks.end()) return std::nullopt;
  return static_cast<model::TaskIndex>(task - network_.tasks.begin());
}

void UtilityEngine::hear_goal(const Goal& goal) {
  const auto known = std::ranges::find(goals_, goal.key(), &Goal::key);
  known == goals_.end() ? goals_.push_back(goal) : void(*known = goal);
  if (goal.kind != kRequest) return;
  std::erase_if(blocking_, [&](const auto& one) { return one.issuer == goal.issuer && one.id == goal.id; });
  if (const auto task = requested_by(goal)) {
    cycle_->request(*task);
  } else {
    const std::string* const name = argument(goal, "task");
    blocking_.push_back({goal.issuer, goal.id, "",
                         name == nullptr ? "a request names its task in the argument 'task'"
                                         : "the network has no task '" + *name + "'"});
  }
}

void UtilityEngine::hear_end(const engine::EndedGoal& ended) {
  const auto known = std::ranges::find_if(
      goals_, [&](const Goal& goal) { return goal.issuer == ended.issuer && goal.id == ended.id; });
  if (known == goals_.end()) return;
  const auto task = requested_by(*known);
  if (task && ended.state != engine::GoalState::achieved) cycle_->withdraw(*task);
  goals_.erase(known);
  std::erase_if(blocking_, [&](const auto& one) { return one.issuer == ended.issuer && one.id == ended.id; });
}

// Of an internal timeline only the ground says anything, and its word counts as that of who reports.
// Claims are nobody's to set.
void UtilityEngine::hear_observation(const engine::Observation& observation) {
  newest_.insert_or_assign(observation.timeline, observation.value);
  const auto timeline =
      std::ranges::find(network_.timelines, observation.timeline, &temporal::timelines::Definition::name);
  if (timeline == network_.timelines.end() || timeline->is_claim()) return;
  if (const auto number = number_of(*timeline, observation.value)) {
    cycle_->observe(static_cast<temporal::timelines::Index>(timeline - network_.timelines.begin()),
                    observation.sampled, *number);
    if (!timeline->reported) to_tell_ = true;  // the plan keeps it for who comes after
  }
}

// What tasks have made of an internal timeline since the ground has set it stands in the plan that is executed.
bool UtilityEngine::tasks_move(const std::string& timeline) const {
  const auto known = std::ranges::find(network_.timelines, timeline, &temporal::timelines::Definition::name);
  if (known == network_.timelines.end() || known->reported) return false;
  const auto index = static_cast<temporal::timelines::Index>(known - network_.timelines.begin());
  return std::ranges::any_of(network_.tasks, [&](const model::Task& task) {
    return std::ranges::any_of(task.impacts, [&](const auto& impact) { return impact.timeline == index; });
  });
}

void UtilityEngine::hear_product(const engine::DataProduct& product, Time now) {
  const Time since = std::min(now, product.told > Time{0} ? product.told : now);
  if (!delivery_.hear(existing(network_, chains_, *cycle_, product), since)) return;
  cycle_->doubt();
  to_look_ = true;
}

// Only where something has changed: what is observed while all goes as foreseen moves no outlook.
void UtilityEngine::tell_outlook(const cycle::Report& report, const std::vector<cycle::Block>& begun_before,
                                 Time now, StepOutput& out) {
  const Situation situation{network_, chains_, *assessor_, *cycle_, delivery_, now};
  outlooks_.forgotten(situation, begun_before);
  if (!report.changed && report.explored == 0 && !std::exchange(to_look_, false)) return;
  to_look_ = false;
  if (settings_.downlinks)  // without the Downlink Manager there is no schedule to tell
    if (engine::DownlinkSchedule schedule = schedule_of(situation); schedule != told_schedule_) {
      out.schedule = told_schedule_ = std::move(schedule);
      delivery_.told(products_by_task(told_schedule_));
    }
  if (engine::MissionOutlook outlook = outlooks_.make(situation); outlook != told_outlook_)
    out.outlook = told_outlook_ = std::move(outlook);
}

void UtilityEngine::hear_step(const engine::StepStatus& step, Time now) {
  if (initial_ && step.activity == initial_->id && temporal::is_over(step.progress.state)) initial_.reset();
  const auto task = task_of(step.activity);
  if (!task) return;
  if (step.progress.started) cycle_->begun(*task, *step.progress.started);
  if (!temporal::is_over(step.progress.state)) {
    if (std::exchange(attempts_[*task], step.attempt) < step.attempt && step.attempt > 1)
      cycle_->tried_again(*task, now);
    return;
  }
  attempts_.erase(*task);
  const Time at = step.progress.ended.value_or(step.progress.started.value_or(origin_));
  if (const auto index = task_of_activity(network_, step.activity);
      index < network_.tasks.size() && step.progress.started)
    delivery_.executed(*task, index, *step.progress.started, at, cycle_->past().values);
  cycle_->ended(*task, at, step.progress.state == ActivityState::succeeded, step.cause);
  measurements_.hear(step);
}

void UtilityEngine::hear_receipt(const engine::Receipt& receipt, Time now) {
  open_ = receipt.open;
  if (!receipt.conflict.empty()) cycle_->doubt();
  if (versions_.hear(receipt)) plan_ended_ = now;
  if (receipt.version != 0) plan_ended_.reset();
  const std::uint32_t refused = versions_.refused_in_turn();
  if (refused > refused_in_turn_)
    again_at_ = now + network_.cycle.process_interval * (1 << std::min(refused, kLongestPause));
  refused_in_turn_ = refused;
}

// Another process sent what is executed, or it is not what this one sent last: the plan goes on from there.
void UtilityEngine::go_on_with(const FlexiblePlan& executed, Time now) {
  // It may have been made with the network before the one in force.
  const Fitted fitted = fit(network_, chains_, executed);
  Recovered recovered = recover(network_, chains_, fitted.plan);
  recovered.last_block = std::max({recovered.last_block, fitted.last_block, cycle_->last_block()});
  for (const temporal::PlanActivity& gone : fitted.gone)
    recovered.points.set(*task_of(gone.id), gone.start_point, gone.end_point);
  if (std::exchange(goes_on_, true)) {
    recovered.past.values = cycle_->past().values;
    recovered.past.withdrawn = cycle_->past().withdrawn;
    recovered.past.contingent = cycle_->past().contingent;
    recovered.past.done.insert(cycle_->past().done.begin(), cycle_->past().done.end());
    recovered.measured.insert(measurements_.taken().begin(), measurements_.taken().end());
  }
  to_tell_ = to_tell_ || fitted.foreign;
  measurements_.resume(std::move(recovered.measured));
  origin_ = executed.origin;
  points_ = recovered.points;
  begin_fixed(origin_);
  initial_.reset();
  for (const temporal::PlanActivity& activity : executed.activities)
    if (is_initial(activity)) {
      initial_ = activity;
      points_.set(Points::kInitial, activity.start_point, activity.end_point);
    }
  // What ended since then has moved timelines that nobody reports.
  const Time since = std::min(now, recovered.past_until.value_or(now));
  cycle_->resume(recovered.past, std::move(recovered.blocks), recovered.last_block, since);
  for (const auto& [timeline, value] : std::map(newest_))
    if (!tasks_move(timeline)) hear_observation({timeline, value, now});
  versions_.resume(executed);
  next_cycle_ = now;
}

std::vector<std::string> UtilityEngine::served_goals() const {
  std::vector<std::string> out;
  for (const Goal& goal : goals_)
    if (goal.kind != kRequest) out.push_back(goal.key());
  return out;
}

// What serves a request alone serves it and nothing else.
void UtilityEngine::serve_requests(FlexiblePlan& plan) const {
  for (const Goal& goal : goals_) {
    const auto task = requested_by(goal);
    if (!task) continue;
    for (const cycle::Block& block : cycle_->blocks()) {
      if (chains_.chains[block.chain].task != *task) continue;
      for (temporal::PlanActivity& activity : plan.activities) {
        const auto id = task_of(activity.id);
        if (id && cycle::block_of(*id) == block.number && activity.commit == temporal::CommitState::planned)
          activity.goals_served = {goal.key()};
      }
    }
  }
}

void UtilityEngine::send(const StepInputs& inputs, StepOutput& out) {
  const FlexiblePlan& told = versions_.base();
  // What is committed ends by itself; what is not would wait for ever in a plan that nothing else is left of.
  const auto waits = [](const temporal::PlanActivity& one) {
    return one.commit == temporal::CommitState::planned;
  };
  if (cycle_->blocks().empty() && std::ranges::none_of(told.activities, waits)) return;
  const bool whole = told.version == 0;
  if (whole) {
    origin_ = inputs.now;
    points_ = {};
  }
  forget_measurements();
  const Frame frame{setup_.engine, setup_.robot,   inputs.last_version + 1,
                    origin_,       served_goals(), measurements_.taken()};
  points_.keep_only(cycle_->blocks(), initial_.has_value());
  FlexiblePlan plan = plan_of(network_, chains_, *cycle_, frame, told, points_);
  serve_requests(plan);
  if (whole) {
    initial_ = initial_activity(network_, cycle_->past(), frame);
    std::tie(initial_->start_point, initial_->end_point) = points_.of(Points::kInitial);
    if (initial_->impacts.empty()) initial_.reset();
  } else if (!initial_ && !unannounced_.empty()) {
    initial_ = initial_activity(network_, cycle_->past(), frame);
    std::tie(initial_->start_point, initial_->end_point) = points_.of(Points::kInitial);
    std::erase_if(initial_->impacts,
                  [&](const auto& impact) { return !unannounced_.contains(impact.timeline); });
  }
  if (initial_) unannounced_.clear();
  if (initial_) plan.activities.insert(plan.activities.begin(), *initial_);
  plan.point_count = points_.count();
  out.delta = temporal::difference(told, plan);
  versions_.send(std::move(plan));
  to_tell_ = false;
  goes_on_ = true;
}

}  // namespace roci::planner::utility_htn::adapter
