#include "exec_svc/mission/domain_names.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "core/pddl/check.hpp"
#include "core/pddl/overloaded.hpp"
#include "core/pddl/types.hpp"
#include "core/words/nearest_word.hpp"
#include "exec_svc/mission/goal_kind_entries.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/mission/variable_count.hpp"

namespace roci::exec::mission {
namespace {

using roci::mission::Entry;

// Returns e.g. "battery, reserve; did you mean 'battery'?".
std::string known_names(const std::string& word, const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& one : all) out += (out.empty() ? "" : ", ") + one;
  return (out.empty() ? "none" : out) + words::did_you_mean(word, all);
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> out;
  for (const Named& one : all) out.push_back(one.name);
  return out;
}

void require_symbol(const Entry& entry, const std::string& name, std::size_t arguments,
                    const std::vector<pddl::Signature>& symbols, const std::string& what) {
  const auto symbol = std::ranges::find(symbols, name, &pddl::Signature::name);
  if (symbol == symbols.end()) {
    entry.fail("the domain has no " + what + " '" + name +
               "'; it has: " + known_names(name, names_of(symbols)));
  }
  if (symbol->parameters.size() != arguments) {
    entry.fail("'" + name + "' has " + std::to_string(symbol->parameters.size()) +
               " arguments in the domain, not " + std::to_string(arguments));
  }
}

// Requires of "(at ?1)" that the first word is one of the symbols and the others are its arguments.
void require_symbol(const Entry& entry, const std::string& text, const std::vector<pddl::Signature>& symbols,
                    const std::string& what) {
  const auto words = words_of(text);
  if (words.empty()) entry.fail("expected a " + what + ", e.g. \"(at home)\"");
  require_symbol(entry, words.front(), words.size() - 1, symbols, what);
}

class NameCheck {
 public:
  explicit NameCheck(const pddl::Domain& domain) : domain_(domain), types_(domain) {}

  void objects(const Entry& parent) const {
    const auto list = parent.find("objects");
    if (!list) return;
    list->each([&](const Entry& object) {
      const auto type = object.find("type");
      if (type && !types_.knows(type->text()))
        type->fail("the domain has no type '" + type->text() +
                   "'; it has: " + known_names(type->text(), names_of(domain_.types)));
    });
  }
  void facts(const Entry& parent, const char* key) const {
    const auto list = parent.find(key);
    if (!list) return;
    list->each(
        [&](const Entry& fact) { require_symbol(fact, fact.text(), domain_.predicates, "predicate"); });
  }
  void goals(const Entry& kind) const {
    const auto list = kind.find("goal");
    if (!list) return;
    list->each([&](const Entry& goal) {
      const pddl::Condition condition = read_goal(goal, kind, &domain_);
      const std::size_t variables = variable_count(condition);
      if (variables > kMostVariables)
        goal.fail("the goal has " + std::to_string(variables) + " variables, and " +
                  std::to_string(kMostVariables) + " are supported; use fewer quantifiers");
      formula(goal, condition);
    });
  }
  void fact(const Entry& parent, const char* key) const {
    if (const auto entry = parent.find(key))
      entry->attempt([&] { require_symbol(*entry, entry->text(), domain_.predicates, "predicate"); });
  }
  void states(const Entry& root, const char* key) const {
    const auto list = root.find(key);
    if (!list) return;
    list->each([&](const Entry& item) {
      if (const auto states = item.find("states"))
        states->each_field([&](const std::string&, const Entry& state) { facts(state, "facts"); });
    });
  }
  void fluents(const Entry& root) const {
    const auto list = root.find("fluents");
    if (!list) return;
    list->each([&](const Entry& item) {
      if (const auto fluent = item.find("fluent"))
        require_symbol(*fluent, fluent->text(), domain_.functions, "function");
    });
  }
  void windows(const Entry& root) const {
    const auto list = root.find("windows");
    if (!list) return;
    list->each([&](const Entry& item) { fact(item, "fact"); });
  }
  void goal_kinds(const Entry& root) const {
    const auto kinds = root.find("goal_kinds");
    if (!kinds) return;
    kinds->each_field([&](const std::string&, const Entry& kind) {
      objects(kind);
      facts(kind, "facts");
      facts(kind, "facts_while_open");
      goals(kind);
      fact(kind, "window");
      if (const auto unobserved = kind.find("unobserved"))
        unobserved->each([&](const Entry& item) { facts(item, "facts"); });
    });
  }
  void actions(const Entry& entry) const {
    std::vector<std::string> known;
    for (const pddl::Action& action : domain_.actions) known.push_back(action.name);
    for (const pddl::DurativeAction& action : domain_.durative_actions) known.push_back(action.name);
    std::set<std::string> meant;  // by misspelt names: not missing, too
    entry.each_field([&](const std::string& name, const Entry& binding) {
      if (std::ranges::find(known, name) != known.end()) return;
      meant.insert(words::nearest_word(name, known));
      binding.fail("the domain has no action '" + name + "'; name one of its actions" +
                   words::did_you_mean(name, known));
    });
    for (const std::string& name : known) {
      if (!entry.find(name) && !meant.contains(name))
        entry.complain("the domain's action '" + name + "' is missing; say which command it means");
    }
  }

