#include "core/pddl/state_levels.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/print_parts.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

// Levels of more than that would be as many instances of every action that reads them.
constexpr std::size_t kMostLevels = 32;

std::string type_of(const std::string& fluent) { return fluent + "-level"; }

std::string object_of(const std::string& fluent, double level) { return fluent + "-" + print_number(level); }

// Calls visit(atom, quantified) for each application of a function, with the names of the quantified variables
// around it. `Visit` may change the atom unless the tree is const.
template <typename Visit>
class Walk {
 public:
  explicit Walk(Visit visit) : visit_(visit) {}

  template <typename E>
  void expression(E& one) {
    if (auto* atom = std::get_if<Atom>(&one.node)) visit_(*atom, quantified_);
    if (auto* arithmetic = std::get_if<Arithmetic>(&one.node))
      for (auto& operand : arithmetic->operands) expression(operand);
  }

  template <typename C>
  void condition(C& one) {
    std::visit(
        [&](auto& node) {
          using Node = std::remove_cvref_t<decltype(node)>;
          if constexpr (std::is_same_v<Node, And> || std::is_same_v<Node, Or>) {
            for (auto& part : node.parts) condition(part);
          } else if constexpr (std::is_same_v<Node, Not>) {
            condition(*node.body);
          } else if constexpr (std::is_same_v<Node, Imply>) {
            condition(*node.premise);
            condition(*node.conclusion);
          } else if constexpr (std::is_same_v<Node, Forall> || std::is_same_v<Node, Exists>) {
            within(node.variables, [&] { condition(*node.body); });
          } else if constexpr (std::is_same_v<Node, Comparison>) {
            expression(node.left);
            expression(node.right);
          }
        },
        one.node);
  }

  template <typename T>
  void timed(T& conditions) {
    condition(conditions.at_start);
    condition(conditions.over_all);
    condition(conditions.at_end);
  }

  template <typename Effects>
  void effects(Effects& all) {
    for (auto& one : all) {
      if (auto* change = std::get_if<Assignment>(&one.node)) expression(change->value);
      if (auto* when = std::get_if<When>(&one.node)) {
        timed(when->condition);
        effects(when->effects);
      }
      if (auto* forall = std::get_if<ForallEffect>(&one.node))
        within(forall->variables, [&] { effects(forall->effects); });
    }
  }

  template <typename A>
  void action(A& one) {
    if constexpr (std::is_same_v<std::remove_const_t<A>, Action>) {
      condition(one.precondition);
      effects(one.effects);
    } else {
      for (auto& constraint : one.duration) expression(constraint.bound);
      timed(one.condition);
      effects(one.start_effects);
      effects(one.end_effects);
      effects(one.continuous_effects);
    }
  }

 private:
  template <typename Work>
  void within(const std::vector<TypedName>& variables, Work work) {
    const std::size_t before = quantified_.size();
    for (const TypedName& variable : variables) quantified_.push_back(variable.name);
    work();
    quantified_.resize(before);
  }

  Visit visit_;
  std::vector<std::string> quantified_;
};

const Signature* find(const std::vector<Signature>& signatures, const std::string& name) {
  const auto found = std::ranges::find(signatures, name, &Signature::name);
  return found == signatures.end() ? nullptr : &*found;
}

// The positions of the fluent's arguments among the parameters of the function; the size of these where one is none.
std::vector<std::size_t> positions(const StateDependence& dependence, const Signature& function) {
  std::vector<std::size_t> out;
  for (const Term& term : dependence.fluent.arguments) {
    const auto found = std::ranges::find(function.parameters, term.name, &TypedName::name);
    out.push_back(static_cast<std::size_t>(found - function.parameters.begin()));
  }
  return out;
}

class Checker {
 public:
  explicit Checker(const Domain& domain) : domain_(domain) {}

  std::vector<Diagnostic> run() {
    for (const Module& module : domain_.modules)
      for (const StateDependence& dependence : module.dependences) check(dependence, module);
    if (dependent_.empty()) return std::move(findings_);
    Walk outside([&](const Atom& atom, const std::vector<std::string>&) {
      if (dependent_.contains(atom.symbol))
        add(atom.where,
            "'" + atom.symbol + "' depends on the state, and a derived predicate has no start to read it at",
            "use it in actions alone");
    });
    for (const DerivedPredicate& derived : domain_.derived) outside.condition(derived.body);
    for (const Action& action : domain_.actions) check_uses(action);
    for (const DurativeAction& action : domain_.durative_actions) check_uses(action);
    return std::move(findings_);
  }

