// Data products are data that were generated, as engines hear of them (R110).
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"

namespace roci::planner::engine {

/// Says how soon data must reach the ground, in the order of DataTier in idl/command.idl.
enum class DataTier { critical, decisional, mandatory, residual };
/// Says what has become of data, in the order of ProductFate in idl/command.idl.
enum class DataFate { stored, sent, received, discarded, left_behind, lost };

/// Describes data that were generated, as they stand now.
struct DataProduct {
  std::string id;
  std::string kind;    ///< the name of its kind of data, e.g. "image", or of the product as a model names it
  std::string source;  ///< activity that made it
  DataTier tier = DataTier::mandatory;
  std::uint64_t bytes = 0;
  temporal::Time created{0};
  temporal::RankVector utility;  ///< as computed from the data; none: not computed
  DataFate fate = DataFate::stored;
  temporal::Time told{0};  ///< when its owner said so, the same for later listeners
  friend bool operator==(const DataProduct&, const DataProduct&) = default;
};

}  // namespace roci::planner::engine
