// Estimates give duration and energy of motions in batches, each computed once per model version; what was not
// found is searched again, harder, when it is asked again.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "arm_svc/motion.hpp"

namespace roci::arm {

/// Names a motion by its two ends, and by what the tool carries.
struct PlacePair {
  Place from;
  Place to;
  Payload payload = {};
};

/// Holds duration (s) and energy (J) of a motion, or why it has none.
struct Estimate {
  MotionStatus status = MotionStatus::found;
  std::string detail;
  double duration_s = 0;
  double energy_j = 0;
  bool proved = false;  ///< as in Motion
};

/// Keeps what was computed for one model version, by the joint values at both ends; a model of another
/// version empties it. A motion that was not found, and not proved to be none, is searched with twice the effort
/// by each later request that asks for it, up to kMostEffort: nothing but the count of requests decides.
///
/// A full cache forgets motions that no request has asked for lately, found ones first. Where that makes no room, what
/// is found is not kept; what is not found is, up to twice as many in all, since the effort that it has taken counts.
class EstimateCache {
 public:
  /// 200 named places make 40,000 pairs; a motion takes about half a kilobyte.
  static constexpr std::size_t kMostKept = 100'000;
  explicit EstimateCache(std::size_t most_kept = kMostKept) : most_kept_(most_kept) {}

  /// Tells that what is asked from now on belongs to another request.
  void begin_request() { ++request_; }

  /// Returns one estimate per pair, in their order. A cancelled one is not kept, so that it is computed when
  /// asked again.
  std::vector<Estimate> estimate(const MotionModel& model, std::span<const PlacePair> pairs,
                                 const std::function<bool()>& cancelled = {});
  /// Returns the lower bound of a motion's duration and energy, without a search.
  Estimate bound(const MotionModel& model, const PlacePair& pair);
  /// Returns the place as this cache's questions resolve it, with an effort of 1.
  ResolvedPlace resolve(const MotionModel& model, const Place& place);

  std::size_t size() const { return known_.size(); }

 private:
  // Joint values; where there are none, or names count, the name and position.
  struct PlaceKey {
    std::vector<double> values;
    std::string name;
    auto operator<=>(const PlaceKey&) const = default;
  };
  using Key = std::tuple<PlaceKey, PlaceKey, std::vector<double>>;
  struct Known {
    Estimate estimate;
    unsigned effort = 1;
    std::uint64_t searched = 0;  // by the request of this number
    std::uint64_t asked = 0;     // likewise, and lastly
  };

  void forget_other_versions(const MotionModel& model);
  static PlaceKey key_of(const MotionModel& model, const Place& place, const ResolvedPlace& resolved);
  Estimate one(const MotionModel& model, const PlacePair& pair, const std::function<bool()>& cancelled);
  void keep(Key key, Known known);
  void forget_unasked();

  std::size_t most_kept_;
  std::uint64_t version_ = 0;
  std::uint64_t request_ = 0;
  std::optional<std::uint64_t> swept_;  // the request in which forget_unasked() was called last
  std::map<Key, Known> known_;
  std::map<PlaceKey, ResolvedPlace> positions_;
};

}  // namespace roci::arm
