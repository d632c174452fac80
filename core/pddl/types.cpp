#include "core/pddl/types.hpp"

#include <algorithm>

namespace roci::pddl {

TypeTree::TypeTree(const Domain& domain) {
  std::map<std::string, std::vector<std::string>> parents;
  parents["object"];
  for (const TypedName& type : domain.types) {
    auto& above = parents[type.name];
    above.insert(above.end(), type.types.begin(), type.types.end());
    for (const std::string& parent : type.types) parents[parent];
  }
  for (const auto& [type, above] : parents) {
    auto& closure = ancestors_[type];
    std::vector<std::string> open = {type};
    while (!open.empty() && too_deep_.empty()) {
      const std::string next = std::move(open.back());
      open.pop_back();
      if (!closure.insert(next).second) continue;
      if (closure.size() > kMostAbove + 1) too_deep_ = type;
      const auto& further = parents.at(next);
      open.insert(open.end(), further.begin(), further.end());
    }
    closure.insert("object");
  }
  if (too_deep_.empty()) return;
  for (auto& [type, closure] : ancestors_) closure = {type, "object"};
}

void TypeTree::offer(words::NearestWord& word) const {
  for (const auto& [type, ignored] : ancestors_) word.offer(type);
}

bool TypeTree::knows(std::string_view type) const { return ancestors_.contains(type); }

bool TypeTree::is_a(std::string_view type, std::string_view ancestor) const {
  const auto it = ancestors_.find(type);
  return it != ancestors_.end() && it->second.contains(ancestor);
}

std::set<std::string> TypeTree::ancestors(std::string_view type) const {
  const auto it = ancestors_.find(type);
  return it == ancestors_.end() ? std::set<std::string>()
                                : std::set<std::string>(it->second.begin(), it->second.end());
}

bool TypeTree::is_any(std::string_view type, const std::vector<std::string>& ancestors) const {
  const auto it = ancestors_.find(type);
  return it != ancestors_.end() && std::ranges::any_of(ancestors, [&](const std::string& ancestor) {
           return it->second.contains(ancestor);
         });
}

bool TypeTree::accepts(const std::vector<std::string>& wanted, const std::vector<std::string>& given) const {
  return std::ranges::all_of(given, [&](const std::string& type) { return is_any(type, wanted); });
}

ObjectTable::ObjectTable(const Domain& domain, const Problem& problem) : types_(domain) {
  for (const auto* names : {&domain.constants, &problem.objects}) {
    for (const TypedName& name : *names) {
      const auto [it, first] = numbers_.emplace(name.name, static_cast<int>(objects_.size()));
      if (first) {
        objects_.push_back(name);
      } else {
        auto& types = objects_[it->second].types;
        types.insert(types.end(), name.types.begin(), name.types.end());
      }
    }
  }
  for (std::size_t object = 0; object < objects_.size(); ++object) {
    std::set<std::string> all;
    for (const std::string& type : objects_[object].types) all.merge(types_.ancestors(type));
    for (const std::string& type : all) by_type_[type].push_back(static_cast<int>(object));
  }
}

int ObjectTable::find(std::string_view name) const {
  const auto it = numbers_.find(name);
  return it == numbers_.end() ? -1 : it->second;
}

bool ObjectTable::has_type(std::size_t object, const std::vector<std::string>& types) const {
  const auto& own = objects_[object].types;
  return std::any_of(own.begin(), own.end(),
                     [&](const std::string& type) { return types_.is_any(type, types); });
}

std::vector<int> ObjectTable::of_types(const std::vector<std::string>& types) const {
  std::vector<int> result;
  for (const std::string& type : types) {
    const auto it = by_type_.find(type);
    if (it != by_type_.end()) result.insert(result.end(), it->second.begin(), it->second.end());
  }
  if (types.size() > 1) {
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
  }
  return result;
}

}  // namespace roci::pddl
