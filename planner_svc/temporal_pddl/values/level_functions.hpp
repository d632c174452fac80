// Functions of the state: asked for at each level of the fluents that they depend on (core/pddl/state_levels.hpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::values {

/// Stands between the model, where a level is one more argument, and the owners, who hear of a value of the state. Such
/// a value is named as the model writes the fluent, "(battery rover-1)". Other functions pass as they are. `owners`
/// and the parameters must outlive it.
class LevelFunctions final : public engine::FunctionSource {
 public:
  LevelFunctions(engine::FunctionSource& owners, const std::vector<pddl::LevelParameter>& parameters)
      : owners_(owners), parameters_(parameters) {}

  /// Asks for one batch per state that the calls assume.
  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;

 private:
  std::vector<const pddl::LevelParameter*> levels_of(const std::string& function) const;

  engine::FunctionSource& owners_;
  const std::vector<pddl::LevelParameter>& parameters_;
};

}  // namespace roci::planner::temporal_pddl::values
