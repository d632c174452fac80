#include "planner_svc/temporal_pddl/validate/model.hpp"

#include "core/pddl/overloaded.hpp"
#include "core/pddl/printer.hpp"
#include "core/pddl/total_cost.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

void collect_changed(const std::vector<pddl::Effect>& effects, std::set<std::string>& out) {
  for (const pddl::Effect& effect : effects) {
    std::visit(
        pddl::Overloaded{[&](const pddl::Literal& literal) { out.insert(literal.atom.symbol); },
                         [&](const pddl::Assignment& assignment) { out.insert(assignment.fluent.symbol); },
                         [&](const pddl::When& when) { collect_changed(when.effects, out); },
                         [&](const pddl::ForallEffect& forall) { collect_changed(forall.effects, out); }},
        effect.node);
  }
}

}  // namespace

Model::Model(const pddl::Domain& domain, const pddl::Problem& problem, const pddl::FunctionTable& functions)
    : domain_(domain),
      problem_(problem),
      functions_(functions),
      objects_(domain, problem),
      strata_(pddl::stratify(domain)) {
  for (const pddl::DerivedPredicate& derived : domain.derived) rules_[derived.head.name].push_back(&derived);
  for (const pddl::Module& module : domain.modules) {
    for (const pddl::Signature& function : module.functions) externals_.insert(function.name);
  }
  for (const pddl::Action& action : domain.actions) collect_changed(action.effects, changing_);
  for (const pddl::DurativeAction& action : domain.durative_actions) {
    collect_changed(action.start_effects, changing_);
    collect_changed(action.end_effects, changing_);
  }
  for (const pddl::TimedLiteral& timed : problem.timed_literals) changing_.insert(timed.literal.atom.symbol);
  for (const pddl::TimedValue& timed : problem.timed_values) changing_.insert(timed.fluent.symbol);
}

const std::vector<const pddl::DerivedPredicate*>& Model::rules(const std::string& predicate) const {
  static const std::vector<const pddl::DerivedPredicate*> none;
  const auto it = rules_.find(predicate);
  return it == rules_.end() ? none : it->second;
}

State Model::initial_state() const {
  State state;
  for (const pddl::Atom& fact : problem_.facts) state.facts.insert(pddl::print(fact));
  for (const pddl::InitialValue& initial : problem_.values) {
    state.values[pddl::print(initial.fluent)] = initial.value;
  }
  if (pddl::has_total_cost(domain_)) state.values.emplace("(" + std::string(pddl::kTotalCost) + ")", 0);
  return state;
}

bool Model::for_each_choice(const std::vector<pddl::TypedName>& variables, Bindings& bindings,
                            const std::function<bool()>& visit) const {
  std::vector<std::vector<int>> domains;
  for (const pddl::TypedName& variable : variables) {
    domains.push_back(objects_.of_types(variable.types));
    if (domains.back().empty()) return true;
  }
  std::vector<std::size_t> chosen;  // of the bound variables, the last one running fastest
  const auto bind = [&](std::size_t variable, std::size_t choice) {
    const int object = domains[variable][choice];
    bindings.push(variables[variable].name, objects_[static_cast<std::size_t>(object)].name);
    chosen.push_back(choice);
  };
  while (true) {
    while (chosen.size() < variables.size()) bind(chosen.size(), 0);
    const bool go_on = visit();
    std::size_t next = 0;
    while (!chosen.empty() && next == 0) {  // takes back all that have no further choice, and one more
      bindings.pop();
      next = chosen.back() + 1;
      chosen.pop_back();
      if (!go_on || next == domains[chosen.size()].size()) next = 0;
    }
    if (next == 0) return go_on;
    bind(chosen.size(), next);
  }
}

}  // namespace roci::planner::temporal_pddl::validate
