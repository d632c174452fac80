#include "exec_svc/reactor/ground_orders.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/bytes/crc_32.hpp"
#include "core/mission/entry.hpp"
#include "exec_svc/mission/action_entries.hpp"
#include "exec_svc/reactor/relaunch.hpp"
#include "exec_svc/reactor/single_command.hpp"

namespace roci::exec::reactor {

using executive::OutcomeKind;
using mission::AutonomyLevel;
using orders::IssuedKey;
using orders::Order;
using orders::OrderKind;
using orders::OrderStage;
using temporal::ActivityState;
using temporal::Time;

namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out.empty() ? "none" : out;
}

constexpr std::string_view kContingencies = "contingencies.";

}  // namespace

void GroundOrders::obey(Time now, ReactorInputs& inputs) {
  for (const Order& order : inputs.ground_orders) {
    if (!book_.receive(order)) continue;
    const Ruling ruling = rule(now, order, inputs);
    if (ruling.stage == OrderStage::applied) move(order.key, {OrderStage::accepted, ""});
    move(order.key, ruling);
    const std::string name = "order " + order.key.text() + " (" + to_string(order.kind) +
                             (order.target.empty() ? "" : " ") + order.target + ")";
    if (ruling.stage == OrderStage::refused) {
      state_->report(Severity::warning, "order.refused", name + " is refused: " + ruling.reason);
    } else {
      state_->report(Severity::info, "order.accepted", name + " is accepted");
    }
  }
  plan_->permit(state_->authority.permissions());
}

GroundOrders::Ruling GroundOrders::rule(Time now, const Order& order, ReactorInputs& inputs) {
  switch (order.kind) {
    case OrderKind::hold:
      return hold(order);
    case OrderKind::release:
      return release(order);
    case OrderKind::approve:
      return approve(order);
    case OrderKind::set_value:
      return set_value(order, inputs);
    case OrderKind::autonomy:
      return set_level(order);
    case OrderKind::upload:
      return upload(order);
    case OrderKind::answer:
      inputs.answers.push_back({order.key, order.sample, order.target, order.choice,
                                order.content == temporal::Value{} ? "" : temporal::to_text(order.content)});
      awaited_answers_.push_back(order.key);
      return {OrderStage::accepted};
    case OrderKind::drop:
      return drop(order);
    case OrderKind::relaunch:
      return relaunch(now);
    case OrderKind::safe:
      return make_safe(now, order);
    case OrderKind::command:
      return command(now, order);
  }
  return refused("there is no such order");
}

GroundOrders::Ruling GroundOrders::hold(const Order& order) {
  if (order.target.empty()) {
    state_->authority.hold_all(true);
    return {};
  }
  if (std::string fault = fault_of_waiting(order.target); !fault.empty()) return refused(fault);
  state_->authority.hold(order.target);
  return {};
}

GroundOrders::Ruling GroundOrders::release(const Order& order) {
  if (!order.target.empty()) {
    if (!state_->authority.release(order.target)) return refused(order.target + " is not held");
    return {};
  }
  if (!state_->authority.held()) return refused("nothing is held");
  state_->authority.hold_all(false);
  plan_if_none_runs("the ground has ended the hold");
  return {};
}

GroundOrders::Ruling GroundOrders::approve(const Order& order) {
  if (state_->authority.level() != AutonomyLevel::e1)
    return refused(std::string("at autonomy level ") + to_string(state_->authority.level()) +
                   " nothing waits for an approval");
  if (std::string fault = fault_of_waiting(order.target); !fault.empty()) return refused(fault);
  state_->authority.approve(order.target);
  return {};
}

GroundOrders::Ruling GroundOrders::set_value(const Order& order, ReactorInputs& inputs) {
  const auto& owned = state_->mission->ground.values;
  if (std::ranges::find(owned, order.target) == owned.end())
    return refused("timeline '" + order.target +
                   "' is not the ground's; the mission gives it: " + listed(owned));
  if (order.content == temporal::Value{}) return refused("the order has no value");
  values_[order.target] = order.content;
  inputs.observations.push_back({order.target, order.content});
  state_->out.values.push_back({order.target, order.content});
  return {};
}

