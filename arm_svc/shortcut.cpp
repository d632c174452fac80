#include "arm_svc/shortcut.hpp"

#include <algorithm>
#include <random>

#include "arm_svc/sampling.hpp"
#include "arm_svc/trajectory.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;

// Is a point `fraction` of the way through part `part` of the path.
struct PathPoint {
  std::size_t part;
  double fraction;
};

JointVector position(const JointPath& path, const PathPoint& p) {
  return path[p.part] + p.fraction * (path[p.part + 1] - path[p.part]);
}

PathPoint sample_point(const JointPath& path, std::mt19937_64& random) {
  const double along = unit_sample(random) * static_cast<double>(path.size() - 1);
  const auto part = std::min(static_cast<std::size_t>(along), path.size() - 2);
  return {part, along - static_cast<double>(part)};
}

double duration_s(const kinematics::Arm& arm, const JointPath& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += line_duration_s(arm, path[i - 1], path[i]);
  return sum;
}

JointPath with_line(const JointPath& path, const PathPoint& a, const PathPoint& b) {
  JointPath cut(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(a.part) + 1);
  if (a.fraction > 0) cut.push_back(position(path, a));
  if (b.fraction > 0) cut.push_back(position(path, b));
  cut.insert(cut.end(), path.begin() + static_cast<std::ptrdiff_t>(b.part) + (b.fraction > 0 ? 1 : 0),
             path.end());
  return cut;
}

// Drops way-points that can be skipped outright; each trial costs one line, and few way-points mean few
// stops.
JointPath without_detours(const kinematics::Arm& arm, const CollisionChecker& checker, JointPath path) {
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    for (std::size_t j = path.size() - 1; j > i + 1; --j) {
      const JointPath cut = with_line(path, {i, 0.0}, {j, 0.0});
      if (duration_s(arm, cut) > duration_s(arm, path) || !checker.line_is_free(path[i], path[j])) continue;
      path = cut;
      break;
    }
  }
  return path;
}

}  // namespace

JointPath shortened(const kinematics::Arm& arm, const CollisionChecker& checker, JointPath path, int trials,
                    std::uint64_t seed) {
  if (path.size() < 3) return path;
  path = without_detours(arm, checker, std::move(path));
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < trials && path.size() > 2; ++trial) {
    PathPoint a = sample_point(path, random), b = sample_point(path, random);
    if (a.part > b.part) std::swap(a, b);
    if (a.part == b.part) continue;
    JointPath cut = with_line(path, a, b);
    if (duration_s(arm, cut) < duration_s(arm, path) &&
        checker.line_is_free(position(path, a), position(path, b))) {
      path = std::move(cut);
    }
  }
  return without_detours(arm, checker, std::move(path));
}

}  // namespace roci::arm
