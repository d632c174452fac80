// Lists for tables of very many things that have a few ids each: hardly more than their items, and mostly no
// allocation.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>
#include <type_traits>
#include <utility>

namespace roci::planner::temporal_pddl::task {

/// Has what a std::vector of plain values has, as far as it is asked for. `List` has data(), size(), set_size(), which
/// leaves new items unset, and reserve(). All that changes the size makes iterators void.
template <typename List, typename T>
class ListInterface {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  T* begin() { return self().data(); }
  T* end() { return self().data() + self().size(); }
  const T* begin() const { return self().data(); }
  const T* end() const { return self().data() + self().size(); }
  bool empty() const { return self().size() == 0; }
  T& operator[](std::size_t i) { return self().data()[i]; }
  const T& operator[](std::size_t i) const { return self().data()[i]; }
  T& front() { return *begin(); }
  const T& front() const { return *begin(); }
  T& back() { return *(end() - 1); }
  const T& back() const { return *(end() - 1); }

  void clear() { self().set_size(0); }
  void push_back(const T& value) {
    const T item = value;  // which may stand in this list
    const std::size_t size = self().size();
    make_room(size + 1);
    self().set_size(size + 1);
    self().data()[size] = item;
  }
  template <typename Iterator>
  void assign(Iterator from, Iterator to) {
    const auto size = static_cast<std::size_t>(std::distance(from, to));
    self().reserve(size);
    self().set_size(size);
    std::copy(from, to, begin());
  }
  T* insert(const T* where, const T& value) {
    const T item = value;
    return insert(where, &item, &item + 1);
  }
  /// Inserts items of another list.
  template <typename Iterator>
  T* insert(const T* where, Iterator from, Iterator to) {
    const std::ptrdiff_t place = where - begin();
    const std::size_t before = self().size(), more = static_cast<std::size_t>(std::distance(from, to));
    make_room(before + more);
    self().set_size(before + more);
    std::move_backward(begin() + place, begin() + before, end());
    std::copy(from, to, begin() + place);
    return begin() + place;
  }
  T* erase(const T* from, const T* to) {
    T* const place = begin() + (from - begin());
    T* const last = std::move(begin() + (to - begin()), end(), place);
    self().set_size(static_cast<std::size_t>(last - begin()));
    return place;
  }

  friend bool operator==(const List& a, const List& b) { return std::ranges::equal(a, b); }
  friend auto operator<=>(const List& a, const List& b) {
    return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  List& self() { return static_cast<List&>(*this); }
  const List& self() const { return static_cast<const List&>(*this); }
  void make_room(std::size_t size) {
    if (size > self().capacity()) self().reserve(std::max(size, 2 * self().capacity()));
  }
};

/// Erases the items that satisfy the predicate, as std::erase_if does.
template <typename List, typename T, typename Predicate>
void erase_if(ListInterface<List, T>& list, Predicate predicate) {
  list.erase(std::remove_if(list.begin(), list.end(), predicate), list.end());
}

/// Keeps up to `Few` items in itself and more of them in a block on the heap; it has 4 bytes beside its items, and at
/// least 16 in all.
template <typename T, std::size_t Few = 12 / sizeof(T)>
class ShortList : public ListInterface<ShortList<T, Few>, T> {
  static_assert(alignof(T) <= alignof(std::uint32_t));

