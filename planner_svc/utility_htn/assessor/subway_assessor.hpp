// This is the Assessor of missions with a subway map (MEXEC, sections II.B.2, IV.C.1 and IV.C.2, R112–R115).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/assessor/subway_map.hpp"

namespace roci::planner::utility_htn::assessor {

/// Predicts chains that sample a target by the map, all others as the network says.
///
/// Of a chain that samples the target to which the map leads after what is planned, the score at the map's rank is 1;
/// of any other target's it is −1, which no plan holds. At the rank below, what its tasks are worth is multiplied by
/// the target's estimated value, but for communication, whose utility is constant. To that comes what supports the
/// sample without being part of the chain, as the site's excavation: what existing data of it turned out to be worth,
/// or else what is predicted of it where it is planned. A chain that opens a site for samples without taking one itself
/// scores −1 where the map does not lead to that site.
class SubwayAssessor final : public Assessor {
 public:
  /// Looks up once which chains sample which target, which chains open a site, and which tasks support all samples of a
  /// site: those that its openers hold, or chains of at least two of its targets, and no other chain. With two sites
  /// and more, what changes a timeline for which only samples of one site wait opens that site.
  SubwayAssessor(const model::Network& network, const flattening::Chains& chains);

  temporal::RankVector predicted(std::uint32_t chain, const Context& context) const override;
  std::unique_ptr<Forecast> forecast(const Context& context) const override;
  temporal::RankVector most(std::uint32_t chain, const Context& context) const override;
  bool contextual(std::uint32_t chain, const Context& context) const override;
  std::string objection(std::uint32_t chain, const Context& context) const override;

  /// Returns the target that a chain samples.
  std::optional<Stop> stop(std::uint32_t chain) const { return stops_.at(chain); }
  /// Returns the map's state after what is planned.
  SubwayState state(const Context& context) const;

 private:
  class MapForecast;
  void find_openers(const model::Network& network, const flattening::Chains& chains);
  temporal::RankVector opening(std::uint32_t chain, const Context& context, const temporal::RankVector& worth,
                               const std::optional<Stop>& next) const;
  temporal::RankVector sampling(std::uint32_t chain, const Context& context, const temporal::RankVector& own,
                                const std::optional<Stop>& next) const;
  temporal::RankVector own_worth(const flattening::Chain& chain, const Context& context,
                                 double estimated) const;
  temporal::RankVector support(std::uint32_t chain, std::uint32_t site, const Context& context) const;

  std::vector<std::optional<Stop>> stops_;                 // by chain
  std::vector<std::optional<std::uint32_t>> opens_;        // by chain: a site
  std::vector<std::vector<model::TaskIndex>> supporting_;  // by site
};

}  // namespace roci::planner::utility_htn::assessor
