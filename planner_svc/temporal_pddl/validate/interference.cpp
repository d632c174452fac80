#include "planner_svc/temporal_pddl/validate/interference.hpp"

#include <map>
#include <string_view>
#include <unordered_set>

namespace roci::planner::temporal_pddl::validate {

namespace {

using Names = std::unordered_set<std::string_view>;

std::optional<std::string> first_common(const Names& names, const std::vector<std::string>& others) {
  for (const std::string& other : others) {
    if (names.contains(other)) return other;
  }
  return {};
}

// Returns what `writer` does to `other`; asking again with the roles exchanged finds the rest.
std::optional<std::string> disturbs(const Footprint& writer, const Footprint& other) {
  const Names deleted(writer.changes.deleted.begin(), writer.changes.deleted.end());
  if (const auto fact = first_common(deleted, other.reads.facts)) return fact;
  if (const auto fact = first_common(deleted, other.changes.added)) return fact;
  const Names added(writer.changes.added.begin(), writer.changes.added.end());
  if (const auto fact = first_common(added, other.reads.facts)) return fact;
  Names set;
  Names set_otherwise;  // than by increase and decrease
  for (const NumericChange& change : writer.changes.numeric) {
    set.insert(change.fluent);
    if (!is_additive(change.op)) set_otherwise.insert(change.fluent);
  }
  if (const auto fluent = first_common(set, other.reads.values)) return fluent;
  for (const NumericChange& change : other.changes.numeric) {
    if (set_otherwise.contains(change.fluent)) return change.fluent;
  }
  return {};
}

}  // namespace

std::optional<std::string> interference(const Footprint& a, const Footprint& b) {
  if (const auto name = disturbs(a, b)) return name;
  return disturbs(b, a);
}

std::optional<std::string> conflict(const Changes& changes) {
  std::map<std::string_view, bool> additive_only;
  for (const NumericChange& change : changes.numeric) {
    const auto [it, first] = additive_only.emplace(change.fluent, is_additive(change.op));
    if (!first && !(it->second && is_additive(change.op))) return change.fluent;
  }
  return {};
}

}  // namespace roci::planner::temporal_pddl::validate
