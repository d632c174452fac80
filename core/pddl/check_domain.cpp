#include "core/pddl/check.hpp"
#include "core/pddl/check_parts.hpp"
#include "core/pddl/settle.hpp"
#include "core/pddl/state_levels.hpp"
#include "core/pddl/stratify.hpp"

namespace roci::pddl {

namespace {

class DomainChecker {
 public:
  DomainChecker(const Domain& domain, const Unread& unread)
      : domain_(domain), findings_(domain.file), symbols_(domain, unread), formulas_(symbols_, findings_) {}

  std::vector<Diagnostic> run() {
    check_hierarchy();
    check_types(domain_.constants, symbols_, findings_);
    check_signatures();
    check_derived();
    std::set<std::string> names;
    for (const Action& action : domain_.actions) {
      check_unique(names, action.name, "action", action.where);
      check_action(action);
    }
    for (const DurativeAction& action : domain_.durative_actions) {
      check_unique(names, action.name, "action", action.where);
      check_action(action);
    }
    return findings_.take();
  }

 private:
  void check_unique(std::set<std::string>& seen, const std::string& name, std::string_view what,
                    SourceLocation where) {
    if (seen.insert(name).second) return;
    findings_.add(where, std::string(what) + " '" + name + "' is declared twice", "rename or remove one");
  }

  void check_hierarchy() {
    const std::string& too_deep = symbols_.types().too_deep();
    for (const TypedName& type : domain_.types) {
      if (!too_deep.empty() && type.name == too_deep) {
        return findings_.add(type.where,
                             "type '" + type.name + "' has more than " +
                                 std::to_string(TypeTree::kMostAbove) + " types above it",
                             "take types out of the chain in :types");
      }
      for (const std::string& parent : type.types) {
        if (type.name == "object" || !symbols_.types().is_a(parent, type.name)) continue;
        findings_.add(type.where, "type '" + type.name + "' is above itself", "break the circle in :types");
      }
    }
  }

  void check_signatures() {
    std::set<std::string> predicates;
    for (const Signature& predicate : domain_.predicates) {
      check_unique(predicates, predicate.name, "predicate", predicate.where);
      check_variables(predicate.parameters, symbols_, findings_);
    }
    std::set<std::string> functions;
    const auto check_function = [&](const Signature& function) {
      check_unique(functions, function.name, "function", function.where);
      check_variables(function.parameters, symbols_, findings_);
    };
    for (const Signature& function : domain_.functions) check_function(function);
    std::set<std::string> modules;
    for (const Module& module : domain_.modules) {
      check_unique(modules, module.name, "module", module.where);
      for (const Signature& function : module.functions) check_function(function);
    }
  }

  void check_derived() {
    for (const DerivedPredicate& derived : domain_.derived) {
      const Signature* declared = symbols_.find_predicate(derived.head.name);
      if (!declared) {
        if (!symbols_.unread().predicates) {
          findings_.add(derived.head.where, "unknown predicate '" + derived.head.name + "'",
                        symbols_.remedy_for_predicate(derived.head.name, "declare it in :predicates"));
        }
      } else if (declared->parameters.size() != derived.head.parameters.size()) {
        findings_.add(derived.head.where,
                      "derived predicate '" + derived.head.name + "' has another arity than declared",
                      "use the parameters of its declaration");
      }
      formulas_.bind(derived.head.parameters);
      formulas_.check_condition(derived.body);
      formulas_.unbind(derived.head.parameters);
    }
    const Strata strata = stratify(domain_);
    for (const DerivedPredicate& derived : domain_.derived) {
      if (derived.head.name != strata.failed) continue;
      findings_.add(derived.head.where,
                    "derived predicate '" + strata.failed + "' depends on its own negation, or on " +
                        std::to_string(kMaxLayers) + " negations in a row",
                    "derived predicates must be stratified");
      return;
    }
  }

  // An effect cannot wait for what is known only after it.
  void check_foresight(const std::vector<Effect>& effects) {
    for (const Effect& effect : effects) {
      if (const auto* forall = std::get_if<ForallEffect>(&effect.node)) check_foresight(forall->effects);
      const auto* when = std::get_if<When>(&effect.node);
      if (!when) continue;
      check_foresight(when->effects);
      if (is_true(when->condition.over_all) && is_true(when->condition.at_end)) continue;
      findings_.add(effect.where, "an effect at start depends on a condition of a later time",
                    "put the effect at the end, or the condition at the start");
    }
  }

  static bool is_true(const Condition& condition) { return condition == Condition{}; }

  void check_action(const Action& action) {
    formulas_.bind(action.parameters);
    formulas_.check_condition(action.precondition);
    formulas_.check_effects(action.effects, {});
    formulas_.unbind(action.parameters);
  }

  void check_action(const DurativeAction& action) {
    formulas_.bind(action.parameters);
    for (const DurationConstraint& constraint : action.duration)
      formulas_.check_expression(constraint.bound, {});
    formulas_.check_timed(action.condition);
    check_foresight(action.start_effects);
    formulas_.check_effects(action.start_effects, {.duration = true});
    formulas_.check_effects(action.end_effects, {.duration = true});
    formulas_.check_effects(action.continuous_effects, {.duration = true, .continuous_time = true});
    formulas_.unbind(action.parameters);
  }

  const Domain& domain_;
  Findings findings_;
  Symbols symbols_;
  FormulaChecker formulas_;
};

}  // namespace

std::vector<Diagnostic> check(const Domain& domain, const Unread& unread) {
  return DomainChecker(domain, unread).run();
}

std::vector<Diagnostic> check(const Domain& domain) { return check(domain, Unread{}); }

Domain load_domain(std::string_view text, std::string_view file, Strictness strictness) {
  DiagnosticLog log{std::string(file), strictness};
  Unread unread;
  Domain domain = read_domain(text, log, unread);
  settle(domain, log);
  for (Diagnostic& finding : check(domain, unread)) log.add(std::move(finding));
  log.throw_errors();
  for (Diagnostic& finding : check_state_dependence(domain)) log.add(std::move(finding));
  log.throw_errors();
  lower_state_dependence(domain);
  domain.warnings = log.warnings();
  return domain;
}

}  // namespace roci::pddl
