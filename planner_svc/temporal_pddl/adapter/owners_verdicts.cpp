#include "planner_svc/temporal_pddl/adapter/owners_verdicts.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "planner_svc/engine/owners_words.hpp"

namespace roci::planner::temporal_pddl::adapter {

using engine::FunctionUse, engine::Object;

namespace {

std::set<std::string> objects_in(const std::vector<std::string>& facts) {
  std::set<std::string> out;
  for (std::string fact : facts) {
    std::ranges::replace_if(
        fact, [](char c) { return c == '(' || c == ')'; }, ' ');
    std::istringstream words(fact);
    for (std::string word; words >> word;) out.insert(word);
  }
  return out;
}

// With the objects that stand beside one of them in a fact that holds at the beginning.
std::set<std::string> with_neighbours(const std::set<std::string>& named, const pddl::Problem& problem) {
  std::set<std::string> out = named;
  for (const pddl::Atom& fact : problem.facts) {
    const auto is_named = [&](const pddl::Term& term) { return named.contains(term.name); };
    if (std::ranges::none_of(fact.arguments, is_named)) continue;
    for (const pddl::Term& term : fact.arguments) out.insert(term.name);
  }
  return out;
}

}  // namespace

engine::OwnersWords words_against(const std::vector<std::string>& facts, const pddl::Problem& problem,
                                  const std::vector<Object>& objects, std::span<const FunctionUse> uses) {
  return engine::words_against(with_neighbours(objects_in(facts), problem), objects, uses);
}

}  // namespace roci::planner::temporal_pddl::adapter
