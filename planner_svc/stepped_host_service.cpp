#include "planner_svc/stepped_host_service.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "planner_svc/engine/checked_answer.hpp"
#include "planner_svc/limits.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

namespace topics = services::topics;
using engine::GoalState, engine::MakeStepped;
using temporal::FlexiblePlan, temporal::PlanDelta, temporal::Time;

namespace {

constexpr temporal::Duration kClockError = std::chrono::seconds(1);  // of two services; more is told

}  // namespace

SteppedHost::SteppedHost(services::Node& node, const Settings& settings, const engine::TableEntry& entry,
                         const std::filesystem::path& networks, const std::filesystem::path& steps)
    : node_(node),
      entry_(entry),
      orders_(node, settings, networks, [this] { loop_.step_soon(); }),
      setup_{settings.engine, node.options().robot, settings.model, settings.model_file, settings.resolvers},
      engine_(make_engine()),
      checker_(entry.make_checker()),
      records_(steps),
      inputs_([this](const char* what, std::size_t room) { publisher_.tell_refused(what, room); }),
      publisher_(node, setup_.robot),
      loop_(node, {[this] { begin_step(); },
                   [this](Time begun, StepLoop::Result result) { end_step(begun, std::move(result)); }}) {
  begin_record();
  subscribe_all();
  loop_.step_soon();
}

// Before the engine's first step: what it is made with is what the steps of the record are made again with.
void SteppedHost::begin_record() {
  records_.begin({setup_.engine, setup_.robot, setup_.resolvers, engine_->packed_model()});
}

void SteppedHost::record(const engine::StepOutcome& outcome) {
  records_.did(outcome);
  if (const std::string end = records_.take_end(); !end.empty())
    publisher_.report(v1::SEVERITY_WARNING, "planner.record_ended", end);
}

// A model of the ground that was kept is in force; one that cannot be used is told and forgotten.
std::shared_ptr<engine::SteppedEngine> SteppedHost::make_engine() {
  const MakeStepped& make = std::get<MakeStepped>(entry_.make);
  const std::filesystem::path kept = orders_.model_file();
  if (kept.empty()) return make(setup_);
  engine::Setup with_kept = setup_;
  with_kept.model_file = kept;
  try {
    std::shared_ptr<engine::SteppedEngine> out = make(with_kept);
    setup_ = with_kept;
    return out;
  } catch (const std::exception& error) {
    orders_.give_up_kept(error.what());
    return make(setup_);
  }
}

void SteppedHost::subscribe_all() {
  const auto subscribe = [this]<class Sample>(const services::topics::Topic<Sample>& topic) {
    services::subscribe(node_, topic, [this](const Sample& sample) { hear(sample); });
  };
  subscribe(topics::goal);
  subscribe(topics::goal_status);
  subscribe(topics::plan);
  subscribe(topics::plan_receipt);
  subscribe(topics::step_status);
  subscribe(topics::command_ack);
  subscribe(topics::data_product);
  subscribe(topics::observation);
}

// Team topics carry the words of all robots.
bool SteppedHost::is_ours(const v1::SampleHeader& header) const {
  return setup_.robot.empty() || header.robot().empty() || header.robot() == setup_.robot;
}

// A goal of the ground names its robot itself.
void SteppedHost::hear(const v1::Goal& goal) {
  if (!setup_.robot.empty() && !goal.robot().empty() && goal.robot() != setup_.robot) return;
  step_if(inputs_.hear(from_wire(goal)));
}

void SteppedHost::hear(const v1::GoalStatus& status) {
  if (!is_ours(status.header())) return;
  const auto state = std::min<std::uint32_t>(status.goal_state(), v1::GOAL_RECALLED);
  step_if(inputs_.hear_status(status.issuer(), status.id(), static_cast<GoalState>(state)));
}

void SteppedHost::hear(const v1::Plan& plan) {
  if (!is_ours(plan.header()) || plan.engine() != setup_.engine) return;
  versions_.note(plan.version());
  try {
    if (versions_.take(services::wire::from_wire(plan))) note_executed();
  } catch (const services::wire::WireError&) {
    return;
  }
}

void SteppedHost::hear(const v1::PlanReceipt& receipt) {
  if (!is_ours(receipt.header())) return;
  inputs_.note_executive(receipt.executive());
  versions_.hear(from_wire(receipt));
  note_executed();
}

void SteppedHost::hear(const v1::StepStatus& step) {
  if (!is_ours(step.header())) return;
  engine::StepStatus heard = from_wire(step);
  for (auto* const time : {&heard.progress.started, &heard.progress.ended})
    if (*time) *time = happened(**time, "a step");
  step_if(inputs_.hear(std::move(heard)));
}

// The executive tells of owners in whose place another one speaks.
void SteppedHost::hear(const v1::CommandAck& ack) {
  if (ack.stage() != v1::STAGE_COMPLETED || ack.epoch() == 0 || ack.header().sender() != ack.owner()) return;
  step_if(inputs_.hear(ack.commander(), from_wire(ack)));
}

