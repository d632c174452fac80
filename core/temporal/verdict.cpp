#include "core/temporal/verdict.hpp"

#include <array>

namespace roci::temporal {
namespace {

constexpr std::array kNames{
    "solved",    "unsolvable",    "timeout", "out_of_memory", "unsupported", "function_unavailable",
    "cancelled", "invalid_input", "crashed", "no_reply"};

}  // namespace

const char* to_string(Verdict verdict) {
  const auto index = static_cast<std::size_t>(verdict);
  return index < kNames.size() ? kNames[index] : "unknown";
}

bool speaks_of_goals(Verdict verdict) {
  return verdict == Verdict::unsolvable || verdict == Verdict::timeout || verdict == Verdict::out_of_memory;
}

}  // namespace roci::temporal
