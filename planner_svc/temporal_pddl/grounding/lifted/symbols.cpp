#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

#include "core/pddl/total_cost.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

using task::ObjectId;

Symbols::Symbols(const pddl::Domain& domain, const pddl::Problem& problem)
    : domain_file_(domain.file), objects_(domain, problem) {
  for (const auto& signature : domain.predicates) {
    predicates_.emplace(signature.name, predicate_names_.push_back(signature.name));
  }
  const auto declare = [&](const pddl::Signature& signature, const std::string& module) {
    FunctionSymbol symbol{signature.name, module, {}, signature.where};
    for (const auto& parameter : signature.parameters) symbol.parameters.push_back(of_types(parameter.types));
    function_ids_.emplace(signature.name, functions_.push_back(std::move(symbol)));
  };
  for (const auto& signature : domain.functions) declare(signature, "");
  if (pddl::has_total_cost(domain)) total_cost_ = function(pddl::kTotalCost);
  for (const auto& module : domain.modules) {
    for (const auto& signature : module.functions) declare(signature, module.name);
  }
}

std::vector<ObjectId> Symbols::of_types(const std::vector<std::string>& types) const {
  std::vector<ObjectId> result;
  for (const int object : objects_.of_types(types)) result.emplace_back(static_cast<std::size_t>(object));
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
