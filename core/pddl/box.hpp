// A Box holds a value of a type that may still be incomplete: so a syntax tree can hold itself and stay a
// plain value.
#pragma once

#include <memory>
#include <utility>

namespace roci::pddl {

/// Owns one T on the heap and copies it deeply. It is never empty, except after it was moved from.
template <typename T>
class Box {
 public:
  Box() : value_(std::make_unique<T>()) {}
  Box(T value) : value_(std::make_unique<T>(std::move(value))) {}  // NOLINT: implicit, as a plain member is
  Box(const Box& other) : value_(std::make_unique<T>(*other)) {}
  Box(Box&&) noexcept = default;
  Box& operator=(const Box& other) {
    Box copy(other);
    return *this = std::move(copy);
  }
  Box& operator=(Box&&) noexcept = default;
  ~Box() = default;

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace roci::pddl
