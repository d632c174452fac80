#include "exec_svc/reactor/reactor.hpp"

#include <algorithm>
#include <utility>

#include "exec_svc/reactor/decision_exchange.hpp"
#include "exec_svc/reactor/ground_orders.hpp"
#include "exec_svc/reactor/inputs.hpp"
#include "exec_svc/reactor/lost_components.hpp"
#include "exec_svc/reactor/message_fields.hpp"
#include "exec_svc/reactor/plan_recovery.hpp"
#include "exec_svc/reactor/replanning_policy.hpp"

namespace roci::exec::reactor {

using executive::Observation;
using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalSet;
using goals::GoalState;
using mission::MissionModel;
using temporal::Time;

struct Reactor::Parts {
  explicit Parts(const MissionModel& mission) : state(mission) { ground.reinstate(); }

  MissionState state;
  RunningPlan plan{state};
  DecisionExchange decisions;
  PlannerCall call{state};
  Safing safing{state, plan};
  LostComponents lost{state, call, safing};
  PlanningCycle planning{state, plan, call, safing};
  PlanRecovery recovery{state, plan, call, safing};
  GroundOrders ground{state, plan, safing};
  std::unique_ptr<ReplanningPolicy> policy = make_replanning_policy(
      state.mission->executive.replanning, {state, plan, call, safing, planning, recovery});
};

Reactor::Reactor(const MissionModel& mission) : parts_(std::make_unique<Parts>(mission)) {}
Reactor::~Reactor() = default;
Reactor::Reactor(Reactor&&) noexcept = default;
Reactor& Reactor::operator=(Reactor&&) noexcept = default;

void Reactor::restore(const std::vector<GoalRecord>& goals, std::uint32_t last_plan_version) {
  MissionState& state = parts_->state;
  for (const GoalRecord& record : goals) {
    state.goals.restore(record);
    if (state.goals.find(record.request.key)->state != GoalState::rejected)
      assume_unobserved(state, record.request);
  }
  parts_->plan.restore_version(last_plan_version);
  if (!state.goals.open().empty()) state.want_plan("restarted with open goals");
}

ReactorOutputs Reactor::step(Time now, const ReactorInputs& came_in) {
  MissionState& state = parts_->state;
  state.out = {};
  std::optional<ReactorInputs> with_more;  // what the ground sets and answers comes in beside the rest
  if (!came_in.ground_orders.empty()) parts_->ground.obey(now, with_more.emplace(came_in));
  const auto counted = parts_->lost.step(now, came_in);
  if (!counted.empty()) {
    if (!with_more) with_more.emplace(came_in);
    with_more->observations.insert(with_more->observations.end(), counted.begin(), counted.end());
  }
  const ReactorInputs& inputs = with_more ? *with_more : came_in;
  for (const Observation& observation : inputs.observations)
    state.beliefs.observe(observation.timeline, observation.value);
  take_services(inputs);
  parts_->lost.hold_planning();
  for (const ModelVersion& newer : parts_->call.note_models(inputs.models)) parts_->plan.note_newer(newer);
  if (take_goals(state, now, inputs.goals)) parts_->planning.keep_reserves();
  if (take_handed_over(state, inputs.handed_over)) parts_->planning.keep_reserves();
  note_achieved(state, now);
  parts_->plan.give_answers(parts_->decisions.admit(inputs.answers, state.out));
  parts_->plan.step(now, inputs);
  parts_->decisions.note_results(parts_->plan.answer_results(), state.out);
  parts_->recovery.note_successes();
  if (inputs.restarted) resume(now);
  parts_->policy->step(now, inputs);
  parts_->safing.take(inputs.acks);
  parts_->safing.watch(now);
  finish_if_done();
  parts_->decisions.note_changes(state.out.decisions);
  parts_->ground.settle();
  return std::move(state.out);
}

void Reactor::restore_authority(mission::AutonomyLevel level, bool held) {
  parts_->state.authority.set_level(level);
  parts_->state.authority.hold_all(held);
  parts_->ground.reinstate();
}

void Reactor::restore_concluded(const std::map<std::string, temporal::Value>& concluded) {
  for (const auto& [timeline, value] : concluded) parts_->state.beliefs.conclude(timeline, value);
  parts_->plan.restore_concluded(concluded);
}

void Reactor::take_services(const ReactorInputs& inputs) {
  MissionState& state = parts_->state;
  for (const PeerLoss& loss : inputs.losses) {
    state.report(Severity::warning, "service.lost", loss.service + " was lost: " + loss.reason);
    if (loss.observes) parts_->call.note_lost(loss.service);
  }
  for (const std::string& service : inputs.arrivals) {
    state.report(Severity::info, "service.found", service + " is there");
    parts_->call.note_found(service);
    if (state.phase == MissionPhase::safe && !state.goals.open().empty())
      state.want_plan(service + " came back");
    parts_->call.clear_failures();
    parts_->call.wait_until(Time{0});
    parts_->safing.expect_fallbacks_again();  // one that came back has not heard them
  }
}

/// Asks again for what was on its way to owners and planner.
void Reactor::resume(Time now) {
  MissionState& state = parts_->state;
  state.report(Severity::info, "executive.resumed",
               std::string("goes on where it was: ") + to_string(state.phase) +
                   (state.phase == MissionPhase::executing ? " " + parts_->plan.name() : ""));
  parts_->plan.resume(now);
  parts_->policy->resume(now);
  parts_->safing.resume();
}

void Reactor::finish_if_done() {
  MissionState& state = parts_->state;
  const bool resting = state.phase == MissionPhase::idle || state.phase == MissionPhase::finished;
  if (resting && !state.replan_wanted && state.goals.open().empty() && !state.goals.all().empty())
    state.phase = MissionPhase::finished;
}

bool Reactor::at_rest() const {
  const OutcomeKind kind = parts_->plan.outcome().kind;
  const bool may_be_relaunched = phase() == MissionPhase::safe && kind == OutcomeKind::cancelled;
  return phase() != MissionPhase::executing && !may_be_relaunched &&
         (kind == OutcomeKind::idle || kind == OutcomeKind::finished || kind == OutcomeKind::cancelled);
}

namespace {

/// Lists what each part keeps of itself, in one order for both ways.
template <class Archive, class Parts>
void part_fields(Archive& archive, Parts& parts) {
  MissionState::fields(archive, parts.state);
  RunningPlan::fields(archive, parts.plan);
  DecisionExchange::fields(archive, parts.decisions);
  GroundOrders::fields(archive, parts.ground);
  PlannerCall::fields(archive, parts.call);
  Safing::fields(archive, parts.safing);
  PlanningCycle::fields(archive, parts.planning);
  PlanRecovery::fields(archive, parts.recovery);
  LostComponents::fields(archive, parts.lost);
}

}  // namespace

std::string Reactor::snapshot() const {
  archive::Writer writer;
  part_fields(writer, std::as_const(*parts_));
  std::vector<GoalRecord> goals;
  for (const GoalRecord* record : parts_->state.goals.all()) goals.push_back(*record);
  writer(goals, parts_->state.beliefs.values(), parts_->state.beliefs.assumed(),
         parts_->state.beliefs.concluded(), parts_->plan.remaining());
  parts_->policy->save(writer);
  return writer.take();
}

void Reactor::restore(std::string_view snapshot) {
  archive::Reader reader(snapshot);
  part_fields(reader, *parts_);
  std::vector<GoalRecord> goals;
  std::map<std::string, temporal::Value> values, concluded;
  std::map<std::string, std::vector<std::string>> assumed;
  std::vector<PlannedAction> remaining;
  reader(goals, values, assumed, concluded, remaining);
  parts_->policy->restore(reader);
  reader.finish();
  parts_->ground.reinstate();
  MissionState& state = parts_->state;
  for (const GoalRecord& record : goals) state.goals.restore(record);
  std::vector<Observation> observed;
  for (auto& [timeline, value] : values) {
    state.beliefs.observe(timeline, value);
    observed.push_back({timeline, value});
  }
  parts_->plan.restore_observations(observed);
  parts_->plan.keep_actions(std::move(remaining));
  restore_concluded(concluded);
  for (auto& [timeline, facts] : assumed) state.beliefs.assume(timeline, std::move(facts));
}

const temporal::FlexiblePlan& Reactor::plan() const { return parts_->plan.executive().plan(); }

const std::vector<PlannedAction>& Reactor::planned_actions() const { return parts_->plan.planned(); }

const std::optional<ExecutedPlan>& Reactor::last_executed() const { return parts_->plan.last_executed(); }

std::vector<StepStatus> Reactor::steps() const { return parts_->plan.executive().steps(); }

MissionPhase Reactor::phase() const { return parts_->state.phase; }

std::uint32_t Reactor::plan_version() const { return parts_->plan.version(); }

const GoalSet& Reactor::goals() const { return parts_->state.goals; }

bool Reactor::plans_continuously() const { return parts_->policy->receipt() != nullptr; }

const PlanReceipt& Reactor::receipt() const {
  static const PlanReceipt kNone;
  const PlanReceipt* receipt = parts_->policy->receipt();
  return receipt == nullptr ? kNone : *receipt;
}

const std::map<std::string, DecisionRecord>& Reactor::decisions() const {
  return parts_->decisions.decisions();
}

std::vector<AnswerReceipt> Reactor::answer_receipts() const { return parts_->decisions.receipts(); }

std::vector<orders::OrderStatus> Reactor::order_statuses() const { return parts_->ground.book().all(); }

std::map<std::string, temporal::Value> Reactor::ground_values() const {
  auto out = parts_->ground.values();
  for (auto& [timeline, value] : out) value = parts_->plan.executive().value_of(timeline).value_or(value);
  return out;
}

const std::map<std::string, temporal::Value>& Reactor::observed() const {
  return parts_->state.beliefs.values();
}

const std::map<std::string, temporal::Value>& Reactor::concluded() const {
  return parts_->state.beliefs.concluded();
}

std::map<std::string, temporal::Value> Reactor::told_conclusions() const {
  std::map<std::string, temporal::Value> out = concluded();
  std::erase_if(out, [&](const auto& one) { return !parts_->state.tells_conclusion(one.first); });
  return out;
}

mission::AutonomyLevel Reactor::autonomy() const { return parts_->state.authority.level(); }

bool Reactor::held() const { return parts_->state.authority.held(); }

ReactorCounts Reactor::counts() const {
  ReactorCounts counts = parts_->state.counts;
  for (const GoalRecord* record : goals().all()) {
    if (record->state == GoalState::achieved) ++counts.achieved;
    if (record->state == GoalState::dropped) ++counts.dropped;
    if (record->state == GoalState::failed) ++counts.failed;
    if (record->state == GoalState::rejected) ++counts.rejected;
    if (!is_final(record->state)) ++counts.open;
  }
  return counts;
}

std::string Reactor::outcome() const {
  const bool ground_goes_on =
      !parts_->state.authority.may_replan();  // a release or a relaunch may still come
  if (phase() == MissionPhase::safe && (ground_goes_on || parts_->lost.awaits())) return "";
  if (phase() == MissionPhase::safe) return parts_->state.beliefs.active().empty() ? "partial" : "failed";
  if (phase() != MissionPhase::finished) return "";
  auto asked = goals().all();
  std::erase_if(asked, [](const GoalRecord* record) {
    return record->state == GoalState::rejected && from_console(record->request);
  });
  const bool every_hard_goal = std::all_of(asked.begin(), asked.end(), [](const GoalRecord* record) {
    return record->request.importance != GoalClass::hard || record->state == GoalState::achieved ||
           record->state == GoalState::recalled;
  });
  return every_hard_goal && !asked.empty() ? "achieved" : "partial";
}

}  // namespace roci::exec::reactor
