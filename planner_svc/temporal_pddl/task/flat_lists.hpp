// FlatLists keeps many short lists in two vectors, without an allocation and a pointer per list (compressed
// rows).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roci::planner::temporal_pddl::task {

/// Holds lists that are appended in order and never change. T is a plain value.
template <typename T>
class FlatLists {
 public:
  /// Appends one list; its index is the number of lists before it.
  void push_back(std::span<const T> list) {
    items_.insert(items_.end(), list.begin(), list.end());
    begins_.push_back(static_cast<std::uint32_t>(items_.size()));
  }

  /// Makes room for so many lists in all.
  void reserve(std::size_t lists) { begins_.reserve(lists + 1); }
  /// Gives back what room is left.
  void shrink() {
    items_.shrink_to_fit();
    begins_.shrink_to_fit();
  }

  std::span<const T> operator[](std::size_t list) const {
    return {items_.data() + begins_[list], items_.data() + begins_[list + 1]};
  }
  template <typename IdType>
  std::span<const T> operator[](IdType list) const requires requires {
    list.index();
  }
  { return (*this)[list.index()]; }

  std::size_t size() const { return begins_.size() - 1; }
  std::size_t bytes() const {
    return items_.capacity() * sizeof(T) + begins_.capacity() * sizeof(std::uint32_t);
  }

 private:
  std::vector<T> items_;
  std::vector<std::uint32_t> begins_{0};  // and the end of the last
};

}  // namespace roci::planner::temporal_pddl::task
