#include "planner_svc/stepped_host_service.hpp"

#include <algorithm>
#include <exception>
#include <string_view>
#include <unordered_set>

#include "planner_svc/engine/checked_answer.hpp"
#include "planner_svc/limits.hpp"
#include "planner_svc/outlook_wire_service.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/node/make_event.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

using engine::BlockingGoal, engine::GoalState, engine::MakeStepped, engine::Receipt, engine::StepInputs;
using temporal::FlexiblePlan, temporal::PlanDelta, temporal::Time;

namespace {

namespace topics = services::topics;

bool is_open(GoalState state) { return state == GoalState::pending || state == GoalState::planned; }

std::size_t size_of(const std::string& name) { return name.size(); }
std::size_t size_of(const std::pair<std::string, std::string>& name) {
  return name.first.size() + name.second.size();
}
std::size_t size_of(const std::tuple<std::string, std::string, std::uint32_t>& name) {
  return std::get<0>(name).size() + std::get<1>(name).size();
}

std::string version_text(std::uint32_t version) { return "version " + std::to_string(version); }

}  // namespace

SteppedHost::SteppedHost(services::Node& node, const Settings& settings, const engine::TableEntry& entry,
                         const std::filesystem::path& networks, const std::filesystem::path& steps)
    : node_(node),
      entry_(entry),
      orders_(node, settings, networks, [this] { step_soon(); }),
      setup_{settings.engine, node.options().robot, settings.model, settings.model_file, settings.resolvers},
      engine_(make_engine()),
      records_(steps),
      checker_(entry.make_checker()),
      deltas_(services::advertise(node, topics::plan_delta)),
      schedules_(services::advertise(node, topics::downlink_schedule)),
      outlooks_(services::advertise(node, topics::mission_outlook)),
      events_(services::advertise(node, topics::event)),
      worker_(node) {
  begin_record();
  subscribe_all();
  step_soon();
}

// Before the engine's first step: what it is made with is what the steps of the record are made again with.
void SteppedHost::begin_record() {
  records_.begin({setup_.engine, setup_.robot, setup_.resolvers, engine_->packed_model()});
}

void SteppedHost::record(const engine::StepOutcome& outcome) {
  records_.did(outcome);
  if (const std::string end = records_.take_end(); !end.empty())
    report(v1::SEVERITY_WARNING, "planner.record_ended", end);
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
  services::subscribe(node_, topics::goal, [this](const v1::Goal& goal) { hear_goal(goal); });
  services::subscribe(node_, topics::goal_status,
                      [this](const v1::GoalStatus& status) { hear_status(status); });
  services::subscribe(node_, topics::plan, [this](const v1::Plan& plan) { hear_plan(plan); });
  services::subscribe(node_, topics::plan_receipt, [this](const v1::PlanReceipt& receipt) {
    if (!is_ours(receipt.header())) return;
    note_executive(receipt.executive());
    hear_receipt(from_wire(receipt));
  });
  services::subscribe(node_, topics::step_status, [this](const v1::StepStatus& step) {
    if (!is_ours(step.header())) return;
    if (!has_room(progress_, step.activity(), kActivities, "step")) return;
    heard_.steps.push_back(from_wire(step));
    progress_.insert_or_assign(step.activity(), heard_.steps.back().progress);
    step_soon();
  });
  services::subscribe(node_, topics::command_ack, [this](const v1::CommandAck& ack) { hear_result(ack); });
  services::subscribe(node_, topics::data_product, [this](const v1::DataProduct& product) {
    if (!is_ours(product.header()) || !has_room(products_, product.id(), kProducts, "data product")) return;
    engine::DataProduct heard = from_wire(product);
    engine::DataProduct& known = products_[product.id()];
    engine::DataProduct again = known;
    again.told = heard.told;
    if (again == heard) return;
    known = std::move(heard);
    heard_.products.push_back(known);
    step_soon();
  });
  services::subscribe(node_, topics::observation, [this](const v1::Observation& observation) {
    if (!has_room(state_, observation.timeline(), kTimelines, "timeline")) return;
    try {
      heard_.observations.push_back(from_wire(observation));
    } catch (const services::wire::WireError&) {
      return;  // the executive tells it
    }
    state_.insert_or_assign(observation.timeline(), heard_.observations.back().value);
    step_soon();
  });
}

