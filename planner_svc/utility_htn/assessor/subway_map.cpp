#include "planner_svc/utility_htn/assessor/subway_map.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::assessor {

SubwayState::SubwayState(const model::SubwayMap& map, const model::Values& values,
                         std::span<const double> timelines_now)
    : most_samples_(map.most_samples) {
  for (const model::Site& site : map.sites) {
    Line& line = lines_.emplace_back();
    line.value = std::clamp(model::evaluate(site.value, values), 0.0, 1.0);
    for (const model::Target& target : site.targets) {
      const double now = target.signature < timelines_now.size() ? timelines_now[target.signature] : 0;
      const Signature signature = now == 1   ? Signature::negative
                                  : now == 2 ? Signature::positive
                                             : Signature::unknown;
      line.visual.push_back(std::clamp(model::evaluate(target.visual, values), 0.0, 1.0));
      line.signatures.push_back(signature);
      line.taken.push_back(signature != Signature::unknown);
      line.samples += signature != Signature::unknown;
      line.positives += signature == Signature::positive;
      line.negatives += signature == Signature::negative;
    }
    positives_ += line.positives;
    negatives_ += line.negatives;
  }
}

void SubwayState::plan(Stop stop) {
  Line& line = lines_.at(stop.site);
  if (line.taken.at(stop.target)) return;  // its signature is known already
  line.taken[stop.target] = true;
  ++line.samples;
}

void SubwayState::close(Stop stop) { lines_.at(stop.site).taken.at(stop.target) = true; }

bool SubwayState::taken(Stop stop) const { return lines_.at(stop.site).taken.at(stop.target); }

std::optional<Stop> SubwayState::next() const {
  std::optional<Stop> found;
  bool found_begun = false;
  for (std::uint32_t site = 0; site < lines_.size(); ++site) {
    const Line& line = lines_[site];
    if (line.negatives > 0 || line.samples >= most_samples_) continue;
    const std::optional<Stop> stop = best_target(site);
    if (!stop) continue;
    const bool begun = line.samples > 0;
    if (found && (begun < found_begun || (begun == found_begun && chance(site) <= chance(found->site))))
      continue;
    found = stop;
    found_begun = begun;
  }
  return found;
}

double SubwayState::chance(std::uint32_t site) const {
  const Line& line = lines_.at(site);
  const double positives = line.positives + kElsewhere * (positives_ - line.positives);
  const double negatives = line.negatives + kElsewhere * (negatives_ - line.negatives);
  return (kPriorSamples * line.value + positives) / (kPriorSamples + positives + negatives);
}

double SubwayState::estimated(Stop stop) const {
  return lines_.at(stop.site).visual.at(stop.target) * chance(stop.site);
}

std::optional<Stop> SubwayState::best_target(std::uint32_t site) const {
  const Line& line = lines_[site];
  std::optional<Stop> found;
  for (std::uint32_t target = 0; target < line.taken.size(); ++target) {
    if (line.taken[target]) continue;
    if (!found || line.visual[target] > line.visual[found->target]) found = Stop{site, target};
  }
  return found;
}

}  // namespace roci::planner::utility_htn::assessor