GroundOrders::Ruling GroundOrders::set_level(const Order& order) {
  state_->authority.set_level(order.level);
  plan_if_none_runs(std::string("the ground has set autonomy level ") + to_string(order.level));
  return {};
}

/// Replaces a contingency's text; nothing else may be uploaded.
GroundOrders::Ruling GroundOrders::upload(const Order& order) {
  const auto& uploads = state_->mission->ground.uploads;
  if (std::ranges::find(uploads, order.target) == uploads.end())
    return refused("'" + order.target +
                   "' cannot be replaced by an upload; the mission lets these: " + listed(uploads));
  if (bytes::crc_32(order.upload) != order.checksum)
    return refused("the checksum is that of another content; send it again");
  const std::string name = order.target.substr(kContingencies.size());
  if (plan_->contingency_under_way(name)) return refused(order.target + " is under way; send it later");
  try {
    plan_->set_contingency(mission::read_contingency(
        name, roci::mission::Entry::parse(order.upload, "upload " + order.key.text()),
        state_->mission->components));
  } catch (const roci::mission::FileError& error) {
    return refused(error.what());
  }
  uploads_[order.target] = order.upload;
  return {};
}

GroundOrders::Ruling GroundOrders::drop(const Order& order) {
  if (stopped()) {
    if (plan_->executive().activity(order.target) == nullptr)
      return refused(plan_->name() + " has no activity '" + order.target + "'");
    if (plan_->step_of(order.target).state == ActivityState::succeeded)
      return refused(order.target + " is done");
    std::set<std::string> all{order.target};
    for (const auto& [activity, key] : dropped_) all.insert(activity);
    if (std::string fault = plan_->drop_fault(all); !fault.empty()) return refused(fault);
    dropped_[order.target] = order.key;
    return {OrderStage::accepted};
  }
  if (std::string fault = fault_of_waiting(order.target); !fault.empty()) return refused(fault);
  if (std::string fault = plan_->drop_fault({order.target}); !fault.empty()) return refused(fault);
  plan_->drop(order.target, "dropped by the ground");
  return {};
}

/// Launches the stopped plan again. This ends a hold of everything, which an order to make safe has begun.
GroundOrders::Ruling GroundOrders::relaunch(Time now) {
  if (!stopped())
    return refused("no plan was stopped; the robot is " + std::string(to_string(state_->phase)));
  if (std::string fault = fault_of_rest(); !fault.empty()) return refused(fault);
  std::set<std::string> dropped;
  for (const auto& [activity, key] : dropped_) dropped.insert(activity);
  if (std::string fault = plan_->relaunch(now, dropped); !fault.empty()) return refused(fault);
  state_->authority.hold_all(false);
  state_->replan_wanted = false;
  for (const auto& [activity, key] : std::exchange(dropped_, {})) move(key, {OrderStage::applied});
  for (const goals::GoalKey& key : state_->open_goals())
    state_->set_goal(key, goals::GoalState::planned, "in " + plan_->name(), plan_->version());
  state_->report(Severity::info, "plan.relaunched",
                 plan_->name() + " goes on where the plan before it was stopped");
  return {};
}

GroundOrders::Ruling GroundOrders::make_safe(Time now, const Order& order) {
  state_->authority.hold_all(true);
  const std::string reason = "ordered by " + order.key.issuer;
  if (state_->phase == MissionPhase::safe) {
    safing_->make_safe_again(now, reason);
  } else {
    safing_->make_safe(now, reason);
  }
  safe_due_.push_back(order.key);
  return {OrderStage::accepted};
}

