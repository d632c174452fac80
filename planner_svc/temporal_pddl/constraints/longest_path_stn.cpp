#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"

#include <limits>

namespace roci::planner::temporal_pddl::constraints {

using temporal::Duration;

namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr int kPlainPasses = 2;

// Returns whether some points raise each other in a circle; `raised_by` holds by point the one that raised it
// last.
bool circular(const std::vector<std::uint32_t>& raised_by, std::vector<std::uint32_t>& seen_from) {
  seen_from.assign(raised_by.size(), kNobody);
  for (std::uint32_t first = 0; first < raised_by.size(); ++first) {
    std::uint32_t point = first;
    while (point != kNobody && seen_from[point] == kNobody) {
      seen_from[point] = first;
      point = raised_by[point];
    }
    if (point != kNobody && seen_from[point] == first) return true;
  }
  return false;
}

}  // namespace

// Finds the least times by Bellman and Ford; in plan order most edges go forward, so that the first pass
// settles most points. What is not settled soon is watched: points that raise each other in a circle lie on a
// cycle of positive length (Cherkassky and Goldberg 1999).
bool LongestPathStn::raise(std::vector<Duration>& times) const {
  const auto pass = [&](const auto& raised) {
    bool changed = false;
    for (const Edge& edge : edges_) {
      if (times[edge.from] == kNoPath || times[edge.from] + edge.least <= times[edge.to]) continue;
      times[edge.to] = times[edge.from] + edge.least;
      raised(edge);
      changed = true;
    }
    return changed;
  };
  for (int i = 0; i < kPlainPasses; ++i) {
    if (!pass([](const Edge&) {})) return true;
  }
  std::vector<std::uint32_t> raised_by(points_, kNobody), seen_from;
  while (pass([&](const Edge& edge) { raised_by[edge.to] = edge.from; })) {
    if (circular(raised_by, seen_from)) return false;
  }
  return true;
}

std::optional<std::vector<Duration>> LongestPathStn::longest_from(std::size_t source) const {
  std::vector<Duration> times(points_, kNoPath);
  times[source] = Duration{0};
  if (!raise(times)) return std::nullopt;
  return times;
}

}  // namespace roci::planner::temporal_pddl::constraints
