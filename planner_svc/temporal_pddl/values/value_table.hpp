// What a planning call knows of external functions while it refines their values: exact ones where it asked
// for them, and something cheaper elsewhere.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/values/tuple_set.hpp"

namespace roci::planner::temporal_pddl::values {

/// What asking for exact values has brought.
struct Refined {
  std::size_t asked = 0;  ///< tuples
  bool changed = false;   ///< whether one of them is not what it was taken for
};

/// Stands between grounding, which asks for all tuples in each round, and the owners, which are asked for each
/// value once. Grounding gets the exact value of a tuple if it is known. Else it gets, in mode two_accuracy,
/// the owner's lower bound; in mode lazy, the smallest exact value of the function so far (1 if there is none).
class ValueTable final : public engine::FunctionSource {
 public:
  /// Functions in `exactly` are asked for exactly from the beginning. `owners` must outlive the table.
  ValueTable(engine::FunctionSource& owners, engine::FunctionsMode mode, std::set<std::string> exactly,
             std::function<bool()> cancelled)
      : owners_(owners), mode_(mode), exactly_(std::move(exactly)), cancelled_(std::move(cancelled)) {}

  /// Answers with what is known. The first batch of a function must hold all its tuples.
  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;

  /// Asks exactly for those of the tuples that are not known so, one batch per function. A lower bound that
  /// turns out to be above the exact value is noted in warnings().
  Refined refine(std::span<const engine::FunctionCall> calls);
  /// Does so for all tuples.
  Refined refine_all();
  /// Returns whether every tuple is known exactly, or proved to have no value.
  bool is_exact() const;

  /// While `alone`, evaluate() gives exact values alone: other tuples have none.
  void give_exact_alone(bool alone) { exact_alone_ = alone; }

  /// Returns everything that owners said, of each tuple the best, and knows nothing any more.
  std::vector<engine::FunctionUse> take_uses();
  /// "OWNER …", one for each bound that was none.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Known {
    engine::FunctionValue value;  ///< with !asked: nothing yet
    bool asked = false;
    bool exact() const;
  };
  struct Function {
    TupleSet tuples;
    std::vector<Known> known;  // of each of the tuples
    double smallest = 1;       // exact value
    bool has_exact = false;
  };

  void load(Function& function, std::span<const engine::FunctionCall> calls);
  std::vector<engine::FunctionValue> ask(std::vector<engine::FunctionCall> calls,
                                         temporal::FunctionAccuracy accuracy);
  void take_exact(Function& function, std::size_t index, engine::FunctionValue value, Refined& refined);
  Refined refine(Function& function, const std::set<std::size_t>& wanted);
  engine::FunctionValue given(const Function& function, std::size_t index) const;

  engine::FunctionSource& owners_;
  engine::FunctionsMode mode_;
  std::set<std::string> exactly_;
  std::function<bool()> cancelled_;
  std::map<std::string, Function> functions_;
  std::vector<std::string> warnings_;
  bool exact_alone_ = false;
};

}  // namespace roci::planner::temporal_pddl::values
