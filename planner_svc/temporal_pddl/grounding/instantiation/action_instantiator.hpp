// The action instantiator makes the ground actions of one action instance.
#pragma once

#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/instantiation/formula_grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

/// Appends ground actions to a model. The formula grounder must outlive it.
class ActionInstantiator {
 public:
  explicit ActionInstantiator(FormulaGrounder& formulas) : formulas_(formulas) {}

  /// Appends the ground actions of the instance, with their read sets. There are none if its conditions
  /// contradict each other, a constant that it needs is undefined or unreachable, or no duration is
  /// possible.
  void instantiate(task::SchemaId schema, const lifted::LiftedAction& action, lifted::Binding& binding,
                   GroundModel& model);

 private:
  // Is an action under construction: first what is common to all variants, then one variant.
  struct Draft {
    Conjunction at_start, at_end;
    GroundEffects start_effects, end_effects;
  };
  // Holds effects that happen together if one of `fires` holds; `otherwise` is what else may be the case.
  struct Conditional {
    std::vector<std::pair<Conjunction, Conjunction>> fires, otherwise;  // conditions at start, at end
    GroundEffects start_effects, end_effects;
  };

  bool set_duration(const lifted::LiftedAction& action, const lifted::Binding& binding, GroundAction& ground);
  void add_choice_reads(const lifted::LiftedAction& action, lifted::Binding& binding);
  std::uint32_t reads_beside(const Conjunction& at_start, const Conjunction& at_end,
                             std::vector<std::vector<ReadVariable>>& lists) const;
  bool collect_effects(const lifted::LiftedAction& action, lifted::Binding& binding);
  bool collect_effect(const lifted::LiftedEffect& effect, bool at_end, lifted::Binding& binding);
  bool changes_its_condition(const lifted::LiftedEffect& effect, bool at_end, const lifted::Binding& binding,
                             const std::vector<std::pair<Conjunction, Conjunction>>& fires) const;
  bool add_effect(const lifted::LiftedEffect& effect, const lifted::Binding& binding, GroundEffects& effects);
  std::vector<Draft> choose_conditionals() const;

  FormulaGrounder& formulas_;
  Draft unconditional_;
  std::vector<Conditional> conditionals_;
  std::vector<ReadVariable> reads_;  // of the instance at hand
};

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
