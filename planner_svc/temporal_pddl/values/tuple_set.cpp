#include "planner_svc/temporal_pddl/values/tuple_set.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace roci::planner::temporal_pddl::values {

using engine::FunctionCall;

TupleSet::TupleSet(std::span<const FunctionCall> calls)
    : without_arguments_(calls.front()), arity_(calls.front().arguments.size()) {
  without_arguments_.arguments.clear();
  std::set<std::string> objects;
  for (const FunctionCall& call : calls) objects.insert(call.arguments.begin(), call.arguments.end());
  objects_.assign(objects.begin(), objects.end());
  tuples_.reserve(calls.size() * arity_);
  for (const FunctionCall& call : calls)
    for (const std::string& argument : call.arguments)
      tuples_.push_back(static_cast<Object>(std::ranges::lower_bound(objects_, argument) - objects_.begin()));
  by_arguments_.resize(calls.size());
  std::iota(by_arguments_.begin(), by_arguments_.end(), std::uint32_t{0});
  std::ranges::stable_sort(by_arguments_, [this](std::uint32_t one, std::uint32_t other) {
    return std::ranges::lexicographical_compare(tuple(one), tuple(other));
  });
}

std::span<const TupleSet::Object> TupleSet::tuple(std::size_t index) const {
  return std::span(tuples_).subspan(index * arity_, arity_);
}

std::optional<std::size_t> TupleSet::find(const std::vector<std::string>& arguments) const {
  const auto name = [this](Object object) -> const std::string& { return objects_[object]; };
  const auto place = std::ranges::partition_point(by_arguments_, [&](std::uint32_t index) {
    return std::ranges::lexicographical_compare(tuple(index), arguments, {}, name);
  });
  if (place == by_arguments_.end() || !is_at(*place, arguments)) return std::nullopt;
  return *place;
}

bool TupleSet::is_at(std::size_t index, const std::vector<std::string>& arguments) const {
  const auto name = [this](Object object) -> const std::string& { return objects_[object]; };
  return index < size() && std::ranges::equal(tuple(index), arguments, {}, name);
}

FunctionCall TupleSet::call(std::size_t index) const {
  FunctionCall out = without_arguments_;
  out.arguments.reserve(arity_);
  for (const Object object : tuple(index)) out.arguments.push_back(objects_[object]);
  return out;
}

}  // namespace roci::planner::temporal_pddl::values
