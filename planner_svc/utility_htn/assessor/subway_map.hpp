// The science subway map says which target is sampled next (MEXEC, section II.B.2 and figure 3, R112).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::assessor {

/// Names a target of the map.
struct Stop {
  std::uint32_t site = 0;
  std::uint32_t target = 0;
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// Says what is known of a target's biosignature: in the order of the states of its signature timeline.
enum class Signature : std::uint8_t { unknown, negative, positive };

/// Holds the state of all targets: signatures known, and samples planned whose signature is not known yet.
class SubwayState {
 public:
  /// Takes signatures from the newest values of the targets' timelines; without values all are unknown.
  SubwayState(const model::SubwayMap& map, const model::Values& values,
              std::span<const double> timelines_now);

  /// Notes that a sample is planned. As long as its signature is unknown it counts as positive: when it turns out to be
  /// negative, the plan is made again.
  void plan(Stop stop);
  /// Notes that nobody asks for a sample there any more, as after a failure: the map leads past it.
  void close(Stop stop);
  /// Returns whether the target was sampled, is planned or closed.
  bool taken(Stop stop) const;

  /// Returns the target that the map leads to: at the site that is begun, as long as all its signatures are positive
  /// and fewer than `most_samples` are taken; else at the untouched site of greatest estimated value. Targets of a site
  /// go by estimated value, equal ones in the order of the network. Nothing: the line ends.
  std::optional<Stop> next() const;

  /// Returns how likely a positive signature is at a site: the mean of a beta distribution whose prior is the site's
  /// value by vision, as if from kPriorSamples samples, after all known signatures: those of the site count fully,
  /// those of other sites by kElsewhere.
  double chance(std::uint32_t site) const;
  /// Returns the target's weight by visual inspection × chance of its site, within [0, 1].
  double estimated(Stop stop) const;

  static constexpr double kPriorSamples = 2;
  static constexpr double kElsewhere = 0.25;

 private:
  struct Line {
    double value = 0;
    std::vector<double> visual;
    std::vector<Signature> signatures;
    std::vector<bool> taken;
    std::uint32_t samples = 0;  // taken
    std::uint32_t positives = 0, negatives = 0;
  };

  std::optional<Stop> best_target(std::uint32_t site) const;

  std::uint32_t most_samples_;
  std::vector<Line> lines_;
  std::uint32_t positives_ = 0, negatives_ = 0;
};

}  // namespace roci::planner::utility_htn::assessor
