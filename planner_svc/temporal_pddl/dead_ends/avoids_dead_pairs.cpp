#include "planner_svc/temporal_pddl/dead_ends/avoids_dead_pairs.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl {

namespace {

constexpr std::size_t kMaxWork = 50'000'000;  // words of bits, for one table: about 50 ms
constexpr std::size_t kMemoryShare = 8;       // of the limit, for one table
constexpr std::size_t kMaxBytes = 16 << 20;   // likewise, whatever the limit
constexpr std::size_t kRowsPerStep = 6;       // looked at when a step is, at least

}  // namespace

void AvoidsDeadPairs::evaluate(const Situation& situation, Estimate& estimate) {
  if (patience_ > 0) --patience_;
  heuristic_.evaluate(situation, estimate);
}

bool AvoidsDeadPairs::hopeless(StateView state, std::span<const ActionId> running, ActionSteps steps) {
  if (heuristic_.hopeless(state, running, steps)) return true;
  if (patience_ > 0) return false;
  Table& table = tables_[static_cast<std::size_t>(steps)];
  if (!std::exchange(table.tried, true)) {
    if (auto found = find(steps)) table.pairs.emplace(std::move(*found));
  }
  return table.pairs && table.pairs->in(state, running);
}

std::optional<DeadPairs> AvoidsDeadPairs::find(ActionSteps style) {
  const std::size_t literals = ValueSteps::literals(task_, style);
  const std::size_t most = std::min(kMaxBytes, watch_.memory_limit() / kMemoryShare);
  if (PairMatrix::bytes(literals) > most) return std::nullopt;
  if (task_.actions.size() * kRowsPerStep > kMaxWork / (literals / 64 + 1)) return std::nullopt;
  ValueSteps steps(task_, style, [&] { watch_.step(); });
  const std::size_t bytes = steps.bytes() + DeadPairs::most_bytes(steps);
  if (bytes > most) return std::nullopt;
  watch_.memory_on_top(bytes);
  std::size_t done = 0;
  return DeadPairs::find(task_, std::move(steps), [&](std::size_t work) {
    watch_.step();
    done += work;
    return done <= kMaxWork;
  });
}

std::size_t AvoidsDeadPairs::bytes() const {
  std::size_t result = heuristic_.bytes();
  for (const Table& table : tables_) result += table.pairs ? table.pairs->bytes() : 0;
  return result;
}

}  // namespace roci::planner::temporal_pddl