// The executive refuses likewise, so that both know the same.
template <class Table>
bool SteppedHost::has_room(const Table& table, const typename Table::key_type& name, std::size_t room,
                           const char* what) {
  if (table.contains(name) || (table.size() < room && size_of(name) <= kNameBytes)) return true;
  if (const std::uint64_t count = refusals_.note(what))
    report(v1::SEVERITY_WARNING, "planner.no_room",
           std::string("a ") + what + " is not taken in: " + std::to_string(room) +
               " are kept at most, with names of at most " + std::to_string(kNameBytes) + " bytes (" +
               std::to_string(count) + " refused so far)");
  return false;
}

// Team topics carry the words of all robots.
bool SteppedHost::is_ours(const v1::SampleHeader& header) const {
  return setup_.robot.empty() || header.robot().empty() || header.robot() == setup_.robot;
}

void SteppedHost::hear_goal(const v1::Goal& goal) {
  if (!setup_.robot.empty() && !goal.robot().empty() && goal.robot() != setup_.robot) return;
  if (!has_room(goals_, Key{goal.issuer(), goal.id()}, kGoals, "goal")) return;
  HeardGoal& heard = goals_[{goal.issuer(), goal.id()}];
  engine::Goal now = from_wire(goal);
  const bool changed = heard.goal != now;
  heard.goal = std::move(now);
  note_goal({goal.issuer(), goal.id()}, heard, changed);
}

void SteppedHost::hear_status(const v1::GoalStatus& status) {
  if (!is_ours(status.header())) return;
  if (!has_room(goals_, Key{status.issuer(), status.id()}, kGoals, "goal")) return;
  HeardGoal& heard = goals_[{status.issuer(), status.id()}];
  heard.state = static_cast<GoalState>(std::min<std::uint32_t>(status.goal_state(), v1::GOAL_RECALLED));
  note_goal({status.issuer(), status.id()}, heard, false);
}

// A goal is the engine's from the executive's word that it is open to its word that it is not.
void SteppedHost::note_goal(const Key& key, HeardGoal& heard, bool changed) {
  const bool open = heard.goal && heard.state && is_open(*heard.state);
  if (open && (changed || !heard.told)) {
    heard.told = true;
    heard_.goals.push_back(*heard.goal);
    step_soon();
  } else if (!open && heard.told) {
    heard.told = false;
    heard_.ended_goals.push_back({key.first, key.second, *heard.state});
    step_soon();
  }
}

void SteppedHost::hear_plan(const v1::Plan& plan) {
  if (!is_ours(plan.header()) || plan.engine() != setup_.engine) return;
  versions_.note(plan.version());
  try {
    if (versions_.take(services::wire::from_wire(plan))) note_executed();
  } catch (const services::wire::WireError&) {
    return;
  }
}

// Before this is known results are kept of whoever commands.
void SteppedHost::note_executive(const std::string& executive) {
  if (!executive_.empty()) return;
  executive_ = executive;
  std::erase_if(results_, [&](const auto& one) { return std::get<0>(one.first) != executive_; });
  for (const auto& [key, result] : results_) heard_.results.push_back(result);
}

