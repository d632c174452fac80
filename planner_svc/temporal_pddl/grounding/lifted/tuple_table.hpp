// A tuple table interns (symbol, objects…): each distinct tuple stands in it once, numbered from 0 in the
// order of its first appearance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Numbers tuples; a number stays what it is as the table grows.
class TupleTable {
 public:
  std::uint32_t intern(std::uint32_t symbol, std::span<const task::ObjectId> objects);
  std::optional<std::uint32_t> find(std::uint32_t symbol, std::span<const task::ObjectId> objects) const;

  std::uint32_t symbol(std::uint32_t tuple) const { return symbols_[tuple]; }
  std::span<const task::ObjectId> objects(std::uint32_t tuple) const { return objects_[std::size_t{tuple}]; }
  std::size_t size() const { return symbols_.size(); }
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kFree = 0xffffffff;

  std::size_t slot_of(std::uint32_t symbol, std::span<const task::ObjectId> objects) const;
  void grow();

  std::vector<std::uint32_t> symbols_;
  task::FlatLists<task::ObjectId> objects_;
  std::vector<std::uint32_t> slots_ =
      std::vector<std::uint32_t>(16, kFree);  // open addressing, a power of two
};

}  // namespace roci::planner::temporal_pddl::grounding::lifted
