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

std::optional<Verdict> verdict_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return static_cast<Verdict>(i);
  return std::nullopt;
}

}  // namespace roci::temporal