// The executive tells of owners in whose place another one speaks.
void SteppedHost::hear_result(const v1::CommandAck& ack) {
  if (ack.stage() != v1::STAGE_COMPLETED || ack.epoch() == 0 || ack.header().sender() != ack.owner()) return;
  if (!executive_.empty() && ack.commander() != executive_) return;
  const ResultKey key{ack.commander(), ack.activity(), ack.attempt()};
  if (!has_room(results_, key, kResults, "result")) return;
  engine::CommandResult result = from_wire(ack);
  const auto known = results_.find(key);
  if (known != results_.end() && known->second == result) return;
  results_.insert_or_assign(key, result);
  if (executive_.empty()) return;
  heard_.results.push_back(std::move(result));
  step_soon();
}

void SteppedHost::hear_receipt(const Receipt& receipt) {
  versions_.hear(receipt);
  note_executed();
}

void SteppedHost::note_executed() {
  if (const FlexiblePlan* const executed = versions_.executed()) {
    orders_.executed(executed->version);
    forget_steps_of_others(*executed);
  }
  if (versions_.has_news()) step_soon();
}

// What has left the plan never comes again by its id, and a long mission has no end of it.
void SteppedHost::forget_steps_of_others(const FlexiblePlan& plan) {
  std::unordered_set<std::string_view> ids;
  for (const temporal::PlanActivity& activity : plan.activities) ids.insert(activity.id);
  std::erase_if(progress_, [&](const auto& step) { return !ids.contains(step.first); });
  std::erase_if(results_, [&](const auto& one) { return !ids.contains(std::get<1>(one.first)); });
}

// Who goes on from a version that it did not send hears all that became of it.
void SteppedHost::tell_again(StepInputs& inputs) const {
  const std::uint32_t version = inputs.executed->version;
  std::vector<engine::StepStatus> steps;
  for (const auto& [activity, progress] : progress_) steps.push_back({version, activity, progress, "", 0});
  inputs.steps.insert(inputs.steps.begin(), steps.begin(), steps.end());
  inputs.results.clear();
  for (const auto& [key, result] : results_)
    if (std::get<0>(key) == executive_) inputs.results.push_back(result);
}

void SteppedHost::step_soon() {
  if (due_ || stepping_) return;  // the end of a step looks for what came meanwhile
  due_ = true;
  node_.at(node_.now(), [this] { begin_step(); });
}

void SteppedHost::begin_step() {
  due_ = false;
  if (stepping_) return;
  stepping_ = true;
  if (wake_) node_.cancel(*std::exchange(wake_, std::nullopt));
  StepInputs inputs = std::exchange(heard_, {});
  inputs.now = node_.now();
  versions_.give(inputs);
  if (inputs.executed) tell_again(inputs);
  inputs.model_changes = orders_.take();
  records_.heard(inputs);
  worker_.compute(
      [engine = engine_, inputs = std::move(inputs)](const std::stop_token&) {
        StepResult result;
        try {
          result.output = engine->step(inputs);
        } catch (const std::exception& error) {
          result.error = error.what();
        }
        return result;
      },
      [this, now = node_.now()](StepResult result) { end_step(now, std::move(result)); });
}

void SteppedHost::end_step(Time now, StepResult result) {
  stepping_ = false;
  record(engine::outcome_of(result.output, result.error));
  const bool heard_more = !heard_.goals.empty() || !heard_.ended_goals.empty() ||
                          !heard_.observations.empty() || !heard_.steps.empty() || !heard_.products.empty() ||
                          !heard_.results.empty() || heard_.receipt || heard_.executed || orders_.waiting();
  if (!result.error.empty()) {
    report(v1::SEVERITY_ERROR, "planner.defect",
           "engine '" + setup_.engine + "' failed and is made anew: " + result.error);
    orders_.fail(result.error);
    make_anew();
  } else if (const auto model =
                 orders_.answer(result.output.model_answers, result.output.model, versions_.last_version());
             model == NetworkOrders::Model::unkept) {
    make_anew();
  } else {
    if (model == NetworkOrders::Model::replaced) setup_.model_file = orders_.model_file();
    for (const std::string& doubt : result.output.doubted)
      report(v1::SEVERITY_WARNING, "planner.measured", doubt);
    tell_account(result.output);
    if (result.output.delta) send(now, *result.output.delta);
    tell_outlook(now, result.output);
    tell_blocking(std::move(result.output.blocking));
    const auto wake = result.output.wake;
    const auto& receipt = versions_.receipt();
    if (!wake && !result.output.delta && receipt && receipt->version == 0) orders_.nothing_to_plan();
    if (wake && *wake > node_.now())
      wake_ = node_.at(*wake, [this] {
        wake_.reset();
        begin_step();
      });
  }
  if (heard_more) step_soon();
}

