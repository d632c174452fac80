// The tuples of one external function, by the numbers of their objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::values {

/// Takes four bytes for each argument of a tuple, where a call takes hundreds: a function of two slots of a satellite
/// has tens of thousands of tuples.
class TupleSet {
 public:
  TupleSet() = default;  ///< has no tuples
  /// The calls differ in their arguments alone, and there is at least one.
  explicit TupleSet(std::span<const engine::FunctionCall> calls);

  std::size_t size() const { return by_arguments_.size(); }
  bool empty() const { return by_arguments_.empty(); }
  /// Returns the place of the call with these arguments among those that it was made of, the first if there are
  /// several.
  std::optional<std::size_t> find(const std::vector<std::string>& arguments) const;
  bool is_at(std::size_t index, const std::vector<std::string>& arguments) const;
  engine::FunctionCall call(std::size_t index) const;

 private:
  using Object = std::uint32_t;

  std::span<const Object> tuple(std::size_t index) const;

  engine::FunctionCall without_arguments_;
  std::size_t arity_ = 0;
  std::vector<std::string> objects_;         // sorted
  std::vector<Object> tuples_;               // one after the other
  std::vector<std::uint32_t> by_arguments_;  // indices, sorted by the arguments there
};

}  // namespace roci::planner::temporal_pddl::values
