// The decision exchange keeps the decisions that plans have asked for, and the answers to them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// Takes each answer at most once, from whoever is asked, and gives every answer a receipt (R131). Open decisions are
/// kept, and of those that are closed the newest: an answer to an older one is judged by the running plan, which does
/// not know it.
class DecisionExchange {
 public:
  /// Bounds the closed decisions that are kept: many times those of one plan, to which answers may still be under way.
  static constexpr std::size_t kClosedDecisions = 1'000;

  /// Receives answers, and returns those that the running plan has to judge; note_results() must follow when
  /// it has. The others get their receipts at once: answers under an id that was used before, from somebody
  /// who is not asked, and to decisions that are no longer open. A known sample (heard again by a late
  /// joiner) gets none.
  std::vector<executive::DecisionAnswer> admit(const std::vector<GivenAnswer>& answers, ReactorOutputs& out);
  void note_results(const std::vector<executive::AnswerResult>& results, ReactorOutputs& out);

  /// Keeps the step's changes of decisions, and completes them by what was known before.
  void note_changes(std::vector<DecisionRecord>& changes);

  const std::map<std::string, DecisionRecord>& decisions() const { return decisions_; }
  /// Returns the newest receipt of every answer.
  std::vector<AnswerReceipt> receipts() const;

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.decisions_, self.receipts_);
  }

 private:
  executive::AnswerResult fault_of(const GivenAnswer& answer) const;
  void close(const GivenAnswer& answer, executive::AnswerResult result, ReactorOutputs& out);
  void forget_oldest_closed();

  std::map<std::string, DecisionRecord> decisions_;  ///< by id
  std::map<orders::IssuedKey, AnswerReceipt> receipts_;
  std::vector<GivenAnswer> judged_by_plan_;  ///< in this step
};

}  // namespace roci::exec::reactor
