#include "arm_svc/estimate.hpp"

#include <algorithm>
#include <utility>

namespace roci::arm {
namespace {

// Places given by joint values or positions come and go; 200 named ones make 40,000 pairs.
constexpr std::size_t kMostKept = 100'000;
constexpr std::size_t kMostPositions = 10'000;

template <typename Values>
std::vector<double> values_of(const Values& values) {
  return {values.data(), values.data() + values.size()};
}

std::vector<double> values_of(const Payload& payload) {
  if (payload.none()) return {};
  return {payload.mass_kg, payload.size_m.x(), payload.size_m.y(), payload.size_m.z()};
}

// More effort may change the answer.
bool open(const Estimate& estimate) {
  return !estimate.proved && estimate.status != MotionStatus::found &&
         estimate.status != MotionStatus::unknown_pose && estimate.status != MotionStatus::faulty;
}

}  // namespace

void EstimateCache::forget_other_versions(const MotionModel& model) {
  if (model.version() != version_ || known_.size() > kMostKept) known_.clear();
  if (model.version() != version_ || positions_.size() > kMostPositions) positions_.clear();
  version_ = model.version();
}

EstimateCache::PlaceKey EstimateCache::key_of(const MotionModel& model, const Place& place,
                                              const ResolvedPlace& resolved) {
  if (resolved.status == MotionStatus::found)
    return {values_of(resolved.joints), model.has_modules() ? place.name : std::string()};
  PlaceKey key{{}, place.name};
  if (place.joints) key.values = values_of(*place.joints);
  if (place.position) key.values = values_of(*place.position);
  return key;
}

ResolvedPlace EstimateCache::resolve(const MotionModel& model, const Place& place) {
  if (place.joints || !place.position) return model.resolve(place);
  const PlaceKey key{values_of(*place.position), place.name};
  const auto known = positions_.find(key);
  if (known != positions_.end()) return known->second;
  return positions_.emplace(key, model.resolve(place)).first->second;
}

std::vector<Estimate> EstimateCache::estimate(const MotionModel& model, std::span<const PlacePair> pairs,
                                              const std::function<bool()>& cancelled) {
  forget_other_versions(model);
  std::vector<Estimate> estimates;
  estimates.reserve(pairs.size());
  for (const PlacePair& pair : pairs) estimates.push_back(one(model, pair, cancelled));
  return estimates;
}

Estimate EstimateCache::one(const MotionModel& model, const PlacePair& pair,
                            const std::function<bool()>& cancelled) {
  ResolvedPlace from = resolve(model, pair.from), to = resolve(model, pair.to);
  Key key{key_of(model, pair.from, from), key_of(model, pair.to, to), values_of(pair.payload)};
  const auto known = known_.find(key);
  unsigned effort = 1;
  if (known != known_.end()) {
    const bool again = open(known->second.estimate) && known->second.request != request_ &&
                       known->second.effort < kMostEffort;
    if (!again) return known->second.estimate;
    effort = 2 * known->second.effort;
    from = model.resolve(pair.from, effort);
    to = model.resolve(pair.to, effort);
  }
  const Motion motion = model.plan(from, to, pair.payload, effort, cancelled);
  Estimate estimate{motion.status, motion.detail, motion.duration_s, motion.energy_j, motion.proved};
  if (motion.status != MotionStatus::cancelled && motion.status != MotionStatus::unknown_pose)
    known_.insert_or_assign(std::move(key), Known{estimate, effort, request_});
  return estimate;
}

Estimate EstimateCache::bound(const MotionModel& model, const PlacePair& pair) {
  forget_other_versions(model);
  const MotionBound bound = model.bound(resolve(model, pair.from), resolve(model, pair.to), pair.payload);
  return {bound.status, bound.detail, bound.duration_s, bound.energy_j, bound.proved};
}

}  // namespace roci::arm
