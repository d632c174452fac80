#include "core/pddl/stratify.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/pddl/overloaded.hpp"

namespace roci::pddl {

namespace {

struct Dependency {
  std::string on;
  bool negative;

  auto operator<=>(const Dependency&) const = default;
};

void collect(const Condition& condition, bool negative, std::set<Dependency>& out) {
  const auto collect_all = [&](const std::vector<Condition>& parts) {
    for (const Condition& part : parts) collect(part, negative, out);
  };
  std::visit(Overloaded{[&](const And& all) { collect_all(all.parts); },
                        [&](const Or& any) { collect_all(any.parts); },
                        [&](const Not& negation) { collect(*negation.body, !negative, out); },
                        [&](const Imply& imply) {
                          collect(*imply.premise, !negative, out);
                          collect(*imply.conclusion, negative, out);
                        },
                        [&](const Forall& forall) { collect(*forall.body, negative, out); },
                        [&](const Exists& exists) { collect(*exists.body, negative, out); },
                        [&](const Atom& atom) {
                          out.insert({atom.symbol, negative});
                        },
                        [](const TermEquality&) {}, [](const Comparison&) {}},
             condition.node);
}

}  // namespace

Strata stratify(const Domain& domain) {
  std::map<std::string, std::set<Dependency>> dependencies;
  for (const DerivedPredicate& derived : domain.derived) {
    collect(derived.body, false, dependencies[derived.head.name]);
  }
  Strata strata;
  std::map<std::string, std::vector<std::pair<std::string, bool>>> dependents;  // with whether they negate
  std::vector<std::string> open;  // whose dependents may stand too low
  for (const auto& [name, needs] : dependencies) {
    strata.layer[name] = 0;
    open.push_back(name);
    for (const Dependency& need : needs)
      if (dependencies.contains(need.on)) dependents[need.on].emplace_back(name, need.negative);
  }
  while (!open.empty()) {
    const std::string below = std::move(open.back());
    open.pop_back();
    for (const auto& [name, negative] : dependents[below]) {
      int& layer = strata.layer[name];
      const int least = strata.layer[below] + (negative ? 1 : 0);
      if (least <= layer) continue;
      layer = least;
      if (layer >= kMaxLayers) {
        strata.failed = name;
        return strata;
      }
      open.push_back(name);
    }
  }
  return strata;
}

}  // namespace roci::pddl