 public:
  ShortList() = default;
  ShortList(std::initializer_list<T> items) { this->assign(items.begin(), items.end()); }
  template <typename Iterator>
  ShortList(Iterator from, Iterator to) {
    this->assign(from, to);
  }
  ShortList(const ShortList& other) : ListInterface<ShortList, T>() {
    this->assign(other.begin(), other.end());
  }
  ShortList(ShortList&& other) noexcept
      : ListInterface<ShortList, T>(), room_(other.room_), size_(std::exchange(other.size_, 0)) {}
  ShortList& operator=(const ShortList& other) {
    if (this != &other) this->assign(other.begin(), other.end());
    return *this;
  }
  ShortList& operator=(ShortList&& other) noexcept {
    std::swap(room_, other.room_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~ShortList() {
    if (on_heap()) ::operator delete(block());
  }

  std::size_t size() const { return size_ & ~kOnHeap; }
  std::size_t capacity() const { return on_heap() ? *static_cast<const std::uint32_t*>(block()) : Few; }
  T* data() { return const_cast<T*>(std::as_const(*this).data()); }
  const T* data() const {
    return reinterpret_cast<const T*>(on_heap() ? static_cast<const std::byte*>(block()) + kHeader
                                                : room_.data());
  }
  void set_size(std::size_t size) { size_ = static_cast<std::uint32_t>(size) | (size_ & kOnHeap); }
  void reserve(std::size_t capacity) {
    if (capacity <= this->capacity()) return;
    void* const bigger = ::operator new(kHeader + capacity * sizeof(T));
    *static_cast<std::uint32_t*>(bigger) = static_cast<std::uint32_t>(capacity);
    std::memcpy(static_cast<std::byte*>(bigger) + kHeader, data(), size() * sizeof(T));
    if (on_heap()) ::operator delete(block());
    std::memcpy(room_.data(), &bigger, sizeof bigger);
    size_ |= kOnHeap;
  }
  /// Returns the allocated bytes.
  std::size_t heap_bytes() const { return on_heap() ? kHeader + capacity() * sizeof(T) : 0; }

 private:
  static constexpr std::uint32_t kOnHeap = 1u << 31;
  static constexpr std::size_t kHeader = sizeof(std::uint32_t);  // the capacity
  static constexpr std::size_t kRoom = std::max<std::size_t>(12, Few * sizeof(T));

  bool on_heap() const { return (size_ & kOnHeap) != 0; }
  void* block() const {
    void* block;
    std::memcpy(&block, room_.data(), sizeof block);
    return block;
  }

  alignas(std::uint32_t) std::array<std::byte, kRoom> room_{};  // of the items, or the address of the block
  std::uint32_t size_ = 0;
};

/// Holds a list that is mostly empty, and is then as large as a pointer.
template <typename T>
class RareList : public ListInterface<RareList<T>, T> {
  static_assert(alignof(T) <= alignof(std::uint64_t));

 public:
  RareList() = default;
  RareList(std::initializer_list<T> items) { this->assign(items.begin(), items.end()); }
  RareList(const RareList& other) : ListInterface<RareList, T>() { this->assign(other.begin(), other.end()); }
  RareList(RareList&& other) noexcept
      : ListInterface<RareList, T>(), block_(std::exchange(other.block_, nullptr)) {}
  RareList& operator=(const RareList& other) {
    if (this != &other) this->assign(other.begin(), other.end());
    return *this;
  }
  RareList& operator=(RareList&& other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~RareList() { ::operator delete(block_); }

  std::size_t size() const { return block_ ? block_->size : 0; }
  std::size_t capacity() const { return block_ ? block_->capacity : 0; }
  T* data() { return const_cast<T*>(std::as_const(*this).data()); }
  const T* data() const { return reinterpret_cast<const T*>(block_ ? block_ + 1 : nullptr); }
  void set_size(std::size_t size) {
    if (block_) block_->size = static_cast<std::uint32_t>(size);
  }
  void reserve(std::size_t capacity) {
    if (capacity <= this->capacity()) return;
    auto* const bigger = static_cast<Block*>(::operator new(sizeof(Block) + capacity * sizeof(T)));
    bigger->capacity = static_cast<std::uint32_t>(capacity);
    bigger->size = static_cast<std::uint32_t>(size());
    if (!this->empty()) std::memcpy(static_cast<void*>(bigger + 1), data(), size() * sizeof(T));
    ::operator delete(block_);
    block_ = bigger;
  }
  /// Returns the allocated bytes.
  std::size_t heap_bytes() const { return block_ ? sizeof(Block) + capacity() * sizeof(T) : 0; }

 private:
  struct Block {  // the items stand behind it
    std::uint32_t size, capacity;
  };

  Block* block_ = nullptr;
};

}  // namespace roci::planner::temporal_pddl::task