 private:
  void add(SourceLocation where, std::string message, std::string remedy) {
    findings_.push_back({domain_.file, where, std::move(message), std::move(remedy)});
  }

  void check(const StateDependence& dependence, const Module& module) {
    const std::string& name = dependence.fluent.symbol;
    const Signature* function = find(module.functions, dependence.function);
    const Signature* fluent = find(domain_.functions, name);
    if (!function) return;  // its own declaration is at fault
    if (!fluent)
      return add(dependence.fluent.where, "'" + name + "' is no fluent of the domain",
                 "declare it in :functions");
    if (fluent->parameters.size() != dependence.fluent.arguments.size())
      return add(dependence.fluent.where,
                 "'" + name + "' has " + std::to_string(fluent->parameters.size()) + " arguments",
                 "use as many as :functions says");
    for (const std::size_t position : positions(dependence, *function)) {
      if (position == function->parameters.size())
        return add(dependence.fluent.where,
                   "the arguments of '" + name + "' must be parameters of the function",
                   "use variables of (" + function->name + " …)");
    }
    if (dependence.levels.empty() || dependence.levels.size() > kMostLevels ||
        std::ranges::adjacent_find(dependence.levels, std::greater_equal{}) != dependence.levels.end())
      return add(dependence.where,
                 "levels must ascend, from 1 to " + std::to_string(kMostLevels) + " of them",
                 "write (" + name + " …) 0 20 50: each holds up to the next");
    const auto [known, first] = levels_.emplace(name, dependence.levels);
    if (!first && known->second != dependence.levels)
      return add(dependence.where, "'" + name + "' has other levels above",
                 "declare the same levels for all functions");
    for (const double level : dependence.levels)
      check_name(object_of(name, level), domain_.constants, dependence);
    check_name(type_of(name), domain_.types, dependence);
    dependent_.emplace(function->name, std::pair(function, &dependence));
  }

  void check_name(const std::string& name, const std::vector<TypedName>& taken,
                  const StateDependence& dependence) {
    if (std::ranges::find(taken, name, &TypedName::name) != taken.end())
      add(dependence.where, "'" + name + "' is needed as the name of a level",
          "rename what has it in this domain");
  }

  template <typename A>
  void check_uses(const A& action) {
    Walk uses([&](const Atom& atom, const std::vector<std::string>& quantified) {
      const auto [begin, end] = dependent_.equal_range(atom.symbol);
      for (auto one = begin; one != end; ++one) {
        for (const std::size_t position : positions(*one->second.second, *one->second.first)) {
          if (std::ranges::count(quantified, atom.arguments[position].name) > 0)
            add(atom.where,
                "'" + atom.arguments[position].name + "' is quantified, and '" + atom.symbol +
                    "' depends on the state of it at the start",
                "use a parameter of the action");
        }
      }
    });
    uses.action(action);
  }

  const Domain& domain_;
  std::map<std::string, std::vector<double>> levels_;  // by fluent
  std::multimap<std::string, std::pair<const Signature*, const StateDependence*>> dependent_;
  std::vector<Diagnostic> findings_;
};

Condition comparison(ComparisonOperator op, const Atom& fluent, double number) {
  return {Comparison{op, Expression{fluent, {}}, Expression{Number{number}, {}}}, {}};
}

// (or (and (= ?level g-0) (>= (g) 0) (< (g) 20)) …)
Condition at_level(const std::string& variable, const Atom& fluent, const std::vector<double>& levels) {
  Or any;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    And one;
    one.parts.push_back({TermEquality{{variable, {}}, {object_of(fluent.symbol, levels[i]), {}}}, {}});
    one.parts.push_back(comparison(ComparisonOperator::greater_equal, fluent, levels[i]));
    if (i + 1 < levels.size())
      one.parts.push_back(comparison(ComparisonOperator::less, fluent, levels[i + 1]));
    any.parts.push_back({std::move(one), {}});
  }
  return {std::move(any), {}};
}

void add_part(Condition& condition, Condition part) {
  if (auto* all = std::get_if<And>(&condition.node)) return all->parts.push_back(std::move(part));
  And both;
  both.parts.push_back(std::move(condition));
  both.parts.push_back(std::move(part));
  condition = {std::move(both), {}};
}

