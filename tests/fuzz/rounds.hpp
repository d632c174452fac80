// How long fuzzing goes on.
#pragma once

#include <cstdlib>

namespace roci::fuzz {

// `usual` rounds, or ROCI_FUZZ_TIMES as many.
inline int rounds(int usual) {
  const char* times = std::getenv("ROCI_FUZZ_TIMES");
  return times == nullptr ? usual : usual * std::atoi(times);
}

}  // namespace roci::fuzz
