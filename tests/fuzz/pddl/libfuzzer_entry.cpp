// For coverage-guided fuzzing with clang: fuzz_pddl_guided tests/fuzz/pddl/corpus
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/pddl/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  roci::fuzz::run_all({reinterpret_cast<const char*>(data), size});
  return 0;
}
