#include "core/pddl/check_parts.hpp"

namespace roci::pddl {

namespace {

template <typename Map>
typename Map::mapped_type find_in(const Map& map, const std::string& name) {
  const auto it = map.find(name);
  return it == map.end() ? nullptr : it->second;
}

}  // namespace

Symbols::Symbols(const Domain& domain) : types_(domain) {
  for (const Signature& predicate : domain.predicates) predicates_.emplace(predicate.name, &predicate);
  for (const Signature& function : domain.functions) fluents_.emplace(function.name, &function);
  for (const Module& module : domain.modules) {
    for (const Signature& function : module.functions) externals_.emplace(function.name, &function);
  }
  add_objects(domain.constants);
  for (const DerivedPredicate& derived : domain.derived) derived_.insert(derived.head.name);
}

void Symbols::add_objects(const std::vector<TypedName>& objects) {
  for (const TypedName& object : objects) {
    auto& types = objects_[object.name];
    types.insert(types.end(), object.types.begin(), object.types.end());
  }
}

const Signature* Symbols::find_predicate(const std::string& name) const { return find_in(predicates_, name); }
const Signature* Symbols::find_fluent(const std::string& name) const { return find_in(fluents_, name); }
const Signature* Symbols::find_external(const std::string& name) const { return find_in(externals_, name); }
const std::vector<std::string>* Symbols::find_object_types(const std::string& name) const {
  const auto it = objects_.find(name);
  return it == objects_.end() ? nullptr : &it->second;
}

void check_types(const std::vector<TypedName>& names, const Symbols& symbols, Findings& findings) {
  for (const TypedName& name : names) {
    for (const std::string& type : name.types) {
      if (symbols.types().knows(type)) continue;
      findings.add(name.where, "unknown type '" + type + "' of '" + name.name + "'", "declare it in :types");
    }
  }
}

void check_variables(const std::vector<TypedName>& variables, const Symbols& symbols, Findings& findings) {
  check_types(variables, symbols, findings);
  std::set<std::string> seen;
  for (const TypedName& variable : variables) {
    if (seen.insert(variable.name).second) continue;
    findings.add(variable.where, "variable '" + variable.name + "' is declared twice", "rename one");
  }
}

}  // namespace roci::pddl
