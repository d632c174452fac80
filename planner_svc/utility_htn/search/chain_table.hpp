// The chain table is what one search knows of each chain: it is computed once, since values do not change
// within a search.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/search/scheduler.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Holds costs, predictions and links of all chains of a problem.
class ChainTable {
 public:
  explicit ChainTable(const Problem& problem);

  const flattening::Chain& chain(std::uint32_t index) const { return problem_.chains.chains[index]; }
  const model::Task& request(std::uint32_t index) const { return problem_.network.tasks[chain(index).task]; }
  double cost(std::uint32_t index) const { return costs_[index]; }
  /// Returns whether the chain's prediction or that of others depends on the plan (Assessor::contextual()).
  bool contextual(std::uint32_t index) const { return contextual_[index]; }
  /// Returns the prediction of a chain that is not contextual, rounded.
  const temporal::RankVector& utility(std::uint32_t index) const { return utilities_[index]; }
  /// Returns whether the request is neither closed nor committed.
  bool open(std::uint32_t index) const { return !taken_[chain(index).task]; }
  /// Returns, by task, which requests are closed or committed.
  const std::vector<bool>& taken() const { return taken_; }
  /// Returns whether a time of the chain is fixed: its request's, or one of its tasks'.
  bool fixed(std::uint32_t index) const;

  /// Returns the links with the windows in which they may start; those of a chain are made once.
  std::span<const Link> links(std::uint32_t index);
  /// Returns the prediction of a chain after what is planned, rounded.
  temporal::RankVector predicted(std::uint32_t index, std::span<const std::uint32_t> planned) const;
  /// Sets what forecast() follows: chains by start.
  void follow(std::span<const std::uint32_t> planned) { forecast_->plan(planned); }
  /// Adds one more chain, which starts last.
  void follow_next(std::uint32_t index) { forecast_->plan_next(index); }
  /// Returns predicted() after what is followed, or for what that refuses perhaps something else that is refused.
  temporal::RankVector forecast(std::uint32_t index) const;
  /// Adds what a placed chain would generate and send.
  void add_data(const Placed& placed, PlannedData& out) const;
  /// Returns what all that is committed would generate and send.
  PlannedData committed_data() const;

  std::size_t bytes() const { return link_bytes_; }

 private:
  std::vector<Link> make_links(std::uint32_t index) const;

  const Problem& problem_;
  std::vector<double> costs_;
  std::vector<bool> contextual_;
  std::vector<temporal::RankVector> utilities_;
  std::vector<bool> taken_;
  std::unique_ptr<assessor::Forecast> forecast_;
  std::vector<std::vector<Link>> links_;
  std::size_t link_bytes_ = 0;
};

/// Returns the chains by start of their first links, equal ones by index: an Assessor's context.
std::vector<std::uint32_t> by_start(std::span<const Placed> committed, std::span<const Placed> placed);

}  // namespace roci::planner::utility_htn::search
