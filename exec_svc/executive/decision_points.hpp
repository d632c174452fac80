// Decision points are the open choices of sufficient plans (R131).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/executive/run_state.hpp"
#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

/// Asks for each decision when the information for it may exist, and binds it by the answer of its resolver
/// or by the first choice whose rule holds (R131).
class DecisionPoints {
 public:
  /// Holds the starts of all activities that a decision chooses among or whose arguments it binds. Both
  /// arguments must outlive this object.
  DecisionPoints(RunState& state, StartWaits& waits);

  /// Takes an answer in: the activities of the other choices are skipped, or the value becomes an argument of
  /// the commands. An answer that is not taken changes nothing.
  AnswerResult take_answer(const DecisionAnswer& answer, temporal::Time now);
  /// Asks as soon as every predecessor of some activity of the decision has happened; a rule is evaluated
  /// from then on, until a choice holds. An answer that is missing at its deadline breaks the plan. Returns
  /// whether something happened, so that another look is due.
  bool ask(temporal::Time now);
  /// Reports what is still open as missed or void, once nothing new may start.
  void close();
  /// Returns when, after now, the next answer that was asked for will be missing, or no_bound.
  temporal::Time next_timer(temporal::Time now) const;

  /// Takes over from the run before: an answered decision stays answered and is not asked for again; an open
  /// one stays open if this plan has the same decision, and else becomes void.
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
