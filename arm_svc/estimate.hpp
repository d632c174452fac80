// Batched duration and energy of motions, each computed once per model version.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arm_svc/motion.hpp"

namespace roci::arm {

struct PoseTuple {
  std::string from;
  std::string to;
};

struct Estimate {
  MotionStatus status = MotionStatus::found;
  std::string detail;
  double duration_s = 0;
  double energy_j = 0;
};

// What was computed for one model version; a model of another version empties it.
class EstimateCache {
 public:
  // One estimate per tuple, in order. A cancelled tuple is not kept, so that it is computed when asked again.
  std::vector<Estimate> estimate(const MotionModel& model, std::span<const PoseTuple> tuples,
                                 const std::function<bool()>& cancelled = {});

  std::size_t size() const { return known_.size(); }

 private:
  std::uint64_t version_ = 0;
  std::map<std::pair<std::string, std::string>, Estimate> known_;
};

}  // namespace roci::arm
