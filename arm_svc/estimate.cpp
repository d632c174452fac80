#include "arm_svc/estimate.hpp"

#include <algorithm>
#include <utility>

namespace roci::arm {
namespace {

constexpr std::size_t kMostPositions = 10'000;
// A planning call makes a request for each function in each of some rounds.
constexpr std::uint64_t kLately = 64;

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
  if (model.version() != version_) known_.clear();
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
    known->second.asked = request_;
    const bool again = open(known->second.estimate) && known->second.searched != request_ &&
                       known->second.effort < kMostEffort;
    if (!again) return known->second.estimate;
    effort = 2 * known->second.effort;
    from = model.resolve(pair.from, effort);
    to = model.resolve(pair.to, effort);
  }
  const Motion motion = model.plan(from, to, pair.payload, effort, cancelled);
  Estimate estimate{motion.status, motion.detail, motion.duration_s, motion.energy_j, motion.proved};
  if (motion.status != MotionStatus::cancelled && motion.status != MotionStatus::unknown_pose)
    keep(std::move(key), {estimate, effort, request_, request_});
  return estimate;
}

void EstimateCache::keep(Key key, Known known) {
  if (const auto place = known_.find(key); place != known_.end()) {
    place->second = std::move(known);
    return;
  }
  if (known_.size() >= most_kept_ && swept_ != request_) forget_unasked();
  const std::size_t most = open(known.estimate) ? 2 * most_kept_ : most_kept_;
  if (known_.size() < most) known_.emplace(std::move(key), std::move(known));
}

void EstimateCache::forget_unasked() {
  swept_ = request_;
  const auto unasked = [this](const Known& known) { return known.asked + kLately < request_; };
  std::erase_if(known_,
                [&](const auto& entry) { return unasked(entry.second) && !open(entry.second.estimate); });
  if (known_.size() < most_kept_) return;
  std::erase_if(known_, [&](const auto& entry) { return unasked(entry.second); });
}

Estimate EstimateCache::bound(const MotionModel& model, const PlacePair& pair) {
  forget_other_versions(model);
  const MotionBound bound = model.bound(resolve(model, pair.from), resolve(model, pair.to), pair.payload);
  return {bound.status, bound.detail, bound.duration_s, bound.energy_j, bound.proved};
}

}  // namespace roci::arm