 private:
  void formulas(const Entry& goal, const std::vector<pddl::Condition>& parts) const {
    for (const pddl::Condition& part : parts) formula(goal, part);
  }
  void formula(const Entry& goal, const pddl::Condition& condition) const {
    std::visit(pddl::Overloaded{
                   [&](const pddl::Atom& fact) {
                     require_symbol(goal, fact.symbol, fact.arguments.size(), domain_.predicates,
                                    "predicate");
                   },
                   [&](const pddl::And& all) { formulas(goal, all.parts); },
                   [&](const pddl::Or& any) { formulas(goal, any.parts); },
                   [&](const pddl::Not& negated) { formula(goal, *negated.body); },
                   [&](const pddl::Imply& imply) {
                     formula(goal, *imply.premise);
                     formula(goal, *imply.conclusion);
                   },
                   [&](const pddl::Forall& all) { formula(goal, *all.body); },
                   [&](const pddl::Exists& some) { formula(goal, *some.body); },
                   [&](const pddl::TermEquality&) {},
                   [&](const pddl::Comparison& comparison) {
                     number(goal, comparison.left);
                     number(goal, comparison.right);
                   },
               },
               condition.node);
  }
  void number(const Entry& goal, const pddl::Expression& expression) const {
    if (const auto* sum = std::get_if<pddl::Arithmetic>(&expression.node))
      for (const pddl::Expression& operand : sum->operands) number(goal, operand);
    const auto* fluent = std::get_if<pddl::Atom>(&expression.node);
    if (fluent == nullptr) return;
    for (const pddl::Module& module : domain_.modules)
      if (std::ranges::find(module.functions, fluent->symbol, &pddl::Signature::name) !=
          module.functions.end())
        goal.fail("nobody observes '" + fluent->symbol + "', a function of module '" + module.name +
                  "'; compare a fluent of the domain instead");
    require_symbol(goal, fluent->symbol, fluent->arguments.size(), domain_.functions, "function");
  }

  const pddl::Domain& domain_;
  pddl::TypeTree types_;
};

}  // namespace

pddl::Domain read_domain(const std::string& text, const std::string& file) {
  try {
    pddl::Domain domain = pddl::load_domain(text, file);
    require_few_variables(domain);
    return domain;
  } catch (const pddl::ParseError& error) {
    throw roci::mission::FileError(error.what());
  }
}

void require_domain_names(const Entry& root, const pddl::Domain& domain) {
  const NameCheck check(domain);
  check.objects(root);
  check.facts(root, "facts");
  check.states(root, "components");
  check.states(root, "families");
  check.fluents(root);
  check.windows(root);
  if (const auto actions = root.find("actions")) check.actions(*actions);
  check.goal_kinds(root);
}

}  // namespace roci::exec::mission
