// Models as text, for tests.
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"

namespace roci::planner::temporal_pddl::testing {

struct Model {
  pddl::Domain domain;
  pddl::Problem problem;
};

// Checked. `domain`: what follows the requirements; `problem`: what follows (:domain d).
Model model(const std::string& domain, const std::string& problem);

// Answers from a map by application, "(f a b)"; what is not in it is unavailable. Counts batches and calls.
class MapFunctions final : public engine::FunctionSource {
 public:
  std::map<std::string, engine::FunctionValue> answers;
  std::size_t batches = 0;
  std::size_t calls = 0;

  void set(const std::string& application, double value);
  void set(const std::string& application, engine::FunctionOutcome outcome);
  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> asked,
                                              const std::function<bool()>& cancelled) override;
};

grounding::Grounding grounded(const Model& model, const call::Options& options = {});
Result solved(const Model& model, const call::Options& options = {}, const call::Budget& budget = {});
Result solved(const Model& model, engine::FunctionSource& functions, const call::Options& options = {});

// The ids of a grounding's things by their names; none if there are none.
task::FactId fact(const task::Task& task, const std::string& name);
task::ActionId action(const task::Task& task, const std::string& name);
task::NumberId number(const task::Task& task, const std::string& name);

}  // namespace roci::planner::temporal_pddl::testing
