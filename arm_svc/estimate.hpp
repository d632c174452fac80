// Estimates give duration and energy of motions in batches, each computed once per model version.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arm_svc/motion.hpp"

namespace roci::arm {

/// Names a motion by its two ends.
struct PlacePair {
  Place from;
  Place to;
};

/// Holds duration (s) and energy (J) of a motion, or why it has none.
struct Estimate {
  MotionStatus status = MotionStatus::found;
  std::string detail;
  double duration_s = 0;
  double energy_j = 0;
};

/// Keeps what was computed for one model version, by the joint values at both ends; a model of another
/// version empties it.
class EstimateCache {
 public:
  /// Returns one estimate per pair, in their order. A cancelled one is not kept, so that it is computed when
  /// asked again.
  std::vector<Estimate> estimate(const MotionModel& model, std::span<const PlacePair> pairs,
                                 const std::function<bool()>& cancelled = {});

  std::size_t size() const { return known_.size(); }

 private:
  using Key = std::pair<std::vector<double>, std::vector<double>>;
  std::uint64_t version_ = 0;
  std::map<Key, Estimate> known_;
};

}  // namespace roci::arm
