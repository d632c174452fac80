#include <algorithm>
#include <set>

#include "core/pddl/check_parts.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl {

namespace {

template <typename Map>
typename Map::mapped_type find_in(const Map& map, std::string_view name) {
  const auto it = map.find(name);
  return it == map.end() ? nullptr : it->second;
}

template <typename Map>
void offer_keys(const Map& map, words::NearestWord& near) {
  std::vector<std::string_view> names;
  for (const auto& [name, ignored] : map) names.push_back(name);
  std::ranges::sort(names);  // the first of equally near ones is told
  for (const std::string_view name : names) near.offer(name);
}

}  // namespace

Symbols::Symbols(const Domain& domain, Unread unread) : types_(domain), unread_(unread) {
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
    for (const std::string& type : object.types)
      if (types.size() <= kMostTypes && std::ranges::count(types, type) == 0) types.push_back(type);
  }
}

std::string Symbols::remedy_for_type(std::string_view name, std::string_view otherwise) const {
  words::NearestWord near(name);
  if (may_compare()) types_.offer(near);
  return near.remedy(otherwise);
}

std::string Symbols::remedy_for_predicate(std::string_view name, std::string_view otherwise) const {
  words::NearestWord near(name);
  if (may_compare()) offer_keys(predicates_, near);
  if (near.found().empty() && find_fluent(name))
    return "it is a function: compare its value with a number; else " + std::string(otherwise);
  return near.remedy(otherwise);
}

std::string Symbols::remedy_for_function(std::string_view name, std::string_view otherwise) const {
  words::NearestWord near(name);
  if (may_compare()) {
    offer_keys(fluents_, near);
    offer_keys(externals_, near);
  }
  if (near.found().empty() && find_predicate(name))
    return "it is a predicate and has no value; else " + std::string(otherwise);
  return near.remedy(otherwise);
}

std::string Symbols::remedy_for_object(std::string_view name, std::string_view otherwise) const {
  words::NearestWord near(name);
  if (may_compare()) offer_keys(objects_, near);
  return near.remedy(otherwise);
}

const Signature* Symbols::find_predicate(std::string_view name) const { return find_in(predicates_, name); }
const Signature* Symbols::find_fluent(std::string_view name) const { return find_in(fluents_, name); }
const Signature* Symbols::find_external(std::string_view name) const { return find_in(externals_, name); }
const std::vector<std::string>* Symbols::find_object_types(std::string_view name) const {
  const auto it = objects_.find(name);
  return it == objects_.end() ? nullptr : &it->second;
}

void check_types(const std::vector<TypedName>& names, const Symbols& symbols, Findings& findings) {
  for (const TypedName& name : names) {
    for (const std::string& type : name.types) {
      if (symbols.types().knows(type) || symbols.unread().types) continue;
      findings.add(name.where, "unknown type '" + type + "' of '" + name.name + "'",
                   symbols.remedy_for_type(type, "declare it in :types"));
    }
    const std::vector<std::string>* all = symbols.find_object_types(name.name);
    if (all && all->size() > Symbols::kMostTypes) {
      findings.add(name.where,
                   "'" + name.name + "' has more than " + std::to_string(Symbols::kMostTypes) + " types",
                   "declare a type above them");
    }
  }
}

void check_variables(const std::vector<TypedName>& variables, const Symbols& symbols, Findings& findings) {
  check_types(variables, symbols, findings);
  std::set<std::string_view> seen;
  for (const TypedName& variable : variables) {
    if (seen.insert(variable.name).second) continue;
    findings.add(variable.where, "variable '" + variable.name + "' is declared twice", "rename one");
  }
}

}  // namespace roci::pddl