class Lowering {
 public:
  explicit Lowering(Domain& domain) : domain_(domain) {}

  void run() {
    for (Module& module : domain_.modules) {
      for (const StateDependence& dependence : module.dependences) {
        const auto function = std::ranges::find(module.functions, dependence.function, &Signature::name);
        declare(dependence);
        dependences_.emplace(function->name, std::pair(positions(dependence, *function), dependence));
      }
      for (const StateDependence& dependence : module.dependences) add_parameter(dependence, module);
      module.dependences.clear();
    }
    if (dependences_.empty()) return;
    for (Action& action : domain_.actions) lower(action, action.precondition);
    for (DurativeAction& action : domain_.durative_actions) lower(action, action.condition.at_start);
  }

 private:
  void declare(const StateDependence& dependence) {
    const std::string& fluent = dependence.fluent.symbol;
    if (!declared_.insert(fluent).second) return;
    domain_.types.push_back({type_of(fluent), {"object"}, dependence.where});
    for (const double level : dependence.levels)
      domain_.constants.push_back({object_of(fluent, level), {type_of(fluent)}, dependence.where});
  }

  void add_parameter(const StateDependence& dependence, Module& module) {
    const std::string& fluent = dependence.fluent.symbol;
    const auto function = std::ranges::find(module.functions, dependence.function, &Signature::name);
    LevelParameter parameter{function->name, fluent, positions(dependence, *function), {}};
    for (const double level : dependence.levels) parameter.levels[object_of(fluent, level)] = level;
    domain_.level_parameters.push_back(std::move(parameter));
    function->parameters.push_back({"?" + type_of(fluent) + std::to_string(function->parameters.size()),
                                    {type_of(fluent)},
                                    dependence.where});
  }

  template <typename A>
  void lower(A& action, Condition& start) {
    std::set<std::string> taken;
    for (const TypedName& parameter : action.parameters) taken.insert(parameter.name);
    std::map<std::string, std::string> variables;  // of levels, by the fluent as the action applies it
    std::vector<Condition> conditions;
    Walk uses([&](Atom& atom, const std::vector<std::string>& quantified) {
      taken.insert(quantified.begin(), quantified.end());
      std::vector<Term> levels;
      const auto [begin, end] = dependences_.equal_range(atom.symbol);
      for (auto one = begin; one != end; ++one) {
        const auto& [places, dependence] = one->second;
        Atom fluent{dependence.fluent.symbol, {}, atom.where};
        for (const std::size_t place : places) fluent.arguments.push_back(atom.arguments[place]);
        std::string& variable = variables[print(fluent)];
        if (variable.empty()) {
          variable = unused("?" + type_of(fluent.symbol), taken);
          action.parameters.push_back({variable, {type_of(fluent.symbol)}, action.where});
          conditions.push_back(at_level(variable, fluent, dependence.levels));
        }
        levels.push_back({variable, atom.where});
      }
      std::ranges::move(levels, std::back_inserter(atom.arguments));
    });
    uses.action(action);
    for (Condition& condition : conditions) add_part(start, std::move(condition));
  }

  static std::string unused(const std::string& wanted, std::set<std::string>& taken) {
    std::string name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) name = wanted + "-" + std::to_string(i);
    return name;
  }

  Domain& domain_;
  std::set<std::string> declared_;  // fluents
  std::multimap<std::string, std::pair<std::vector<std::size_t>, StateDependence>>
      dependences_;  // by function
};

}  // namespace

std::vector<Diagnostic> check_state_dependence(const Domain& domain) { return Checker(domain).run(); }

std::vector<Diagnostic> check_state_dependence(const Problem& problem, const Domain& domain) {
  std::vector<Diagnostic> findings;
  Walk uses([&](const Atom& atom, const std::vector<std::string>&) {
    if (std::ranges::find(domain.level_parameters, atom.symbol, &LevelParameter::function) !=
        domain.level_parameters.end())
      findings.push_back({problem.file, atom.where,
                          "'" + atom.symbol + "' depends on the state, and has no value for the whole plan",
                          "use it in actions alone"});
  });
  uses.condition(problem.goal);
  if (problem.metric) uses.expression(problem.metric->expression);
  return findings;
}

void lower_state_dependence(Domain& domain) { Lowering(domain).run(); }

}  // namespace roci::pddl
