#include "planner_svc/temporal_pddl/validate/bindings.hpp"

#include <algorithm>
#include <stdexcept>

namespace roci::planner::temporal_pddl::validate {

std::string_view Bindings::object_of(const pddl::Term& term) const {
  if (!term.is_variable()) return term.name;
  const auto it = std::find_if(pairs_.begin(), pairs_.end(),
                               [&](const Pair& pair) { return pair.variable == term.name; });
  if (it == pairs_.end()) throw std::logic_error("unbound variable " + term.name);
  return it->object;
}

std::string Bindings::ground(const pddl::Atom& atom) const {
  std::string text;
  text.reserve(64);  // of most atoms
  text += '(';
  text += atom.symbol;
  for (const pddl::Term& term : atom.arguments) {
    text += ' ';
    text += object_of(term);
  }
  text += ')';
  return text;
}

std::string Bindings::instantiate(std::string_view printed) const {
  std::string text;
  while (!printed.empty()) {
    const std::size_t variable = std::min(printed.find('?'), printed.size());
    text += printed.substr(0, variable);
    printed.remove_prefix(variable);
    const std::string_view name = printed.substr(0, printed.find_first_of(" )"));
    const auto it =
        std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& pair) { return pair.variable == name; });
    text += it == pairs_.end() ? name : it->object;
    printed.remove_prefix(name.size());
  }
  return text;
}

}  // namespace roci::planner::temporal_pddl::validate
