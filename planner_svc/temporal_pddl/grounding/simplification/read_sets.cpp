#include "planner_svc/temporal_pddl/grounding/simplification/read_sets.hpp"

#include <algorithm>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/simplification/derived_support.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

using instantiation::GroundEffects;
using instantiation::GroundModel;
using instantiation::ReadVariable;
using task::NumberId;

namespace {

// Marks what some effect is about.
struct Changing {
  explicit Changing(const GroundModel& model)
      : atoms(model.atoms.size(), false), numbers(model.numbers.size(), false) {
    for (const auto& action : model.actions) {
      note(action.start_effects);
      note(action.end_effects);
    }
    for (const auto& timed : model.timed) note(timed.effects);
  }

  void note(const GroundEffects& effects) {
    for (const std::uint32_t atom : effects.adds) atoms[atom] = true;
    for (const std::uint32_t atom : effects.deletes) atoms[atom] = true;
    for (const auto& effect : effects.numeric) numbers[effect.variable.index()] = true;
  }

  std::vector<bool> atoms, numbers;
};

std::vector<ReadVariable> without_derived(const std::vector<ReadVariable>& read_sets,
                                          const DerivedSupport& supports) {
  std::vector<ReadVariable> result;
  for (const ReadVariable& read : read_sets) {
    if (read.is_number || !supports.is_derived(read.index)) {
      result.push_back(read);
      continue;
    }
    for (const bool negated : {false, true}) {
      const Support support = supports.of({read.index, negated});
      for (const auto literal : support.literals) result.push_back({literal.atom, false, read.at_end});
      for (const NumberId number : support.numbers) result.push_back({number.value, true, read.at_end});
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

void settle_read_sets(GroundModel& model) {
  if (model.read_sets.size() == 1) return;
  const Changing changing(model);
  const DerivedSupport supports(model);
  for (auto& list : model.read_sets) {
    if (!model.rules.empty()) list = without_derived(list, supports);
    std::erase_if(list, [&](const ReadVariable& read) {
      return !(read.is_number ? changing.numbers : changing.atoms)[read.index];
    });
  }
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
