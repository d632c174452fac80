#include "exec_svc/executive/executive.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "exec_svc/executive/plan_run.hpp"
#include "exec_svc/executive/timeline_store.hpp"

namespace roci::exec::executive {

struct Executive::Impl {
  ExecutiveSettings settings;
  Permissions permissions;
  TimelineStore store;
  std::unique_ptr<PlanRun> run;
  temporal::FlexiblePlan no_plan;
  temporal::Time now{0};
  std::uint64_t epoch = 0;
  std::uint64_t ignored_acks = 0;
  std::uint64_t ignored_answers = 0;

  /// Time does not run backwards here, whatever the caller's clock does.
  void move_to(temporal::Time time) {
    now = std::max(now, time);
    store.advance(now);
  }

  std::vector<std::string> load(temporal::FlexiblePlan plan, temporal::Time time, AfterStop stopped) {
    std::vector<std::string> faults = check(plan);
    if (!faults.empty()) return faults;
    move_to(time);
    const std::unique_ptr<PlanRun> before = std::move(run);
    run = std::make_unique<PlanRun>(std::move(plan), settings, permissions, store, epoch);
    if (before) run->adopt(*before, now, stopped);
    return {};
  }

  std::vector<AnswerResult> take_answers(const std::vector<DecisionAnswer>& given) {
    std::vector<AnswerResult> results;
    for (const DecisionAnswer& answer : given) {
      results.push_back(run ? run->take_answer(answer, now)
                            : AnswerResult{AnswerOutcome::unknown_decision, "no plan runs"});
      if (results.back().outcome != AnswerOutcome::taken) ++ignored_answers;
    }
    return results;
  }
};

Executive::Executive(ExecutiveSettings settings) : impl_(std::make_unique<Impl>()) {
  impl_->settings = settings;
}
Executive::~Executive() = default;
Executive::Executive(Executive&&) noexcept = default;
Executive& Executive::operator=(Executive&&) noexcept = default;

std::vector<std::string> Executive::load(temporal::FlexiblePlan plan, temporal::Time now) {
  return impl_->load(std::move(plan), now, AfterStop::starts_anew);
}

std::vector<std::string> Executive::load_again(temporal::FlexiblePlan plan, temporal::Time now) {
  return impl_->load(std::move(plan), now, AfterStop::goes_on);
}

Outputs Executive::step(temporal::Time now, const Inputs& inputs) {
  impl_->move_to(now);
  for (const Observation& observation : inputs.observations)
    impl_->store.observe(observation.timeline, observation.value);
  for (const Observation& set : inputs.settings) impl_->store.set(set.timeline, set.value);
  PlanRun* run = impl_->run.get();
  if (inputs.epoch != 0) impl_->epoch = inputs.epoch;
  if (inputs.epoch != 0 && run) run->begin_epoch(inputs.epoch);
  for (const CommandAck& ack : inputs.acks)
    if (!run || !run->take_ack(ack, impl_->now)) ++impl_->ignored_acks;
  std::vector<AnswerResult> answers = impl_->take_answers(inputs.answers);
  if (!run) return {.answers = std::move(answers)};
  for (const std::string& owner : inputs.lost_owners) run->lose_owner(owner, impl_->now);
  for (const std::string& owner : inputs.found_owners) run->find_owner(owner, impl_->now);
  run->advance(impl_->now);
  Outputs outputs = run->take_outputs(impl_->now);
  outputs.answers = std::move(answers);
  return outputs;
}

Outputs Executive::resume(temporal::Time now) {
  impl_->move_to(now);
  if (!impl_->run) return {};
  impl_->run->resume(impl_->now);
  return impl_->run->take_outputs(impl_->now);
}

Outputs Executive::cancel_all(temporal::Time now) {
  impl_->move_to(now);
  if (!impl_->run) return {};
  impl_->run->cancel_all(impl_->now);
  return impl_->run->take_outputs(impl_->now);
}

void Executive::hold_starts(bool hold) {
  if (impl_->run) impl_->run->hold_starts(hold);
}

void Executive::permit(Permissions permissions) { impl_->permissions = std::move(permissions); }

bool Executive::drop(const std::string& activity, const std::string& reason) {
  return impl_->run && impl_->run->drop(activity, reason);
}

void Executive::set_contingency(Contingency contingency) {
  const std::string name = contingency.name;
  impl_->settings.contingencies[name] = std::move(contingency);
}

bool Executive::contingency_under_way(const std::string& name) const {
  return impl_->run && impl_->run->contingency_under_way(name);
}

std::vector<StepStatus> Executive::running() const {
  return impl_->run ? impl_->run->running() : std::vector<StepStatus>{};
}

Outcome Executive::outcome() const { return impl_->run ? impl_->run->outcome() : Outcome{}; }

const temporal::FlexiblePlan& Executive::plan() const {
  return impl_->run ? impl_->run->plan() : impl_->no_plan;
}

const temporal::PlanActivity* Executive::activity(const std::string& id) const {
  return impl_->run ? impl_->run->find(id) : nullptr;
}

std::vector<StepStatus> Executive::steps() const {
  return impl_->run ? impl_->run->statuses() : std::vector<StepStatus>{};
}

std::vector<StepStatus> Executive::upcoming(std::size_t most) const {
  return impl_->run ? impl_->run->upcoming(most) : std::vector<StepStatus>{};
}

std::uint64_t Executive::window_work() const { return impl_->run ? impl_->run->window_work() : 0; }

std::vector<Executive::TokenStatus> Executive::tokens() const {
  return impl_->run ? impl_->run->tokens() : std::vector<TokenStatus>{};
}

std::optional<temporal::Value> Executive::value_of(const std::string& timeline) const {
  return impl_->store.value_of(timeline);
}

std::uint64_t Executive::ignored_acks() const { return impl_->ignored_acks; }
std::uint64_t Executive::ignored_answers() const { return impl_->ignored_answers; }

}  // namespace roci::exec::executive
