// States store temporal constraints in this compact form (R28, R29; Stellar section 4.3).
//
// A constraint lower ≤ t(j) − t(i) ≤ upper between steps i and j is a 32-bit head, most significant bits
// first: 15 bits j, 15 bits i, 2 bits kind; it is written least significant byte first. The kinds are:
//   00  lower = 0, upper = ∞      01  lower = ε, upper = ∞
//   10  lower = upper = x, followed by x      11  lower = x, upper = y, followed by x and y
// Here x and y are indices into a table of the distinct bounds, as little-endian base-128 varints (Z2: a
// duration does not fit into the one byte that the paper speaks of).
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::planner::temporal_pddl::constraints {

/// A plan has at most so many steps, as their numbers have 15 bits: 0 … 32,766 (R30).
inline constexpr std::size_t kMaxSteps = 32767;

/// Requires lower ≤ t(to) − t(from) ≤ upper between two steps of a plan.
struct StepConstraint {
  std::uint32_t from = 0;  ///< i
  std::uint32_t to = 0;    ///< j
  temporal::Duration lower{0};
  temporal::Duration upper = temporal::no_bound;
  bool operator==(const StepConstraint&) const = default;
};

/// Interns the distinct bounds of a search, so that a code can name each by a small index.
class BoundTable {
 public:
  std::uint32_t intern(temporal::Duration bound);
  temporal::Duration operator[](std::uint32_t index) const { return bounds_[index]; }
  std::size_t size() const { return bounds_.size(); }

 private:
  std::vector<temporal::Duration> bounds_;
  std::unordered_map<std::int64_t, std::uint32_t> indices_;
};

/// Appends the code. Throws std::length_error for a step number of kMaxSteps or more.
void encode(const StepConstraint& constraint, temporal::Duration epsilon, BoundTable& bounds,
            std::vector<std::uint8_t>& code);

/// Appends all constraints of a code, which must come from encode() with the same table and ε.
void decode(std::span<const std::uint8_t> code, temporal::Duration epsilon, const BoundTable& bounds,
            std::vector<StepConstraint>& constraints);

}  // namespace roci::planner::temporal_pddl::constraints
