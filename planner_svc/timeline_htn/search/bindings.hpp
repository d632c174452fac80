// Bindings are the objects that variables of behaviours stand for, kept once each.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "planner_svc/timeline_htn/search/ground.hpp"

namespace roci::planner::timeline_htn::search {

/// Holds interned bindings of variables to objects.
class Bindings {
 public:
  Index number(const std::vector<Index>& objects);
  const std::vector<Index>& at(Index number) const { return all_[number]; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::vector<std::vector<Index>> all_;
  std::map<std::vector<Index>, Index> numbers_;
  std::size_t bytes_ = 0;
};

/// Returns the objects that a variable of a behaviour may stand for where the others stand for these.
std::vector<Index> admissible(const Ground& ground, const model::Behaviour& behaviour, Index variable,
                              std::vector<Index> objects);

}  // namespace roci::planner::timeline_htn::search
