#include "arm_svc/estimate.hpp"

namespace roci::arm {

std::vector<Estimate> EstimateCache::estimate(const MotionModel& model, std::span<const PoseTuple> tuples,
                                              const std::function<bool()>& cancelled) {
  if (model.version() != version_) {
    known_.clear();
    version_ = model.version();
  }
  std::vector<Estimate> estimates;
  estimates.reserve(tuples.size());
  for (const PoseTuple& tuple : tuples) {
    const auto key = std::make_pair(tuple.from, tuple.to);
    if (const auto known = known_.find(key); known != known_.end()) {
      estimates.push_back(known->second);
      continue;
    }
    const Motion motion = model.motion(tuple.from, tuple.to, cancelled);
    estimates.push_back({motion.status, motion.detail, motion.duration_s, motion.energy_j});
    const bool worth_keeping =
        motion.status != MotionStatus::cancelled && motion.status != MotionStatus::unknown_pose;
    if (worth_keeping) known_.emplace(key, estimates.back());
  }
  return estimates;
}

}  // namespace roci::arm
