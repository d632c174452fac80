// Landmark orderings say which landmarks come before which, without cycles.
//
// The relation is kept closed under transitivity, as bits by row and by column: a pair that follows from what
// is known costs nothing to add, and each new pair costs one row and one column (Italiano 1986), so that n
// landmarks take n³ / 64 words' work at most.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Collects orderings of the given landmarks and never lets them form a cycle.
class LandmarkOrderings {
 public:
  LandmarkOrderings(const task::Task& task, const RelaxedTask& relaxed,
                    const task::IdVector<LandmarkId, Landmark>& landmarks);

  /// Adds an ordering; does nothing if `later` comes before `earlier` already.
  void add(LandmarkId earlier, LandmarkId later);
  /// Adds the reasonable orderings, after all others: among goals, and among what must hold right before
  /// another landmark and what else must come before that, first comes what would undo the other.
  void add_reasonable();
  /// Returns the landmarks that come before `later` with no other in between (the transitive reduction: Aho,
  /// Garey and Ullman 1972); what comes before these follows.
  std::vector<LandmarkId> just_before(LandmarkId later) const;

 private:
  // Is a square of bits.
  class Bits {
   public:
    explicit Bits(std::size_t size) : words_((size + 63) / 64), bits_(size * words_) {}
    bool get(std::size_t row, std::size_t bit) const {
      return bits_[row * words_ + bit / 64] >> bit % 64 & 1;
    }
    /// Adds the bits of another square's row and one more to a row.
    void add(std::size_t row, const std::uint64_t* others, std::size_t bit) {
      for (std::size_t i = 0; i < words_; ++i) bits_[row * words_ + i] |= others[i];
      bits_[row * words_ + bit / 64] |= std::uint64_t{1} << bit % 64;
    }
    /// Returns whether a row has a bit in common with that of another square.
    bool meets(std::size_t row, const std::uint64_t* other) const {
      for (std::size_t i = 0; i < words_; ++i) {
        if (bits_[row * words_ + i] & other[i]) return true;
      }
      return false;
    }
    std::size_t words() const { return words_; }  ///< of a row
    const std::uint64_t* row(std::size_t row) const { return bits_.data() + row * words_; }
    /// Visits the bits of a row that another row has not, in ascending order.
    template <typename Visit>
    void each_beside(std::size_t row, const std::uint64_t* other, Visit visit) const {
      for (std::size_t i = 0; i < words_; ++i) {
        for (std::uint64_t word = bits_[row * words_ + i] & ~other[i]; word != 0; word &= word - 1)
          visit(64 * i + static_cast<std::size_t>(std::countr_zero(word)));
      }
    }

   private:
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
  };

  // Returns whether `held` has to be undone to reach `wanted`.
  bool undone_for(LandmarkId held, LandmarkId wanted) const;
  bool mutex(PropositionId a, PropositionId b) const;
  bool undoes(task::SnapId op, PropositionId held) const;

  const task::Task& task_;
  const RelaxedTask& relaxed_;
  const task::IdVector<LandmarkId, Landmark>& landmarks_;
  Bits rows_;     // by landmark: those that come after it; closed under transitivity
  Bits columns_;  // by landmark: those that come before it
  std::vector<std::size_t> earlier_, later_;  // within add(): which rows and columns change
  task::IdVector<LandmarkId, std::vector<LandmarkId>> right_before_;  // by landmark
  task::IdVector<task::FactId, std::uint32_t> variable_;  // of the packed state; facts.size(): none
};

}  // namespace roci::planner::temporal_pddl::heuristics
