#include "exec_svc/problem/usable_parts.hpp"

#include <functional>
#include <string>

#include "core/pddl/check.hpp"
#include "core/pddl/printer.hpp"

namespace roci::exec::problem {
namespace {

// Returns why the problem is invalid as the planner will read it, or an empty text if it is valid.
std::string fault_of(const pddl::Problem& tree, const pddl::Domain& domain) {
  try {
    // What the planner would ignore is left out by name, too.
    for (const pddl::Diagnostic& warning : pddl::load_problem(print(tree), "problem", domain).warnings)
      if (warning.departure == pddl::Departure::undeclared_function) return warning.message;
    return "";
  } catch (const pddl::ParseError& error) {
    return error.diagnostic().message;
  }
}

// Removes what makes a problem with these objects invalid.
template <class Part, class Put, class Print>
void keep_usable(std::vector<Part>& parts, const pddl::Problem& bare, const pddl::Domain& domain, Put put,
                 Print print_part, Problem& out) {
  std::erase_if(parts, [&](const Part& part) {
    pddl::Problem with = bare;
    put(with, part);
    const std::string why = fault_of(with, domain);
    if (!why.empty()) out.left_out.push_back({print_part(part), why});
    return !why.empty();
  });
}

}  // namespace

void keep_usable_parts(pddl::Problem& tree, const std::vector<GoalPart>& goals, const pddl::Domain& domain,
                       Problem& out) {
  if (fault_of(tree, domain).empty()) return;
  pddl::Problem bare;
  bare.name = tree.name;
  bare.domain_name = tree.domain_name;
  bare.objects = tree.objects;
  bare.goal.node = pddl::And{};
  if (!fault_of(bare, domain).empty()) return;
  keep_usable(
      tree.facts, bare, domain,
      [](pddl::Problem& with, const pddl::Atom& fact) { with.facts.push_back(fact); },
      [](const pddl::Atom& fact) { return print(fact); }, out);
  keep_usable(
      tree.values, bare, domain,
      [](pddl::Problem& with, const pddl::InitialValue& value) { with.values.push_back(value); },
      [](const pddl::InitialValue& value) { return print(value.fluent); }, out);
  keep_usable(
      tree.timed_literals, bare, domain,
      [](pddl::Problem& with, const pddl::TimedLiteral& change) { with.timed_literals.push_back(change); },
      [](const pddl::TimedLiteral& change) { return print(change.literal); }, out);
  for (const GoalPart& goal : goals) {
    pddl::Problem with = bare;
    with.goal.node = pddl::And{goal.facts};
    if (std::string why = fault_of(with, domain); !why.empty())
      out.unusable_goals.push_back({goal.key, std::move(why)});
  }
}

}  // namespace roci::exec::problem
