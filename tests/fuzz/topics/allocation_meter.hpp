// Counts what a piece of code takes from the heap, for test programs that link allocation_meter.cpp.
#pragma once

#include <cstddef>

namespace roci::fuzz {

/// From its making on: how many bytes this thread had at most at one time, beyond what it had before.
class AllocationMeter {
 public:
  AllocationMeter();
  std::size_t peak() const;
};

}  // namespace roci::fuzz
