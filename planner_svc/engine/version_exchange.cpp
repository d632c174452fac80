#include "planner_svc/engine/version_exchange.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::engine {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::PlanDelta;

namespace {

// Two processes may have given one number to plans of the same activities at other times.
// An executive may hold starts to one time.
bool same(const FlexiblePlan& a, const FlexiblePlan& b) {
  const auto alike = [](const PlanActivity& one, const PlanActivity& other) {
    return one.id == other.id && one.commit == other.commit && one.preferred_start == other.preferred_start &&
           one.duration_lower == other.duration_lower && one.start_point == other.start_point;
  };
  return a.tokens == b.tokens && std::ranges::equal(a.activities, b.activities, alike);
}

}  // namespace

bool VersionExchange::take(const FlexiblePlan& executed) {
  if (!is_possible(executed.version)) return false;
  use(executed.version);
  if (newest_ && newest_->version != 0 && executed.version < newest_->version) return false;
  if (const FlexiblePlan* const known = history_.version(executed.version); known && same(*known, executed))
    return false;
  last_executed_ = executed.version;
  history_.keep(executed);
  if (is_of_use()) history_.forget_before(newest_->version);
  owes_ = true;
  due_ = newest_.has_value();
  return true;
}

void VersionExchange::note(std::uint32_t version) {
  if (is_possible(version)) use(version);
}

void VersionExchange::use(std::uint32_t version) { last_version_ = std::max(last_version_, version); }

void VersionExchange::hear(const Receipt& receipt) {
  const std::uint32_t version = std::max(receipt.version, receipt.refused);
  if (!is_possible(version)) return;
  newest_ = receipt;
  use(version);
  due_ = true;
  if (!is_of_use()) return;
  last_executed_ = receipt.version;
  history_.forget_before(receipt.version);
}

bool VersionExchange::is_of_use() const { return newest_ && executed() != nullptr; }

const FlexiblePlan* VersionExchange::executed() const {
  return newest_ && newest_->version != 0 ? history_.version(newest_->version) : nullptr;
}

// A receipt is no use before the version that it speaks of is known.
bool VersionExchange::has_news() const {
  return owes_ || (due_ && (newest_->version == 0 || executed() != nullptr));
}

void VersionExchange::give(StepInputs& inputs) {
  inputs.last_version = last_version_;
  const bool due = due_ && has_news();
  if (due || refused_) inputs.receipt = newest_.value_or(Receipt{});
  if (due) due_ = false;
  if (refused_) {
    inputs.receipt->refused = refused_->refused;
    inputs.receipt->reason = refused_->reason;
    refused_.reset();
  }
  const std::uint32_t version = due ? newest_->version : engine_has_;
  if (std::exchange(owes_, false) || (version != 0 && version != engine_has_ && version != engine_sent_)) {
    inputs.executed = *history_.version(last_executed_);
    engine_sent_ = 0;  // it forgets what it sent
    engine_has_ = last_executed_;
  }
  if (due) engine_has_ = version;
}

// Also a plan that has ended tells it what was done.
void VersionExchange::engine_is_new() {
  engine_has_ = engine_sent_ = 0;
  owes_ = history_.version(last_executed_) != nullptr;
  due_ = newest_.has_value();
}

std::string VersionExchange::apply(const PlanDelta& delta, FlexiblePlan& next) const {
  if (delta.added.version <= last_version_)
    return "not above version " + std::to_string(last_version_) + ", the newest there was";
  const std::string fault = history_.apply(delta, next);
  return fault.empty() ? "" : "no change of a plan: " + fault;
}

void VersionExchange::sent(FlexiblePlan plan) {
  use(plan.version);
  engine_sent_ = plan.version;
  history_.keep(std::move(plan));
}

void VersionExchange::refuse(std::uint32_t version, const std::string& reason) {
  use(version);
  engine_sent_ = version;
  refused_.emplace();
  refused_->refused = version;
  refused_->reason = reason;
}

}  // namespace roci::planner::engine
