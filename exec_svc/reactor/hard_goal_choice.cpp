#include "exec_svc/reactor/hard_goal_choice.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::reactor {

using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalSet;
using temporal::RankVector;

namespace {

constexpr std::size_t kSetsOfOneSize = 10'000;

using Records = std::vector<const GoalRecord*>;

/// Returns how many sets of `size` there are of `count` things, or more than kSetsOfOneSize.
std::size_t number_of_sets(std::size_t count, std::size_t size) {
  std::size_t out = 1;
  for (std::size_t i = 0; i < std::min(size, count - size) && out <= kSetsOfOneSize; ++i)
    out = out * (count - i) / (i + 1);
  return out;
}

struct WeighedSet {
  RankVector utility;
  Records goals;  ///< as they leave
};

bool goes_before(const GoalRecord* one, const GoalRecord* other) { return goals::leaves_first(*one, *other); }

bool leaves_before(const WeighedSet& a, const WeighedSet& b) {
  if (a.utility < b.utility) return true;
  if (b.utility < a.utility) return false;
  return std::ranges::lexicographical_compare(a.goals, b.goals, goes_before);
}

/// Every set of `size` of these, which stand as they leave.
std::vector<WeighedSet> sets_of(const Records& leaving, std::size_t size) {
  std::vector<WeighedSet> out;
  std::vector<bool> chosen(leaving.size(), false);
  std::fill_n(chosen.begin(), size, true);
  do {
    WeighedSet set;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (!chosen[i]) continue;
      set.utility += leaving[i]->request.utility;
      set.goals.push_back(leaving[i]);
    }
    out.push_back(std::move(set));
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  std::ranges::sort(out, leaves_before);
  return out;
}

std::vector<GoalKey> keys_of(const Records& records) {
  std::vector<GoalKey> out;
  for (const GoalRecord* record : records) out.push_back(record->request.key);
  return out;
}

}  // namespace

std::vector<std::vector<GoalKey>> leaving_sets(const GoalSet& goals, const std::vector<GoalKey>& among,
                                               std::size_t most) {
  Records leaving;
  for (const GoalKey& key : among) leaving.push_back(goals.find(key));
  std::ranges::sort(leaving, goes_before);
  std::vector<std::vector<GoalKey>> out;
  for (std::size_t size = 1; size < leaving.size() && out.size() < most; ++size) {
    if (number_of_sets(leaving.size(), size) > kSetsOfOneSize) break;
    for (const WeighedSet& set : sets_of(leaving, size)) {
      if (out.size() == most) break;
      out.push_back(keys_of(set.goals));
    }
  }
  return out;
}

std::vector<GoalKey> next_trial(const GoalSet& goals, const std::vector<GoalKey>& among, std::uint32_t made,
                                std::uint32_t most) {
  if (made >= most) return {};
  const auto sets = leaving_sets(goals, among, made + std::size_t{1});
  return sets.size() > made ? sets[made] : std::vector<GoalKey>{};
}

std::string with_what_it_saves(const std::string& reason) {
  const std::size_t first_line = std::min(reason.find('\n'), reason.size());
  return reason.substr(0, first_line) + "; with what leaves gone, the other hard goals have a plan" +
         reason.substr(first_line);
}

}  // namespace roci::exec::reactor
