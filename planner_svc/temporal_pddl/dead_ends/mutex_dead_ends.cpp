#include "planner_svc/temporal_pddl/dead_ends/mutex_dead_ends.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl::dead_ends {

using task::ActionCompression;
using task::ActionId;
using task::StateView;

namespace {

constexpr std::size_t kMaxTableWork = 50'000'000;  // words of bits, for one table: about 50 ms
constexpr std::size_t kMemoryShare = 8;       // of the limit, for one table
constexpr std::size_t kMaxBytes = 16 << 20;   // likewise, whatever the limit
constexpr std::size_t kRowsPerStep = 6;       // looked at when a step is, at least

}  // namespace

bool MutexDeadEnds::proves_dead_end(StateView state, std::span<const ActionId> running,
                                    ActionCompression steps) {
  if (patience_ > 0) return false;
  Table& table = tables_[static_cast<std::size_t>(steps)];
  if (!std::exchange(table.tried, true)) {
    if (auto found = find(steps)) table.pairs.emplace(std::move(*found));
  }
  return table.pairs && table.pairs->in(state, running);
}

std::optional<BackwardH2Mutexes> MutexDeadEnds::find(ActionCompression style) {
  const std::size_t literals = FdrOperators::literals(task_, style);
  const std::size_t most = std::min(kMaxBytes, limits_.memory_limit() / kMemoryShare);
  if (PairMatrix::bytes(literals) > most) return std::nullopt;
  if (task_.actions.size() * kRowsPerStep > kMaxTableWork / (literals / 64 + 1)) return std::nullopt;
  FdrOperators steps(task_, style, [&] { limits_.step(); });
  const std::size_t bytes = steps.bytes() + BackwardH2Mutexes::most_bytes(steps);
  if (bytes > most) return std::nullopt;
  limits_.memory_on_top(bytes);
  std::size_t done = 0;
  return BackwardH2Mutexes::find(task_, std::move(steps), [&](std::size_t work) {
    limits_.step();
    done += work;
    return done <= kMaxTableWork;
  });
}

std::size_t MutexDeadEnds::bytes() const {
  std::size_t result = 0;
  for (const Table& table : tables_) result += table.pairs ? table.pairs->bytes() : 0;
  return result;
}

}  // namespace roci::planner::temporal_pddl::dead_ends
