// An owner of external functions with values of two accuracies, for tests.
#pragma once

#include <map>
#include <set>
#include <string>

#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::testing {

// Answers by application, "(f a b)": with its bound, if there is one and less is asked than the exact value.
class TwoAccuracies final : public engine::FunctionSource {
 public:
  std::map<std::string, engine::FunctionValue> exact;
  std::map<std::string, double> bounds;

  std::size_t batches = 0;
  std::set<std::string> asked_exactly;
  std::size_t asked_again = 0;  // exactly, though it was answered before

  void set(const std::string& application, double value, double bound);
  void set(const std::string& application, engine::FunctionOutcome outcome);

  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> asked,
                                              const std::function<bool()>& cancelled) override;
};

}  // namespace roci::planner::temporal_pddl::testing
