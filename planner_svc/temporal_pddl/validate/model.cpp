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

// Adds the predicates and fluents that the condition looks at.
void collect_read(const pddl::Expression& expression, std::set<std::string>& out) {
  if (const auto* fluent = std::get_if<pddl::Atom>(&expression.node)) out.insert(fluent->symbol);
  if (const auto* sum = std::get_if<pddl::Arithmetic>(&expression.node))
    for (const pddl::Expression& operand : sum->operands) collect_read(operand, out);
}
void collect_read(const pddl::Condition& condition, std::set<std::string>& out) {
  const auto all_of = [&](const std::vector<pddl::Condition>& parts) {
    for (const pddl::Condition& part : parts) collect_read(part, out);
  };
  std::visit(pddl::Overloaded{[&](const pddl::And& all) { all_of(all.parts); },
                              [&](const pddl::Or& any) { all_of(any.parts); },
                              [&](const pddl::Not& negated) { collect_read(*negated.body, out); },
                              [&](const pddl::Imply& imply) {
                                collect_read(*imply.premise, out);
                                collect_read(*imply.conclusion, out);
                              },
                              [&](const pddl::Forall& forall) { collect_read(*forall.body, out); },
                              [&](const pddl::Exists& exists) { collect_read(*exists.body, out); },
                              [&](const pddl::Atom& atom) { out.insert(atom.symbol); },
                              [](const pddl::TermEquality&) {},
                              [&](const pddl::Comparison& comparison) {
                                collect_read(comparison.left, out);
                                collect_read(comparison.right, out);
                              }},
             condition.node);
}

// By symbol: the derived predicates whose rules look at it.
using Readers = std::map<std::string, std::set<std::string>>;

// All derived predicates whose truth may rest on one of these symbols.
std::set<std::string> resting_on(const Readers& readers, const std::set<std::string>& symbols) {
  std::set<std::string> out;
  std::vector<std::string> open(symbols.begin(), symbols.end());
  while (!open.empty()) {
    const auto found = readers.find(open.back());
    open.pop_back();
    if (found == readers.end()) continue;
    for (const std::string& name : found->second)
      if (out.insert(name).second) open.push_back(name);
  }
  return out;
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
  Readers readers;
  for (const pddl::DerivedPredicate& rule : domain.derived) {
    std::set<std::string> read;
    collect_read(rule.body, read);
    for (const std::string& symbol : read) readers[symbol].insert(rule.head.name);
  }
  changing_.merge(resting_on(readers, changing_));
  for (const auto& [name, rules] : rules_)
    if (resting_on(readers, {name}).contains(name)) recursive_.insert(name);
}

const std::vector<const pddl::DerivedPredicate*>& Model::rules(const std::string& predicate) const {
  static const std::vector<const pddl::DerivedPredicate*> none;
  const auto it = rules_.find(predicate);
  return it == rules_.end() ? none : it->second;
}

State Model::initial_state() const {
  State state;
  for (const pddl::Atom& fact : problem_.facts) state.facts.insert(pddl::print(fact));
  for (const bool negated : {true, false}) {
    for (const pddl::TimedLiteral& timed : problem_.timed_literals) {
      if (timed.time > 0 || timed.literal.negated != negated) continue;
      const std::string fact = pddl::print(timed.literal.atom);
      if (negated) {
        state.facts.erase(fact);
      } else {
        state.facts.insert(fact);
      }
    }
  }
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
