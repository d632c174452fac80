// The fixpoint of h² relates pairs of literals; it looks at all operators of a task again and again until
// none relates two more.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/fdr_operators.hpp"
#include "planner_svc/temporal_pddl/dead_ends/pair_matrix.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Returns whether to go on; it is asked every few microseconds, with the number of words of bits that were
/// examined since.
using H2WorkLimit = std::function<bool(std::size_t work)>;

/// Holds the pairs related so far; they only ever become more.
class H2Fixpoint {
 public:
  explicit H2Fixpoint(std::size_t literals) : matrix_(literals), singles_(literals), changed_(literals, 0) {}

  const PairMatrix& matrix() const { return matrix_; }
  /// Returns the literals that are related to themselves.
  const Bits& singles() const { return singles_; }
  void relate(Literal literal, const Bits& others) {
    work_ += matrix_.row_words();
    matrix_.add(literal, others.words(), [&](std::size_t other) {
      changed_[literal] = changed_[other] = now_;
      if (other != literal) return;
      singles_.set(other);
      single_found_ = now_;
    });
  }
  /// Counts rows that were looked at elsewhere.
  void count(std::size_t rows) { work_ += rows * matrix_.row_words(); }

  /// Calls visit(step) for all operators, and again when reads(step, is_new) asks about a literal that has
  /// been related to another since, or about kNoLiteral and one has become single. Returns false if `go_on`
  /// has stopped it.
  template <typename Reads, typename Visit>
  bool close(const FdrOperators& steps, const Reads& reads, const Visit& visit, const H2WorkLimit& go_on) {
    std::vector<std::uint32_t> visited(steps.size(), 0);  // when
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const FdrOperator step = steps[i];
        const auto is_new = [&](Literal literal) {
          return (literal == kNoLiteral ? single_found_ : changed_[literal]) >= visited[i];
        };
        if (visited[i] != 0 && !reads(step, is_new)) continue;
        changed = true;
        visited[i] = ++now_;
        visit(step);
        if (!go_on(std::exchange(work_, 0))) return false;
      }
    }
    return true;
  }
  std::size_t bytes() const { return matrix_.bytes(); }

 private:
  PairMatrix matrix_;
  Bits singles_;
  std::vector<std::uint32_t> changed_;  // by literal: when
  std::uint32_t single_found_ = 0;
  std::uint32_t now_ = 0;
  std::size_t work_ = 0;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
