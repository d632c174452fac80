// One action instance to its ground actions.
#pragma once

#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/formula_grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"

namespace roci::planner::temporal_pddl {

class ActionInstantiator {
 public:
  explicit ActionInstantiator(FormulaGrounder& formulas) : formulas_(formulas) {}

  // Appends the ground actions of the instance, with what they mention: none if its conditions contradict
  // each other, a constant that it needs is undefined or unreachable, or no duration is possible.
  void instantiate(SchemaId schema, const LiftedAction& action, Binding& binding, GroundModel& model);

 private:
  // An action under construction: what is common to all variants, then one variant.
  struct Draft {
    Conjunction at_start, at_end;
    GroundEffects start_effects, end_effects;
  };
  // Effects that happen together, if `condition` does, and what else may be the case.
  struct Conditional {
    std::vector<std::pair<Conjunction, Conjunction>> fires, otherwise;  // conditions at start, at end
    GroundEffects start_effects, end_effects;
  };

  bool set_duration(const LiftedAction& action, const Binding& binding, GroundAction& ground);
  void mention_choices(const LiftedAction& action, Binding& binding);
  std::uint32_t mentioned_beside(const Conjunction& at_start, const Conjunction& at_end,
                                 std::vector<std::vector<Mention>>& lists) const;
  bool collect_effects(const LiftedAction& action, Binding& binding);
  bool collect_effect(const LiftedEffect& effect, bool at_end, Binding& binding);
  bool changes_its_condition(const LiftedEffect& effect, bool at_end, const Binding& binding,
                             const std::vector<std::pair<Conjunction, Conjunction>>& fires) const;
  bool add_effect(const LiftedEffect& effect, const Binding& binding, GroundEffects& effects);
  std::vector<Draft> choose_conditionals() const;

  FormulaGrounder& formulas_;
  Draft unconditional_;
  std::vector<Conditional> conditionals_;
  std::vector<Mention> mentions_;  // of the instance at hand
};

}  // namespace roci::planner::temporal_pddl
