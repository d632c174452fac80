#include "planner_svc/timeline_htn/reading/names.hpp"

#include "core/words/nearest_word.hpp"
#include "planner_svc/timeline_htn/reading/line.hpp"

namespace roci::planner::timeline_htn::reading {

namespace {

constexpr std::size_t kFew = 12;

std::string with_article(const std::string& kind) {
  return (kind.find_first_of("aeiou") == 0 ? "an " : "a ") + kind;
}

}  // namespace

std::string known_or_declare(const std::vector<std::string>& known) {
  if (known.empty() || known.size() > kFew) return "declare it";
  std::string out;
  for (const std::string& one : known) out += (out.empty() ? "known: " : ", ") + one;
  return out;
}

void Names::add(const std::string& name, const mission::Entry& place) {
  if (!is_name(name))
    place.fail("'" + name.substr(0, 60) + "' is no name of " + with_article(kind_) +
               "; use letters, digits, '_' and '-' within, with a letter or '_' at the front");
  const auto [entry, added] =
      known_.emplace(name, Known{static_cast<model::Index>(known_.size()), place.place()});
  if (!added)
    place.fail("there is " + with_article(kind_) + " '" + name + "' already, at " + entry->second.place +
               "; rename one");
}

std::optional<model::Index> Names::find(std::string_view name) const {
  const auto found = known_.find(name);
  return found == known_.end() ? std::nullopt : std::optional(found->second.index);
}

model::Index Names::index(std::string_view name, const mission::Entry& place) const {
  if (const auto found = find(name)) return *found;
  std::vector<std::string> all;
  for (const auto& [known, entry] : known_) all.push_back(known);
  place.fail("unknown " + kind_ + " '" + std::string(name.substr(0, 60)) + "'; " +
             words::nearest(name, all).remedy(known_or_declare(all)));
}

}  // namespace roci::planner::timeline_htn::reading
