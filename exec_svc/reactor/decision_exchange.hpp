/// The decisions that plans have asked for, and the answers to them: each answer is taken at most once, from
/// whoever is asked, and every answer has a receipt (R131).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

class DecisionExchange {
 public:
  /// Receives answers. Those that the running plan has to judge are returned; note_results() is to follow
  /// when it has. The others get their receipts at once: answers of an id that was used before, of somebody
  /// who is not asked, and to decisions that are no longer open. A sample that was known (a late joiner hears
  /// it again) gets none.
  std::vector<executive::DecisionAnswer> admit(const std::vector<GivenAnswer>& answers, ReactorOutputs& out);
  void note_results(const std::vector<executive::AnswerResult>& results, ReactorOutputs& out);

  /// Keeps what the step says of decisions, and completes it from what was known of them.
  void note_changes(std::vector<DecisionRecord>& changes);

  const std::map<std::string, DecisionRecord>& decisions() const { return decisions_; }
  /// The newest receipt of every answer.
  std::vector<AnswerReceipt> receipts() const;

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.decisions_, self.receipts_);
  }

 private:
  executive::AnswerResult fault_of(const GivenAnswer& answer) const;
  void close(const GivenAnswer& answer, executive::AnswerResult result, ReactorOutputs& out);

  std::map<std::string, DecisionRecord> decisions_;  ///< by id
  std::map<orders::IssuedKey, AnswerReceipt> receipts_;
  std::vector<GivenAnswer> judged_by_plan_;  ///< in this step
};

}  // namespace roci::exec::reactor
