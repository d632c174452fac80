// This bench asks the inverse kinematics for random reachable targets: tool poses that joint values drawn within the
// limits have. It tells how many are found, and in what time. From anywhere:
// build/release/bench/bench_arm [COUNT] [SEED]
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "arm_svc/ik.hpp"
#include "arm_svc/sampling.hpp"
#include "arm_svc/setup_file.hpp"
#include "core/kinematics/forward.hpp"

namespace roci::arm {
namespace {

enum class Wanted { position, approach, pose };

ToolTarget target_at(const Eigen::Isometry3d& tool, Wanted wanted) {
  ToolTarget target;
  target.position = tool.translation();
  if (wanted == Wanted::approach) target.approach = Approach{Eigen::Vector3d::UnitX(), tool.linear().col(0)};
  if (wanted == Wanted::pose) target.orientation = Eigen::Quaterniond(tool.linear());
  return target;
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double share_of(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

nlohmann::ordered_json measured(const kinematics::Arm& arm, Wanted wanted, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  kinematics::JointVector first(static_cast<Eigen::Index>(arm.joints.size()));
  first.setZero();
  std::vector<double> milliseconds;
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const ToolTarget target = target_at(kinematics::tool_pose(arm, sample_coordinates(arm, random)), wanted);
    const double begin = processor_ms();
    const auto solutions = solve_ik(arm, target, first, {});
    milliseconds.push_back(processor_ms() - begin);
    if (solutions.empty()) continue;
    const ToolError error = tool_error(arm, solutions.front(), target);
    const bool there =
        error.position < 1e-4 && error.angle < 1e-3 && kinematics::within_limits(arm, solutions.front());
    found += there ? 1 : 0;
  }
  std::ranges::sort(milliseconds);
  return {{"asked", count},
          {"found_percent", 100.0 * found / count},
          {"median_ms", share_of(milliseconds, 0.5)},
          {"p99_ms", share_of(milliseconds, 0.99)},
          {"max_ms", milliseconds.back()}};
}

int run(int count, std::uint64_t seed) {
  const std::string sources = ROCI_SOURCE_DIR;
  nlohmann::ordered_json out{{"bench", "arm"}, {"seed", seed}};
  for (const auto& [name, folder] : {std::pair{"planetary", "/missions/planetary/arm"},
                                     std::pair{"rail_and_six", "/tests/unit/arm_svc/rail"}}) {
    const kinematics::Arm arm =
        load_setup(sources + folder + "/arm.urdf", sources + folder + "/poses.yaml").arm;
    for (const auto& [what, wanted] :
         {std::pair{"pose", Wanted::pose}, std::pair{"approach", Wanted::approach},
          std::pair{"position", Wanted::position}})
      out[name][what] = measured(arm, wanted, count, seed);
  }
  std::cout << out.dump(2) << '\n';
  return 0;
}

}  // namespace
}  // namespace roci::arm

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10'000;
  return roci::arm::run(count, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
}
