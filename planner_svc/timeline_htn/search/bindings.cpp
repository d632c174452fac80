#include "planner_svc/timeline_htn/search/bindings.hpp"

#include <utility>

namespace roci::planner::timeline_htn::search {

using model::Behaviour;

std::vector<Index> admissible(const Ground& ground, const Behaviour& behaviour, Index variable,
                              std::vector<Index> objects) {
  std::vector<Index> out;
  objects[variable] = kNone;
  for (const auto& bound : ground.bindings(behaviour.variables, std::move(objects), behaviour.where))
    out.push_back(bound[variable]);
  return out;
}

Index Bindings::number(const std::vector<Index>& objects) {
  const auto [entry, added] = numbers_.emplace(objects, static_cast<Index>(all_.size()));
  if (added) {
    all_.push_back(objects);
    bytes_ += 120 + 8 * objects.size();
  }
  return entry->second;
}

}  // namespace roci::planner::timeline_htn::search
