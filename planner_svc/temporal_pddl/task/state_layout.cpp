#include "planner_svc/temporal_pddl/task/state_layout.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace roci::planner::temporal_pddl::task {

namespace {

constexpr std::uint32_t kWordBits = 64;

std::uint32_t bits_needed(std::size_t facts) { return static_cast<std::uint32_t>(std::bit_width(facts)); }

}  // namespace

// The widest variables come first, each in the first word with room for it.
StateLayout::StateLayout(std::vector<std::vector<FactId>> variables,
                         const IdVector<FactId, FactId>& negation_of, std::size_t numbers)
    : places_(negation_of.size()), numbers_(numbers) {
  std::stable_sort(variables.begin(), variables.end(), [](const auto& a, const auto& b) {
    return bits_needed(a.size()) > bits_needed(b.size());
  });
  std::vector<std::uint32_t> used;  // bits of each word
  std::size_t first_open = 0;       // words before are full
  for (auto& facts : variables) {
    const std::uint32_t bits = bits_needed(facts.size());
    std::size_t word = first_open;
    while (word < used.size() && used[word] + bits > kWordBits) ++word;
    if (word == used.size()) used.push_back(0);
    Variable variable{std::move(facts), static_cast<std::uint32_t>(word), used[word], (Word{1} << bits) - 1};
    used[word] += bits;
    packed_bits_ += bits;
    while (first_open < used.size() && used[first_open] == kWordBits) ++first_open;
    for (std::size_t i = 0; i < variable.facts.size(); ++i) {
      places_[variable.facts[i]] = Place{variable.word,
                                         static_cast<std::uint8_t>(variable.shift),
                                         false,
                                         static_cast<std::uint32_t>(i + 1),
                                         static_cast<std::uint32_t>(variables_.size()),
                                         variable.mask};
    }
    variables_.push_back(std::move(variable));
  }
  for (std::size_t i = 0; i < negation_of.size(); ++i) {
    const FactId fact(i);
    if (negation_of[fact].is_none()) continue;
    places_[fact] = places_[negation_of[fact]];
    places_[fact].negated = true;
    negations_.push_back(fact);
  }
  number_offset_ = used.size();
}

void StateLayout::add(MutableState state, FactId fact) const {
  const Place& place = places_[fact];
  if (place.negated) return;
  Word& word = state[place.word];
  word = (word & ~(place.mask << place.shift)) | (Word{place.value} << place.shift);
}

void StateLayout::remove(MutableState state, FactId fact) const {
  const Place& place = places_[fact];
  if (place.negated || ((state[place.word] >> place.shift) & place.mask) != place.value) return;
  state[place.word] &= ~(place.mask << place.shift);
}

}  // namespace roci::planner::temporal_pddl::task
