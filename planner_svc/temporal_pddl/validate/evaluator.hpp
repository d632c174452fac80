// The evaluator finds the truth of conditions and the values of expressions in one state.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/validate/model.hpp"

namespace roci::planner::temporal_pddl::validate {

/// A condition is `unknown` if its truth depends on a number that is undefined (Kleene's logic); it holds
/// only if it is `yes`.
enum class Truth { no, unknown, yes };

/// Holds values that no state holds, in seconds.
struct Specials {
  std::optional<double> duration;    ///< ?duration
  std::optional<double> total_time;  ///< total-time
};

/// Evaluates in one state; whoever changes the state makes a new evaluator. With `reads`, it collects what
/// the results depend on: every changing fact and fluent that a condition mentions once it is instantiated
/// (Fox and Long 2003, definition 12), and what derived predicates rest on.
class Evaluator {
 public:
  Evaluator(const Model& model, const State& state, Reads* reads = nullptr)
      : model_(model), state_(state), reads_(reads) {}

  Truth evaluate(const pddl::Condition& condition, Bindings& bindings);
  bool holds(const pddl::Condition& condition, Bindings& bindings) {
    return evaluate(condition, bindings) == Truth::yes;
  }

  /// Returns nothing if the value is undefined; reason() then says why.
  std::optional<double> value(const pddl::Expression& expression, const Bindings& bindings,
                              const Specials& specials = {});

  /// Tells why the latest undefined value was undefined; it is empty if none was.
  const std::string& reason() const { return reason_; }

 private:
  // Holds the instances of derived predicates of one layer whose truth is being settled together.
  struct Instance {
    const pddl::Atom* atom;
    std::vector<std::string_view> objects;
    bool derived = false;
  };
  struct Layer {
    int number = 0;
    std::deque<Instance> instances;
    std::map<std::string, std::size_t> index;
  };

  // Returns the conjunction (decisive no) or disjunction (decisive yes) of the parts.
  Truth combine(Truth decisive, const std::vector<pddl::Condition>& parts, Bindings& bindings);
  // Returns that of the body for every choice of objects.
  Truth combine(Truth decisive, const std::vector<pddl::TypedName>& variables, const pddl::Condition& body,
                Bindings& bindings);
  Truth imply(const pddl::Imply& imply, Bindings& bindings);
  Truth fact(const pddl::Atom& atom, const Bindings& bindings);
  Truth compare(const pddl::Comparison& comparison, const Bindings& bindings);
  bool constant(const pddl::Atom& atom, const std::string& ground, const Bindings& bindings);
  bool derived(const pddl::Atom& atom, const std::string& ground, const Bindings& bindings);
  void settle(Layer& layer);
  bool derive(const Instance& instance);

  std::optional<double> fluent(const pddl::Atom& atom, const Bindings& bindings);
  std::optional<double> arithmetic(const pddl::Arithmetic& sum, const Bindings& bindings,
                                   const Specials& specials);
  std::nullopt_t undefined(std::string reason);

  const Model& model_;
  const State& state_;
  Reads* reads_;
  Layer* open_ = nullptr;
  std::map<std::string, bool> settled_;
  bool settles_constants_ = false;
  // Rules that rest on each other's heads are followed so deep;
  // deeper ones are settled as a layer, which does not recurse.
  static constexpr int kMostBelow = 20;
  int depth_ = 0;
  std::string reason_;
};

}  // namespace roci::planner::temporal_pddl::validate
