#include "exec_svc/reactor/decision_exchange.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace roci::exec::reactor {

using executive::AnswerOutcome;
using executive::AnswerResult;
using executive::DecisionAnswer;
using executive::DecisionState;
using executive::DecisionStatus;

std::vector<DecisionAnswer> DecisionExchange::admit(const std::vector<GivenAnswer>& answers,
                                                    ReactorOutputs& out) {
  std::vector<DecisionAnswer> admitted;
  judged_by_plan_.clear();
  for (const GivenAnswer& answer : answers) {
    const auto before = receipts_.find(answer.key);
    if (before != receipts_.end() && before->second.answers == answer.sample) continue;
    AnswerResult fault = fault_of(answer);
    if (fault.outcome != AnswerOutcome::taken) {
      close(answer, std::move(fault), out);
    } else {
      receipts_[answer.key] = {answer.key, answer.sample, answer.decision, {}};
      admitted.push_back({answer.decision, answer.choice, answer.value, answer.key.issuer});
      judged_by_plan_.push_back(answer);
    }
  }
  return admitted;
}

/// Returns `taken` if the running plan has to judge the answer.
AnswerResult DecisionExchange::fault_of(const GivenAnswer& answer) const {
  if (receipts_.contains(answer.key))
    return {AnswerOutcome::repeated, "an answer of this id was given before; give another one another id"};
  const auto found = decisions_.find(answer.decision);
  if (found == decisions_.end()) return {};
  const DecisionStatus& asked = found->second.status;
  if (asked.resolver != answer.key.issuer)
    return {AnswerOutcome::not_entitled, "the decision is asked of " + asked.resolver};
  switch (asked.state) {
    case DecisionState::open:
      return {};
    case DecisionState::answered:
      return {AnswerOutcome::repeated, "it was answered with " + asked.chosen + " before"};
    case DecisionState::missed:
      return {AnswerOutcome::late, "it was due before " + temporal::to_text(asked.answer_before)};
    case DecisionState::void_:
      return {AnswerOutcome::late,
              "plan " + std::to_string(found->second.plan_version) + ", which asked for it, no longer runs"};
  }
  return {};
}

void DecisionExchange::note_results(const std::vector<AnswerResult>& results, ReactorOutputs& out) {
  for (std::size_t i = 0; i < judged_by_plan_.size(); ++i) close(judged_by_plan_[i], results.at(i), out);
  judged_by_plan_.clear();
}

void DecisionExchange::close(const GivenAnswer& answer, AnswerResult result, ReactorOutputs& out) {
  AnswerReceipt& receipt = receipts_[answer.key];
  receipt = {answer.key, answer.sample, answer.decision, std::move(result)};
  out.answer_receipts.push_back(receipt);
}

void DecisionExchange::note_changes(std::vector<DecisionRecord>& changes) {
  for (DecisionRecord& change : changes) {
    const auto [known, is_new] = decisions_.try_emplace(change.status.decision, change);
    if (!is_new && change.status.state == DecisionState::open) known->second = change;
    DecisionStatus& status = known->second.status;
    status.state = change.status.state;
    status.chosen = change.status.chosen;
    status.answered_by = change.status.answered_by;
    change = known->second;
  }
  forget_oldest_closed();
}

// The order of forgetting follows from the records alone, so that a restart from the journal forgets the same ones.
void DecisionExchange::forget_oldest_closed() {
  if (decisions_.size() <= kClosedDecisions) return;
  std::vector<std::pair<std::uint32_t, std::string>> closed;  // by the plan that asked
  for (const auto& [id, decision] : decisions_)
    if (decision.status.state != DecisionState::open) closed.emplace_back(decision.plan_version, id);
  if (closed.size() <= kClosedDecisions) return;
  std::ranges::sort(closed);
  closed.resize(closed.size() - kClosedDecisions);
  for (const auto& [version, id] : closed) decisions_.erase(id);
}

std::vector<AnswerReceipt> DecisionExchange::receipts() const {
  std::vector<AnswerReceipt> all;
  for (const auto& [key, receipt] : receipts_) all.push_back(receipt);
  return all;
}

}  // namespace roci::exec::reactor