void SteppedHost::send(Time now, const PlanDelta& delta) {
  FlexiblePlan next;
  const std::string refusal = refusal_of(now, delta, next);
  if (refusal.empty()) {
    deltas_.write(services::wire::to_wire(delta));
    return versions_.sent(std::move(next));
  }
  report(v1::SEVERITY_ERROR, "planner.defect",
         version_text(delta.added.version) + " of engine '" + setup_.engine + "' is " + refusal);
  versions_.refuse(delta.added.version, refusal);
}

std::string SteppedHost::refusal_of(Time now, const PlanDelta& delta, FlexiblePlan& next) const {
  if (std::string fault = versions_.apply(delta, next); !fault.empty()) return fault;
  engine::Request situation;
  situation.engine = setup_.engine;
  situation.robot = setup_.robot;
  situation.origin = now;
  situation.model = setup_.model;
  situation.state = state_;
  for (const auto& [key, heard] : goals_)
    if (heard.told) situation.goals.push_back(*heard.goal);
  const FlexiblePlan* before = versions_.version(delta.from_version);
  return engine::refusal_of(*checker_,
                            {situation, {}, next, before, before ? &progress_ : nullptr, setup_.model_file});
}

// The new engine hears again all that still counts, with the next thing that is heard.
void SteppedHost::make_anew() {
  engine_ = std::get<MakeStepped>(entry_.make)(setup_);  // its model was taken before
  begin_record();
  heard_ = {};
  for (const auto& [key, heard] : goals_)
    if (heard.told) heard_.goals.push_back(*heard.goal);
  for (const auto& [timeline, value] : state_) heard_.observations.push_back({timeline, value, node_.now()});
  for (const auto& [id, product] : products_) heard_.products.push_back(product);
  versions_.engine_is_new();  // with what is executed the rest is told again
}

// Before the version goes out: whoever sees both reads what led to it first.
void SteppedHost::tell_account(const engine::StepOutput& output) {
  if (const std::string text = engine::account_text(output); !text.empty())
    report(v1::SEVERITY_INFO, "planner.cycle", text);
}

void SteppedHost::tell_outlook(Time now, const engine::StepOutput& output) {
  const auto tell = [&](auto sample, const auto& publisher) {
    sample.robot(setup_.robot);
    sample.version(publisher.written() + 1);
    sample.plan_version(versions_.last_version());
    sample.made_us(now.count());
    sample.network(output.model.name);
    sample.network_version(output.model.version);
    publisher.write(std::move(sample));
  };
  if (output.schedule) tell(to_wire(*output.schedule), schedules_);
  if (output.outlook) tell(to_wire(*output.outlook), outlooks_);
}

void SteppedHost::tell_blocking(std::vector<BlockingGoal> blocking) {
  for (const BlockingGoal& goal : blocking) {
    if (std::ranges::find(blocking_, goal) != blocking_.end()) continue;
    report(v1::SEVERITY_WARNING, "planner.blocked",
           "goal " + goal.issuer + "/" + goal.id +
               " cannot be planned: " + (goal.timeline.empty() ? "" : goal.timeline + ": ") + goal.reason);
  }
  blocking_ = std::move(blocking);
}

void SteppedHost::report(v1::Severity severity, const std::string& code, const std::string& text) {
  events_.write(services::node::make_event(severity, code, text));
}

}  // namespace roci::planner
