#include "arm_svc/estimate.hpp"

namespace roci::arm {
namespace {

// Places given by joint values come and go; named ones stay far below this number.
constexpr std::size_t kMostKept = 20000;

std::vector<double> values_of(const kinematics::JointVector& q) { return {q.data(), q.data() + q.size()}; }

}  // namespace

std::vector<Estimate> EstimateCache::estimate(const MotionModel& model, std::span<const PlacePair> pairs,
                                              const std::function<bool()>& cancelled) {
  if (model.version() != version_ || known_.size() > kMostKept) known_.clear();
  version_ = model.version();
  std::vector<Estimate> estimates;
  estimates.reserve(pairs.size());
  for (const auto& [from, to] : pairs) {
    const Key key{values_of(model.resolve(from).joints), values_of(model.resolve(to).joints)};
    const bool resolved = !key.first.empty() && !key.second.empty();
    if (const auto known = known_.find(key); resolved && known != known_.end()) {
      estimates.push_back(known->second);
      continue;
    }
    const Motion motion = model.motion(from, to, cancelled);
    estimates.push_back({motion.status, motion.detail, motion.duration_s, motion.energy_j});
    if (resolved && motion.status != MotionStatus::cancelled) known_.emplace(key, estimates.back());
  }
  return estimates;
}

}  // namespace roci::arm
