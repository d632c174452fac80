#include "planner_svc/temporal_pddl/search/pair_novelty.hpp"

#include <algorithm>
#include <bit>

#include "planner_svc/temporal_pddl/search/hash_mix.hpp"

namespace roci::planner::temporal_pddl::search {

namespace {

constexpr std::size_t kFewestWords = std::size_t{1} << 10;
constexpr std::size_t kMostWords = std::size_t{1} << 20;

}  // namespace

// Reserves about 32 bits for each pair, so that there is room for as many kinds.
PairNovelty::PairNovelty(std::size_t facts)
    : bits_(std::bit_ceil(std::clamp(facts * facts / 4, kFewestWords, kMostWords))) {}

bool PairNovelty::note(std::uint64_t place) {
  std::uint64_t& word = bits_[(place >> 6) & (bits_.size() - 1)];
  const std::uint64_t bit = std::uint64_t{1} << (place & 63);
  const bool fresh = (word & bit) == 0;
  word |= bit;
  return fresh;
}

// The pairs of a fact lie next to each other, as those of a state are mostly looked at together.
int PairNovelty::see(std::span<const std::uint32_t> facts, std::span<const std::uint32_t> fresh,
                     std::uint64_t kind) {
  bool fact_is_new = false, pair_is_new = false;
  const std::uint64_t base = mix(kind + 1);
  const bool all = fresh.size() == facts.size();
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const std::uint32_t a = fresh[i];
    const std::uint64_t row = mix(base ^ a);
    if (note(row ^ a)) fact_is_new = true;
    for (const std::uint32_t b : all ? facts.subspan(i + 1) : facts) {
      if (a != b && note(a < b ? row ^ b : mix(base ^ b) ^ a)) pair_is_new = true;
    }
  }
  return fact_is_new ? 1 : pair_is_new ? 2 : kNothingNew;
}

}  // namespace roci::planner::temporal_pddl::search
