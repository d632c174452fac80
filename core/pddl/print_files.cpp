#include "core/pddl/print_parts.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

// Prints one entry per line, since a problem may hold tens of thousands.
class Section {
 public:
  explicit Section(std::string_view keyword) : text_("  (" + std::string(keyword)) {}
  void add(const std::string& entry) {
    text_ += "\n    " + entry;
    empty_ = false;
  }
  std::string close() { return text_ + ")\n"; }
  std::string close_unless_empty() { return empty_ ? "" : close(); }

 private:
  std::string text_;
  bool empty_ = true;
};

std::string print_names(std::string_view keyword, const std::vector<TypedName>& names) {
  Section section(keyword);
  for (const TypedName& name : names) section.add(print_typed_names({name}));
  return section.close_unless_empty();
}

std::string print_signatures(std::string_view keyword, const std::vector<Signature>& signatures) {
  Section section(keyword);
  for (const Signature& signature : signatures) section.add(print_signature(signature));
  return section.close_unless_empty();
}

std::string print_requirements(const std::vector<Requirement>& requirements) {
  if (requirements.empty()) return "";
  std::string text = "  (:requirements";
  for (const Requirement& requirement : requirements) text += " " + requirement.keyword;
  return text + ")\n";
}

std::string print_dependence(const StateDependence& dependence) {
  std::string text = " :depends-on (" + print(dependence.fluent);
  for (const double level : dependence.levels) text += " " + print_number(level);
  return text + ")";
}

std::string print_modules(const std::vector<Module>& modules) {
  Section section(":modules");
  for (const Module& module : modules) {
    std::string text = "(:module " + module.name;
    for (const Signature& function : module.functions) {
      text += "\n      (:function " + print_signature(function);
      for (const StateDependence& dependence : module.dependences)
        if (dependence.function == function.name) text += print_dependence(dependence);
      text += ")";
    }
    section.add(text + ")");
  }
  return section.close_unless_empty();
}

std::string print_value(const Atom& fluent, double value) {
  return "(= " + print(fluent) + " " + print_number(value) + ")";
}

std::string print_init(const Problem& problem) {
  Section section(":init");
  for (const Atom& fact : problem.facts) section.add(print(fact));
  for (const Atom& fact : problem.false_facts) section.add(print(Literal{fact, true}));
  for (const InitialValue& initial : problem.values) section.add(print_value(initial.fluent, initial.value));
  for (const TimedLiteral& timed : problem.timed_literals) {
    section.add("(at " + print_number(timed.time) + " " + print(timed.literal) + ")");
  }
  for (const TimedValue& timed : problem.timed_values) {
    section.add("(at " + print_number(timed.time) + " " + print_value(timed.fluent, timed.value) + ")");
  }
  return section.close();
}

}  // namespace

std::string print_signature(const Signature& signature) {
  if (signature.parameters.empty()) return "(" + signature.name + ")";
  return "(" + signature.name + " " + print_typed_names(signature.parameters) + ")";
}

std::string print(const Domain& domain) {
  std::string text = "(define (domain " + domain.name + ")\n" + print_requirements(domain.requirements) +
                     print_names(":types", domain.types) + print_names(":constants", domain.constants) +
                     print_signatures(":predicates", domain.predicates) +
                     print_signatures(":functions", domain.functions) + print_modules(domain.modules);
  for (const DerivedPredicate& derived : domain.derived) {
    text += "  (:derived " + print_signature(derived.head) + "\n    " + print(derived.body) + ")\n";
  }
  for (const Action& action : domain.actions) text += print_action(action);
  for (const DurativeAction& action : domain.durative_actions) text += print_action(action);
  return text + ")\n";
}

std::string print(const Problem& problem) {
  std::string text = "(define (problem " + problem.name + ")\n  (:domain " + problem.domain_name + ")\n" +
                     print_requirements(problem.requirements) + print_names(":objects", problem.objects) +
                     print_init(problem) + "  (:goal " + print(problem.goal) + ")\n";
  if (problem.metric) {
    const bool minimize = problem.metric->sense == Metric::Sense::minimize;
    text += std::string("  (:metric ") + (minimize ? "minimize " : "maximize ") +
            print(problem.metric->expression) + ")\n";
  }
  return text + ")\n";
}

}  // namespace roci::pddl
