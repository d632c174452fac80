#include "planner_svc/temporal_pddl/grounding/mentions.hpp"

#include <algorithm>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/derived_support.hpp"

namespace roci::planner::temporal_pddl {

namespace {

// What some effect is about.
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

std::vector<Mention> without_derived(const std::vector<Mention>& mentions, const DerivedSupport& supports) {
  std::vector<Mention> result;
  for (const Mention& mention : mentions) {
    if (mention.is_number || !supports.is_derived(mention.index)) {
      result.push_back(mention);
      continue;
    }
    for (const bool negated : {false, true}) {
      const Support support = supports.of({mention.index, negated});
      for (const auto literal : support.literals) result.push_back({literal.atom, false, mention.at_end});
      for (const NumberId number : support.numbers) result.push_back({number.value, true, mention.at_end});
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

void settle_mentions(GroundModel& model) {
  if (model.mentions.size() == 1) return;
  const Changing changing(model);
  const DerivedSupport supports(model);
  for (auto& list : model.mentions) {
    if (!model.rules.empty()) list = without_derived(list, supports);
    std::erase_if(list, [&](const Mention& mention) {
      return !(mention.is_number ? changing.numbers : changing.atoms)[mention.index];
    });
  }
}

}  // namespace roci::planner::temporal_pddl
