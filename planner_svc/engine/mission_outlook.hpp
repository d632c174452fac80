// An outlook is what an engine that plans all the time expects of its plan, for operators and for whoever
// sends data (R110–R115, R127).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"
#include "planner_svc/engine/data_product.hpp"

namespace roci::planner::engine {

/// Says what earns utility at one rank (R113). Any gain there outweighs every gain of the ranks that follow.
struct UtilityRank {
  std::string name;
  std::string meaning;  ///< a sentence
  friend bool operator==(const UtilityRank&, const UtilityRank&) = default;
};

/// Names data that exist by their own id, and data that a planned task will generate by "request/task/product".
struct ScheduledProduct {
  std::string id;
  bool exists = false;
  std::uint64_t bytes = 0;
  DataTier tier = DataTier::mandatory;
  friend bool operator==(const ScheduledProduct&, const ScheduledProduct&) = default;
};

/// Says what one downlink of the plan carries, and what that takes.
struct ScheduledDownlink {
  std::string activity;  ///< activity of the plan
  temporal::Time start{0};
  temporal::Time end{0};
  std::uint64_t bytes = 0;
  temporal::Duration takes{0};               ///< time of the transmission alone
  double energy_j = 0;                       ///< energy of the transmission
  std::vector<ScheduledProduct> products{};  ///< in the order in which they go
  friend bool operator==(const ScheduledDownlink&, const ScheduledDownlink&) = default;
};

/// Names data that are not sent, or late, and why.
struct UnsentProduct {
  ScheduledProduct data;
  std::string why;
  friend bool operator==(const UnsentProduct&, const UnsentProduct&) = default;
};

/// Says which data go with which downlink of the plan, and what is not sent or late, and why (R110, R111, R126, R127).
struct DownlinkSchedule {
  std::vector<UtilityRank> ranks{};            ///< the highest first
  bool limited = false;                        ///< false: all data get home, no downlink has a limit
  std::vector<ScheduledDownlink> downlinks{};  ///< by start
  std::vector<UnsentProduct> left_out{};
  std::vector<UnsentProduct> late{};
  friend bool operator==(const DownlinkSchedule&, const DownlinkSchedule&) = default;
};

/// Says how a requested task stands, in the order of ChainStage in idl/outlook.idl.
enum class ChainStage { planned, committed, running, done, failed };

/// Describes a requested task in the way that was chosen for it.
struct ChainOutlook {
  std::string request;
  std::string title;  ///< for people
  std::string chain;  ///< the task and its decompositions
  std::uint32_t block = 0;
  ChainStage stage = ChainStage::planned;
  temporal::Time start{0};
  temporal::Time end{0};
  temporal::RankVector predicted{};
  temporal::RankVector executed{};  ///< of its data as they turned out so far (R115)
  double cost_j = 0;                ///< predicted
  friend bool operator==(const ChainOutlook&, const ChainOutlook&) = default;
};

/// Says what data are expected to be worth, and what they turned out to be worth.
struct ProductOutlook {
  ScheduledProduct data;
  std::string request;  ///< empty: none of the model
  DataFate fate = DataFate::stored;
  temporal::RankVector predicted{};  ///< none: the model says nothing of this product
  temporal::RankVector executed{};   ///< of data that exist
  friend bool operator==(const ProductOutlook&, const ProductOutlook&) = default;
};

/// Says what the budget is expected to hold now, and where a planned task starts or ends.
struct EnergyPoint {
  temporal::Time at{0};
  std::string activity;  ///< that ends then; empty: none
  double predicted_j = 0;
  double worst_j = 0;  ///< what is still to come takes 1.1 times as much
  double best_j = 0;   ///< 0.9 times
  friend bool operator==(const EnergyPoint&, const EnergyPoint&) = default;
};

/// Says what is known of a target's biosignature, in the order of SignatureOutcome in idl/outlook.idl.
enum class SignatureOutcome { unknown, negative, positive };

/// Describes a target of the science subway map (R112).
struct SubwayTarget {
  std::string task;  ///< that is requested to sample it
  SignatureOutcome outcome = SignatureOutcome::unknown;
  double visual = 0;     ///< in [0, 1]
  double estimated = 0;  ///< that × the chance of its site
  bool planned = false;
  bool closed = false;  ///< nobody asks for a sample there any more
  friend bool operator==(const SubwayTarget&, const SubwayTarget&) = default;
};

/// Describes a site of the science subway map with its targets (R112).
struct SubwaySite {
  std::string name;
  double by_vision = 0;  ///< in [0, 1]
  double chance = 0;     ///< of a positive signature, after all that are known
  std::vector<SubwayTarget> targets{};
  friend bool operator==(const SubwaySite&, const SubwaySite&) = default;
};

/// Says what chains and data are worth (R113, R115), how the energy goes,
/// and where the science subway map leads (R112).
struct MissionOutlook {
  std::vector<UtilityRank> ranks{};
  temporal::RankVector received{};         ///< of all data that are on Earth
  std::vector<ChainOutlook> chains{};      ///< by start; those that have ended stay
  std::vector<ProductOutlook> products{};  ///< those that exist by id, then those that are planned
  std::string budget{};                    ///< timeline
  double capacity_j = 0;
  std::vector<EnergyPoint> energy{};  ///< by time
  std::uint32_t most_samples = 0;     ///< at one site
  std::vector<SubwaySite> sites{};    ///< by chance, the greatest first
  std::string next_target{};          ///< after what is planned; empty: the line ends
  friend bool operator==(const MissionOutlook&, const MissionOutlook&) = default;
};

}  // namespace roci::planner::engine
