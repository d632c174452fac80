#include "planner_svc/utility_htn/adapter/utility_engine.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner_svc/utility_htn/adapter/fit.hpp"
#include "planner_svc/utility_htn/adapter/index_of.hpp"
#include "planner_svc/utility_htn/adapter/products.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"

namespace roci::planner::utility_htn::adapter {

using engine::Goal, engine::StepInputs, engine::StepOutput;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::Time;

namespace {

constexpr std::uint32_t kBlocksOfAVersion = 1000, kMostVersions = 1'000'000;

}  // namespace

UtilityEngine::UtilityEngine(const engine::Setup& setup, model::Network network, cycle::Settings settings)
    : setup_(setup), planned_(std::move(network), settings, read_resolvers(setup.resolvers)) {}

std::string UtilityEngine::packed_model() const { return reading::to_binary(planned_.network()); }

StepOutput UtilityEngine::step(const StepInputs& inputs) {
  if (!planned_.has_begun()) {
    planned_.begin(inputs.now);
    published_.begin(inputs.now);
    next_cycle_ = inputs.now;
  }
  hear(inputs);
  StepOutput out;
  for (const engine::ModelChange& one : inputs.model_changes)
    out.model_answers.push_back(change(one, inputs.now));
  out.model = {planned_.network().name, planned_.network().version};
  await_ends(inputs.now);
  const bool plans = open_ && !goals_.empty();
  if (plans && inputs.now >= next_cycle_ && !plan_ended_) run_cycle(inputs, out);
  out.blocking = goals_.blocking();
  out.doubted = std::exchange(doubted_, {});
  if (plans) out.wake = plan_ended_ ? *plan_ended_ + planned_.network().cycle.process_interval : next_cycle_;
  return out;
}

void UtilityEngine::run_cycle(const StepInputs& inputs, StepOutput& out) {
  // Where no plan is executed, none tells which numbers another process of this run has used. A version brings far
  // fewer blocks than these.
  if (!goes_on_)
    planned_.cycle().number_beyond(std::min(inputs.last_version, kMostVersions) * kBlocksOfAVersion);
  const bool lost = published_.give_up();  // for a whole interval nobody has answered
  planned_.place_fixed_tasks(inputs.now);
  std::vector<cycle::Block> begun;
  std::ranges::copy_if(planned_.cycle().blocks(), std::back_inserter(begun), &cycle::Block::begun);
  const cycle::Report report = planned_.cycle().run(inputs.now);
  for (const cycle::Activity part : report.done) out.account.parts.emplace_back(to_string(part));
  out.account.explored = report.explored;
  out.account.notes = report.notes;
  while (next_cycle_ <= inputs.now) next_cycle_ += planned_.network().cycle.process_interval;
  if (report.changed || lost || published_.is_due(inputs.now)) send(inputs, out);
  outlook_.tell(planned_, report, begun, inputs.now, out);
}

void UtilityEngine::send(const StepInputs& inputs, StepOutput& out) {
  if (published_.is_over(planned_.cycle())) return;
  forget_measurements();
  const cycle::Cycle& cycle = planned_.cycle();
  const auto told = [&](cycle::TaskId task) {
    return std::ranges::count(cycle.blocks(), cycle::block_of(task), &cycle::Block::number) > 0;
  };
  Frame frame{setup_.engine,
              setup_.robot,
              inputs.last_version + 1,
              {},
              goals_.served_by_all(),
              measurements_.taken(),
              planned_.delivery().spent(told, inputs.now, cycle.past().values)};
  out.delta = published_.next(planned_, goals_, std::move(frame), inputs.now);
  goes_on_ = true;
}

// The word that the plan has ended may come before the word of how its last task ended.
// Who takes that for a failure does it twice.
void UtilityEngine::await_ends(Time now) {
  if (!plan_ended_) return;
  const auto runs = [](const cycle::Link& link) { return link.stage == cycle::Stage::running; };
  const bool any = std::ranges::any_of(planned_.cycle().blocks(), [&](const cycle::Block& block) {
    return std::ranges::any_of(block.links, runs);
  });
  if (any && now < *plan_ended_ + planned_.network().cycle.process_interval) return;
  plan_ended_.reset();
  planned_.cycle().nothing_runs(now);
}

std::string UtilityEngine::learn(const std::string& parameter, double value) {
  return planned_.learn(parameter, value);
}

engine::ModelAnswer UtilityEngine::change(const engine::ModelChange& change, Time now) {
  engine::ModelAnswer out{change.issuer, change.id, {}};
  if (change.model) {
    out.refused = replace_network(change, now);
  } else if (std::string fault = learn(change.parameter, change.value); !fault.empty()) {
    out.refused.push_back(std::move(fault));
  }
  if (out.refused.empty()) {
    published_.renew();
    outlook_.look_again();
    next_cycle_ = now;
  }
  return out;
}

std::vector<std::string> UtilityEngine::replace_network(const engine::ModelChange& change, Time now) {
  std::vector<std::string> refused;
  std::optional<model::Network> next = planned_.usable_network(change, refused);
  if (!next) return refused;
  const model::Network before = planned_.replace(std::move(*next), newest_, now);
  goals_.hear_again(planned_);
  for (const auto& timeline : planned_.network().timelines)
    if (!timeline.reported &&
        !index_of(before.timelines, timeline.name, &temporal::timelines::Definition::name))
      published_.introduce(timeline.name);
  return {};
}

void UtilityEngine::hear(const StepInputs& inputs) {
  if (inputs.executed) {
    // It was reported before the timelines begin anew, which would take it for the past; so it counts as of now.
    for (const engine::Observation& one : inputs.observations)
      newest_.insert_or_assign(one.timeline, one.value);
    go_on_with(*inputs.executed, inputs.now);
  }
  for (const Goal& goal : inputs.goals) goals_.hear(goal, planned_);
  for (const engine::EndedGoal& ended : inputs.ended_goals) goals_.hear(ended, planned_);
  for (const engine::Observation& observation : inputs.observations)
    if (!inputs.executed || !planned_.tasks_move(observation.timeline)) hear_observation(observation);
  for (const engine::StepStatus& step : inputs.steps) hear_step(step, inputs.now);
  for (const engine::CommandResult& result : inputs.results)
    if (task_of(result.activity)) measurements_.hear(result);
  measure();
  for (const engine::DataProduct& product : inputs.products) hear_product(product, inputs.now);
  if (inputs.receipt) hear_receipt(*inputs.receipt, inputs.now);
}

// Of an internal timeline only the ground says anything, and its word counts as that of who reports.
// Claims are nobody's to set.
void UtilityEngine::hear_observation(const engine::Observation& observation) {
  newest_.insert_or_assign(observation.timeline, observation.value);
  const auto& timelines = planned_.network().timelines;
  const auto index = index_of(timelines, observation.timeline, &temporal::timelines::Definition::name);
  if (!index || timelines[*index].is_claim()) return;
  if (const auto number = number_of(timelines[*index], observation.value)) {
    planned_.cycle().observe(*index, observation.sampled, *number);
    if (!timelines[*index].reported) published_.renew();  // the plan keeps it for who comes after
  }
}

void UtilityEngine::hear_product(const engine::DataProduct& product, Time now) {
  const Time since = std::min(now, product.told > Time{0} ? product.told : now);
  if (!planned_.delivery().hear(existing(planned_.network(), planned_.chains(), planned_.cycle(), product),
                                since))
    return;
  if (const auto task = task_of(product.source)) planned_.cycle().generated(*task, product.kind);
  planned_.cycle().doubt();
  outlook_.look_again();
}

void UtilityEngine::hear_step(const engine::StepStatus& step, Time now) {
  published_.hear(step);
  const auto task = task_of(step.activity);
  if (!task) return;
  cycle::Cycle& cycle = planned_.cycle();
  if (step.progress.started) cycle.begun(*task, *step.progress.started);
  if (!temporal::is_over(step.progress.state)) {
    if (std::exchange(attempts_[*task], step.attempt) < step.attempt && step.attempt > 1)
      cycle.tried_again(*task, now);
    return;
  }
  attempts_.erase(*task);
  const Time at = step.progress.ended.value_or(step.progress.started.value_or(published_.origin()));
  if (const auto index = task_of_activity(planned_.network(), step.activity);
      index < planned_.network().tasks.size() && step.progress.started)
    planned_.delivery().executed(*task, index, *step.progress.started, at, cycle.past().values);
  cycle.ended(*task, at, step.progress.state == ActivityState::succeeded, step.cause);
  measurements_.hear(step);
}

void UtilityEngine::hear_receipt(const engine::Receipt& receipt, Time now) {
  open_ = receipt.open;
  if (!receipt.conflict.empty()) planned_.cycle().doubt();
  if (published_.hear(receipt, now, planned_.network().cycle.process_interval)) plan_ended_ = now;
  if (receipt.version != 0) plan_ended_.reset();
}

// Another process sent what is executed, or it is not what this one sent last: the plan goes on from there.
void UtilityEngine::go_on_with(const FlexiblePlan& executed, Time now) {
  cycle::Cycle& cycle = planned_.cycle();
  // It may have been made with the network before the one in force.
  const Fitted fitted = fit(planned_.network(), planned_.chains(), executed);
  Recovered recovered = recover(planned_.network(), planned_.chains(), fitted.plan);
  recovered.last_block = std::max({recovered.last_block, fitted.last_block, cycle.last_block()});
  for (const temporal::PlanActivity& gone : fitted.gone)
    recovered.points.set(*task_of(gone.id), gone.start_point, gone.end_point);
  if (std::exchange(goes_on_, true)) {
    recovered.past.values = cycle.past().values;
    recovered.past.withdrawn = cycle.past().withdrawn;
    recovered.past.contingent = cycle.past().contingent;
    recovered.past.failures = cycle.past().failures;
    recovered.past.done.insert(cycle.past().done.begin(), cycle.past().done.end());
    recovered.measured.insert(measurements_.taken().begin(), measurements_.taken().end());
  } else {
    planned_.delivery().resume(recovered.spent_j);
  }
  if (fitted.foreign) published_.renew();
  measurements_.resume(std::move(recovered.measured));
  planned_.place_fixed_tasks(executed.origin);
  published_.resume(executed, std::move(recovered.points));
  // What ended since then has moved timelines that nobody reports.
  const Time since = std::min(now, recovered.past_until.value_or(now));
  cycle.resume(recovered.past, std::move(recovered.blocks), recovered.last_block, since);
  for (const auto& [timeline, value] : std::map(newest_))
    if (!planned_.tasks_move(timeline)) hear_observation({timeline, value, now});
  next_cycle_ = now;
}

}  // namespace roci::planner::utility_htn::adapter
