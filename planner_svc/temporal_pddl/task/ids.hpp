// Ids are strong integers: each kind of thing has an index type of its own, which indexes vectors and nothing
// else.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace roci::planner::temporal_pddl::task {

/// Numbers things of one kind only; one that is made without a value stands for none.
template <typename Tag>
struct Id {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}

  constexpr bool is_none() const { return value == kNone; }
  constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;
};

using ObjectId = Id<struct ObjectTag>;
using PredicateId = Id<struct PredicateTag>;
using FunctionId = Id<struct FunctionTag>;      // fluents and external functions
using FactId = Id<struct FactTag>;              // a ground atom or the negation of one
using NumberId = Id<struct NumberTag>;          // a numeric state variable
using ExpressionId = Id<struct ExpressionTag>;  // an interned linear expression
using SchemaId = Id<struct SchemaTag>;          // an action of the domain
using ActionId = Id<struct ActionTag>;          // a ground action
using SnapId = Id<struct SnapTag>;              // a start, end, instantaneous action or timed literal

/// Holds a vector that only the right kind of id can index.
template <typename IdType, typename T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T()) : items_(size, value) {}

  auto operator[](IdType id) -> decltype(auto) { return items_[id.index()]; }
  auto operator[](IdType id) const -> decltype(auto) { return items_[id.index()]; }
  IdType push_back(T value) {
    items_.push_back(std::move(value));
    return IdType(items_.size() - 1);
  }
  void reserve(std::size_t size) { items_.reserve(size); }
  void resize(std::size_t size, const T& value = T()) { items_.resize(size, value); }
  void assign(std::size_t size, const T& value) { items_.assign(size, value); }
  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  /// Returns the allocated bytes, without what the items own.
  std::size_t bytes() const { return items_.capacity() * sizeof(T) / (std::is_same_v<T, bool> ? 8 : 1); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }
  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }

 private:
  std::vector<T> items_;
};

}  // namespace roci::planner::temporal_pddl::task
