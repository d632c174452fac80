#include "planner_svc/temporal_pddl/validate/interference.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace roci::planner::temporal_pddl::validate {

namespace {

// Holds names to be looked up; few of them are looked through.
class Names {
 public:
  template <typename Strings>
  explicit Names(const Strings& names) : few_(names.begin(), names.end()) {
    if (few_.size() > kFew) many_.insert(few_.begin(), few_.end());
  }

  bool contains(std::string_view name) const {
    return few_.size() > kFew ? many_.contains(name) : std::ranges::find(few_, name) != few_.end();
  }

 private:
  static constexpr std::size_t kFew = 16;

  std::vector<std::string_view> few_;
  std::unordered_set<std::string_view> many_;
};

std::optional<std::string> first_common(const Names& names, const std::vector<std::string>& others) {
  for (const std::string& other : others) {
    if (names.contains(other)) return other;
  }
  return {};
}

std::vector<std::string_view> fluents_of(const std::vector<NumericChange>& changes, bool additive_too) {
  std::vector<std::string_view> fluents;
  for (const NumericChange& change : changes)
    if (additive_too || !is_additive(change.op)) fluents.push_back(change.fluent);
  return fluents;
}

// Returns what `writer` does to `other`; asking again with the roles exchanged finds the rest.
std::optional<std::string> disturbs(const Footprint& writer, const Footprint& other) {
  const Names deleted(writer.changes.deleted);
  if (const auto fact = first_common(deleted, other.reads.facts)) return fact;
  if (const auto fact = first_common(deleted, other.changes.added)) return fact;
  const Names added(writer.changes.added);
  if (const auto fact = first_common(added, other.reads.facts)) return fact;
  if (writer.changes.numeric.empty()) return {};
  const Names set(fluents_of(writer.changes.numeric, true));
  const Names set_otherwise(fluents_of(writer.changes.numeric, false));  // than by increase and decrease
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
