#include "tests/fuzz/topics/allocation_meter.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace roci::fuzz {
namespace {

thread_local long long held = 0;
thread_local long long most = 0;

void* take(std::size_t size) {
  void* block = std::malloc(size == 0 ? 1 : size);
  if (block == nullptr) throw std::bad_alloc();
  held += static_cast<long long>(malloc_usable_size(block));
  most = std::max(most, held);
  return block;
}

void give_back(void* block) {
  if (block == nullptr) return;
  held -= static_cast<long long>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

AllocationMeter::AllocationMeter() { held = most = 0; }
std::size_t AllocationMeter::peak() const { return static_cast<std::size_t>(most); }

}  // namespace roci::fuzz

void* operator new(std::size_t size) { return roci::fuzz::take(size); }
void* operator new[](std::size_t size) { return roci::fuzz::take(size); }
void operator delete(void* block) noexcept { roci::fuzz::give_back(block); }
void operator delete[](void* block) noexcept { roci::fuzz::give_back(block); }
void operator delete(void* block, std::size_t) noexcept { roci::fuzz::give_back(block); }
void operator delete[](void* block, std::size_t) noexcept { roci::fuzz::give_back(block); }
