/// The open choices of sufficient plans (R131): asked for when the information may exist, bound by the answer
/// of their resolver or by the first choice whose rule holds.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/executive/run_state.hpp"
#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

class DecisionPoints {
 public:
  /// Holds the starts of all activities among which is to be chosen, or whose arguments are to be bound. Both
  /// outlive this.
  DecisionPoints(RunState& state, StartWaits& waits);

  /// Takes an answer: the activities of the other choices are skipped, or the value becomes an argument of
  /// the commands. An answer that is not taken changes nothing.
  AnswerResult take_answer(const DecisionAnswer& answer, temporal::Time now);
  /// Asks as soon as every predecessor of some activity of the decision has happened; a rule is looked at
  /// from then on, until a choice holds. An answer that is missing at its time breaks the plan. True:
  /// something happened, and another look is due.
  bool ask(temporal::Time now);
  /// Once nothing new may start, what is still open is told as missed or void.
  void close();
  /// When, after now, an answer that was asked for will be missing; no bound: never.
  temporal::Time next_timer(temporal::Time now) const;

  /// Takes over from the run before: what was answered stays answered and is not asked for again, what is
  /// open stays open if this plan has the same decision, else it is void.
  void inherit(const DecisionPoints& before, temporal::Time now);

 private:
  struct Record {
    std::optional<temporal::Time> asked_at;
    DecisionState state = DecisionState::open;
    std::string chosen;
    std::string answered_by;
    std::vector<temporal::TimePoint> held;    ///< points that wait for the answer
    std::vector<temporal::TimePoint> due_by;  ///< of these, those that make it be asked for
  };

  void hold(std::size_t decision);
  bool resolve_by_rule(std::size_t decision, temporal::Time now);
  AnswerResult fault_of(std::size_t decision, const DecisionAnswer& answer, temporal::Time now) const;
  void settle(std::size_t decision, const std::string& chosen, const std::string& by, temporal::Time now);
  void mark_incomplete(Index activity, const std::string& reason);
  void skip_others(const temporal::DecisionPoint& decision, const std::string& chosen);
  void tell(std::size_t decision);
  std::string resolver_of(const temporal::DecisionPoint& decision) const;
  temporal::Time answer_before(std::size_t decision) const;

  RunState* state_;
  StartWaits* waits_;
  std::set<std::size_t> open_;   ///< decisions not taken, in plan order
  std::vector<Record> records_;  ///< by decision
};

}  // namespace roci::exec::executive