// Carries out a single command, unless an engine's plan runs or is being made: two commanders of one subsystem
// would not know of each other.
GroundOrders::Ruling GroundOrders::command(Time now, const Order& order) {
  if (std::string fault = fault_of_commanding(); !fault.empty()) return refused(fault);
  SingleCommand single =
      plan_of_command(order, *state_->mission, plan_->version() + 1, now, plan_->executive());
  if (!single.fault.empty()) return refused(single.fault);
  state_->authority.approve(single.activity);
  if (std::string fault = plan_->take_over(std::move(single.plan), now); !fault.empty())
    return refused(fault);
  return {};
}

std::string GroundOrders::fault_of_commanding() const {
  if (state_->mission->executive.plans_continuously())
    return "an engine plans all the time here; ask it by a goal";
  if (state_->authority.held()) return "everything is held; end that first (roci order release)";
  if (state_->phase == MissionPhase::pausing || state_->phase == MissionPhase::planning)
    return "a plan is being made";
  if (state_->phase == MissionPhase::executing && !is_of_single_commands(plan_->executive().plan()))
    return plan_->name() + " runs; wait for its end, or stop it (roci order safe)";
  return state_->phase == MissionPhase::safe ? fault_of_rest() : "";
}

/// Returns what a robot that is made safe waits for before anything is commanded anew, or an empty text.
std::string GroundOrders::fault_of_rest() const {
  if (const auto active = state_->beliefs.active(); !active.empty())
    return active.front()->name + " is not inactive yet; send it again";
  if (plan_->outcome().kind == OutcomeKind::cancelling) return "commands are being cancelled; send it again";
  return "";
}

void GroundOrders::settle() {
  for (const AnswerReceipt& receipt : state_->out.answer_receipts) {
    if (std::erase(awaited_answers_, receipt.key) == 0) continue;
    const bool taken = receipt.result.outcome == executive::AnswerOutcome::taken;
    move(receipt.key, taken ? Ruling{} : refused(receipt.result.reason));
  }
  if (!safe_due_.empty() && state_->beliefs.active().empty() &&
      plan_->outcome().kind != OutcomeKind::cancelling) {
    for (const IssuedKey& key : std::exchange(safe_due_, {})) move(key, {});
  }
  if (state_->out.adopted) {
    for (const auto& [activity, key] : std::exchange(dropped_, {}))
      move(key, refused("its plan was replaced by " + plan_->name()));
  }
  state_->out.order_statuses = book_.take_changes();
}

void GroundOrders::reinstate() {
  plan_->permit(state_->authority.permissions());
  for (const auto& [target, text] : uploads_)
    plan_->set_contingency(mission::read_contingency(target.substr(kContingencies.size()),
                                                     roci::mission::Entry::parse(text, "upload"),
                                                     state_->mission->components));
}

std::string GroundOrders::fault_of_waiting(const std::string& activity) const {
  if (state_->phase != MissionPhase::executing) return "no plan runs";
  if (plan_->executive().activity(activity) == nullptr)
    return plan_->name() + " has no activity '" + activity + "'";
  if (plan_->step_of(activity).state != ActivityState::waiting)
    return activity + " waits for nothing any more";
  return "";
}

/// Plans open goals where no plan runs, as soon as the ground allows it, whoever made the robot safe.
void GroundOrders::plan_if_none_runs(const std::string& reason) {
  const bool none_runs = state_->phase == MissionPhase::safe || state_->phase == MissionPhase::idle;
  if (none_runs && state_->authority.may_replan() && !state_->goals.open().empty()) state_->want_plan(reason);
}

void GroundOrders::move(const IssuedKey& key, const Ruling& ruling) {
  book_.move(key, ruling.stage, ruling.reason, ruling.stage == OrderStage::applied ? plan_->version() : 0);
}

bool GroundOrders::stopped() const {
  return state_->phase == MissionPhase::safe && plan_->outcome().kind == OutcomeKind::cancelled;
}

}  // namespace roci::exec::reactor
