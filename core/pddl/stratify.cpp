#include "core/pddl/stratify.hpp"

#include <algorithm>
#include <set>

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
  for (const auto& [name, ignored] : dependencies) strata.layer[name] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [name, needs] : dependencies) {
      int& layer = strata.layer[name];
      for (const Dependency& need : needs) {
        const auto other = strata.layer.find(need.on);
        if (other == strata.layer.end()) continue;
        const int least = other->second + (need.negative ? 1 : 0);
        if (least <= layer) continue;
        layer = least;
        changed = true;
        if (layer >= kMaxLayers) {
          strata.failed = name;
          return strata;
        }
      }
    }
  }
  return strata;
}

}  // namespace roci::pddl
