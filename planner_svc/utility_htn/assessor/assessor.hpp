// An Assessor says what a task would be worth in its context (MEXEC, section IV.C.2, R115), and keeps that apart from
// what executed tasks turned out to be worth.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::assessor {

/// Describes data that were generated on board.
struct ExistingProduct {
  std::string id;
  model::TaskIndex task = 0;       ///< the primitive task that generated it
  model::TaskIndex request = 0;    ///< the requested task of which that was part
  temporal::RankVector utility{};  ///< as computed from the data
  friend bool operator==(const ExistingProduct&, const ExistingProduct&) = default;
};

/// Holds what a prediction depends on.
struct Context {
  const model::Network& network;
  const model::Values& values;
  const flattening::Chains& chains;
  std::span<const double> timelines_now;      ///< newest values, by timeline Index
  std::span<const ExistingProduct> products;  ///< of all tasks executed so far
  std::span<const std::uint32_t> planned;     ///< chains of the partial plan, in the order of their starts
  std::span<const model::TaskIndex> closed;   ///< requests that are done, failed for good or withdrawn
};

/// Predicts chains again and again while only the plan changes, as in a search: what else a prediction depends on is
/// read once.
class Forecast {
 public:
  virtual ~Forecast() = default;

  /// Takes the plan from here on, in the order of starts.
  virtual void plan(std::span<const std::uint32_t> planned) = 0;
  /// Takes one more chain, which starts after all that is planned.
  virtual void plan_next(std::uint32_t chain) = 0;
  /// Returns what Assessor::predicted() does after what is planned; where that breaks a rule of the mission, perhaps
  /// another vector that does.
  virtual temporal::RankVector predicted(std::uint32_t chain) const = 0;
};

/// Predicts utilities. An Assessor is a pure function of its arguments: equal contexts give equal utilities.
class Assessor {
 public:
  virtual ~Assessor() = default;

  /// Returns the utility that is expected of a chain when it follows what is planned. One whose first score that is not
  /// 0 is below 0 would break a rule of the mission: no plan holds it (R114).
  virtual temporal::RankVector predicted(std::uint32_t chain, const Context& context) const = 0;
  /// Returns predictions for contexts that are this one but for what is planned. Assessor and context outlive it.
  virtual std::unique_ptr<Forecast> forecast(const Context& context) const;
  /// Returns no less, rank by rank, than predicted() in any context that the plan may still grow into.
  virtual temporal::RankVector most(std::uint32_t chain, const Context& context) const = 0;
  /// Returns whether the prediction depends on what is planned, or that of others on this chain being planned. All
  /// others are asked for once in a search.
  virtual bool contextual(std::uint32_t chain, const Context& context) const = 0;
  /// Returns which rule the chain would break in this context, as a sentence for people; empty: none.
  virtual std::string objection(std::uint32_t chain, const Context& context) const;
  /// Returns what existing data turned out to be worth.
  virtual temporal::RankVector executed(const ExistingProduct& product, const Context& context) const;
};

/// Predicts the sums that the network holds (R92), whatever the context.
class NetworkAssessor final : public Assessor {
 public:
  temporal::RankVector predicted(std::uint32_t chain, const Context& context) const override;
  temporal::RankVector most(std::uint32_t chain, const Context& context) const override;
  bool contextual(std::uint32_t chain, const Context& context) const override;
};

}  // namespace roci::planner::utility_htn::assessor