void SteppedHost::hear(const v1::DataProduct& product) {
  if (!is_ours(product.header())) return;
  if (product.bytes() > kProductBytes)
    publisher_.tell_impossible("a data product",
                               "'" + product.id() + "' has " + std::to_string(product.bytes()) +
                                   " bytes, and counts as one of " + std::to_string(kProductBytes));
  step_if(inputs_.hear(from_wire(product)));
}

void SteppedHost::hear(const v1::Observation& observation) {
  try {
    engine::Observation heard = from_wire(observation);
    if (!is_possible(heard)) return;
    heard.sampled = happened(heard.sampled, "an observation");
    step_if(inputs_.hear(std::move(heard)));
  } catch (const services::wire::WireError&) {
    return;  // the executive tells it
  }
}

// What an engine fails at would be told to the next engine again, and again: the newest value of a timeline still
// counts. The value before it stays.
bool SteppedHost::is_possible(const engine::Observation& observation) {
  const auto* const number = std::get_if<double>(&observation.value);
  if (number == nullptr || std::abs(*number) <= kObservedAmount) return true;
  publisher_.tell_impossible(observation.timeline, "the value " + temporal::to_text(observation.value) +
                                                       " of '" + observation.timeline + "' is not believed");
  return false;
}

// Nothing is heard before it happens. Clocks of two services may differ by a little.
Time SteppedHost::happened(Time said, const std::string& what) {
  const Time now = node_.now();
  if (said <= now) return said;
  if (said - now > kClockError)
    publisher_.tell_impossible(
        "the time of " + what,
        "the time of " + what + " lies " + temporal::to_text(said - now) + " ahead, and counts as now");
  return now;
}

void SteppedHost::note_executed() {
  if (const FlexiblePlan* const executed = versions_.executed()) {
    orders_.executed(executed->version);
    inputs_.note_executed(*executed);
  }
  step_if(versions_.has_news());
}

void SteppedHost::step_if(bool news) {
  if (news) loop_.step_soon();
}

void SteppedHost::begin_step() {
  engine::StepInputs inputs = inputs_.take();
  inputs.now = node_.now();
  versions_.give(inputs);
  if (inputs.executed) inputs_.tell_again(inputs);
  inputs.model_changes = orders_.take();
  records_.heard(inputs);
  loop_.step(engine_, std::move(inputs));
}

void SteppedHost::end_step(Time begun, StepLoop::Result result) {
  record(engine::outcome_of(result.output, result.error));
  const bool heard_more = inputs_.waiting() || orders_.waiting();
  if (result.error.empty()) {
    take(begun, std::move(result.output));
  } else {
    publisher_.report(v1::SEVERITY_ERROR, "planner.defect",
                      "engine '" + setup_.engine + "' failed and is made anew: " + result.error);
    orders_.fail(result.error);
    make_anew();
  }
  if (heard_more) loop_.step_soon();
}

void SteppedHost::take(Time begun, engine::StepOutput output) {
  const auto model = orders_.answer(output.model_answers, output.model, versions_.last_version());
  if (model == NetworkOrders::Model::unkept) return make_anew();
  if (model == NetworkOrders::Model::replaced) setup_.model_file = orders_.model_file();
  for (const std::string& doubt : output.doubted)
    publisher_.report(v1::SEVERITY_WARNING, "planner.measured", doubt);
  publisher_.tell_account(output);
  if (output.delta) send(begun, *output.delta);
  publisher_.tell_outlook(begun, versions_.last_version(), output);
  publisher_.tell_blocking(std::move(output.blocking));
  const auto& receipt = versions_.receipt();
  if (!output.wake && !output.delta && receipt && receipt->version == 0) orders_.nothing_to_plan();
  // On the live clock the step may have lasted beyond that time.
  if (output.wake && *output.wake > begun) loop_.step_at(std::max(*output.wake, node_.now()));
}

void SteppedHost::send(Time begun, const PlanDelta& delta) {
  FlexiblePlan next;
  const std::string refusal = refusal_of(begun, delta, next);
  if (refusal.empty()) {
    publisher_.tell_version(delta);
    return versions_.sent(std::move(next));
  }
  publisher_.report(
      v1::SEVERITY_ERROR, "planner.defect",
      "version " + std::to_string(delta.added.version) + " of engine '" + setup_.engine + "' is " + refusal);
  versions_.refuse(delta.added.version, refusal);
}

std::string SteppedHost::refusal_of(Time begun, const PlanDelta& delta, FlexiblePlan& next) const {
  if (std::string fault = versions_.apply(delta, next); !fault.empty()) return fault;
  engine::Request situation;
  situation.engine = setup_.engine;
  situation.robot = setup_.robot;
  situation.origin = begun;
  situation.model = setup_.model;
  situation.state = inputs_.state();
  situation.goals = inputs_.open_goals();
  const FlexiblePlan* before = versions_.version(delta.from_version);
  return engine::refusal_of(
      *checker_, {situation, {}, next, before, before ? &inputs_.progress() : nullptr, setup_.model_file});
}

// The new engine hears again all that still counts, with the next thing that is heard.
void SteppedHost::make_anew() {
  engine_ = std::get<MakeStepped>(entry_.make)(setup_);  // its model was taken before
  begin_record();
  inputs_.engine_is_new(node_.now());
  versions_.engine_is_new();  // with what is executed the rest is told again
}

}  // namespace roci::planner
