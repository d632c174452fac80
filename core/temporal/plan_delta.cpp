#include "core/temporal/plan_delta.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace roci::temporal {
namespace {

const std::string& key_of(const PlanActivity& activity) { return activity.id; }
const std::string& key_of(const DecisionPoint& decision) { return decision.id; }
std::pair<TimePoint, TimePoint> key_of(const Token& token) { return {token.start_point, token.end_point}; }
std::pair<TimePoint, TimePoint> key_of(const TemporalConstraint& constraint) {
  return {constraint.from_point, constraint.to_point};
}

// Finds, among items with an id, what of `to` is new or changed, and the ids that are gone.
template <class Item>
void difference_by_id(const std::vector<Item>& from, const std::vector<Item>& to, std::vector<Item>& added,
                      std::vector<std::string>& removed) {
  std::unordered_map<std::string, const Item*> left;
  for (const Item& item : from) left.emplace(key_of(item), &item);
  for (const Item& item : to) {
    const auto before = left.extract(key_of(item));
    if (before.empty() || !(*before.mapped() == item)) added.push_back(item);
  }
  for (const Item& item : from)
    if (left.contains(key_of(item))) removed.push_back(key_of(item));
}

// Holds the places of equal items in a list, each to be taken once.
template <class Item>
class Places {
 public:
  explicit Places(const std::vector<Item>& items) : items_(items) {
    for (std::size_t i = 0; i < items.size(); ++i) places_.emplace(key_of(items[i]), i);
  }
  std::optional<std::size_t> take(const Item& item) {
    const auto [begin, end] = places_.equal_range(key_of(item));
    const auto found =
        std::find_if(begin, end, [&](const auto& place) { return items_[place.second] == item; });
    if (found == end) return std::nullopt;
    return places_.extract(found).mapped();
  }
  bool left(std::size_t place) const {
    const auto [begin, end] = places_.equal_range(key_of(items_[place]));
    return std::any_of(begin, end, [&](const auto& other) { return other.second == place; });
  }

 private:
  const std::vector<Item>& items_;
  std::multimap<std::pair<TimePoint, TimePoint>, std::size_t> places_;
};

template <class Item>
void difference_by_value(const std::vector<Item>& from, const std::vector<Item>& to, std::vector<Item>& added,
                         std::vector<Item>& removed) {
  Places<Item> places(from);
  for (const Item& item : to)
    if (!places.take(item)) added.push_back(item);
  for (std::size_t i = 0; i < from.size(); ++i)
    if (places.left(i)) removed.push_back(from[i]);
}

// Returns false if something to be removed is not there.
template <class Item>
bool apply_by_id(const std::vector<Item>& added, const std::vector<std::string>& removed,
                 std::vector<Item>& items) {
  std::unordered_map<std::string, const Item*> fresh;
  for (const Item& item : added) fresh.emplace(key_of(item), &item);
  std::unordered_map<std::string, bool> gone;
  for (const std::string& id : removed) gone.emplace(id, false);
  std::vector<Item> out;
  for (Item& item : items) {
    if (const auto found = gone.find(key_of(item)); found != gone.end()) {
      found->second = true;
    } else {
      const auto changed = fresh.extract(key_of(item));
      out.push_back(changed.empty() ? std::move(item) : *changed.mapped());
    }
  }
  for (const Item& item : added)
    if (fresh.contains(key_of(item))) out.push_back(item);
  items = std::move(out);
  return std::ranges::all_of(gone, [](const auto& entry) { return entry.second; });
}

template <class Item>
bool apply_by_value(const std::vector<Item>& added, const std::vector<Item>& removed,
                    std::vector<Item>& items) {
  Places<Item> places(items);
  for (const Item& item : removed)
    if (!places.take(item)) return false;
  std::vector<Item> out;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (places.left(i)) out.push_back(items[i]);
  out.insert(out.end(), added.begin(), added.end());
  items = std::move(out);
  return true;
}

void take_head(const FlexiblePlan& from, FlexiblePlan& to) {
  to.id = from.id;
  to.version = from.version;
  to.engine = from.engine;
  to.origin = from.origin;
  to.point_count = from.point_count;
  to.function_values = from.function_values;
}

}  // namespace

PlanDelta difference(const FlexiblePlan& from, const FlexiblePlan& to) {
  PlanDelta delta;
  delta.from_version = from.version;
  take_head(to, delta.added);
  difference_by_id(from.activities, to.activities, delta.added.activities, delta.removed_activities);
  difference_by_id(from.decisions, to.decisions, delta.added.decisions, delta.removed_decisions);
  difference_by_value(from.tokens, to.tokens, delta.added.tokens, delta.removed_tokens);
  difference_by_value(from.constraints, to.constraints, delta.added.constraints, delta.removed_constraints);
  return delta;
}

std::string apply(const PlanDelta& delta, FlexiblePlan& plan) {
  if (delta.from_version == 0) {
    plan = delta.added;
    return "";
  }
  if (delta.from_version != plan.version)
    return "it changes version " + std::to_string(delta.from_version) + ", the plan is of version " +
           std::to_string(plan.version);
  FlexiblePlan next = plan;
  take_head(delta.added, next);
  if (!apply_by_id(delta.added.activities, delta.removed_activities, next.activities))
    return "it removes an activity that the plan has not";
  if (!apply_by_id(delta.added.decisions, delta.removed_decisions, next.decisions))
    return "it removes a decision that the plan has not";
  if (!apply_by_value(delta.added.tokens, delta.removed_tokens, next.tokens))
    return "it removes a token that the plan has not";
  if (!apply_by_value(delta.added.constraints, delta.removed_constraints, next.constraints))
    return "it removes a constraint that the plan has not";
  plan = std::move(next);
  return "";
}

}  // namespace roci::temporal
