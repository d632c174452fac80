// A course is the value of a timeline at any time, added up anew from all impacts for every question.
#pragma once

#include <vector>

#include "planner_svc/utility_htn/checking/question.hpp"

namespace roci::planner::utility_htn::checking {

/// Says which value at an instant is meant: before everything, after what ends and before what starts, or
/// after everything.
enum class Moment { before, between, after };

temporal::Time end_of(const Question& question, const Step& step);

/// Gives the value of one timeline over time.
class Course {
 public:
  /// Looks at the steps of the plan, or at the committed ones alone.
  Course(const Question& question, temporal::timelines::Index timeline, bool committed_only);

  double value(temporal::Time at, Moment moment) const;
  /// Returns the times at which something changes, in order, each once.
  const std::vector<temporal::Time>& changes() const { return changes_; }

 private:
  void add(const Question& question, temporal::timelines::Index timeline, const Step& step);

  struct Change {
    temporal::Time at{0};
    bool starts = false;  // what ends at an instant acts before what starts
    temporal::ImpactKind kind = temporal::ImpactKind::delta;
    std::uint64_t step = 0;
    double amount = 0;
    bool late = false;  // the newest observation does not know of it
  };

  double initial_ = 0;
  temporal::Time anchor_{0};
  bool observed_ = false;
  std::vector<Change> all_;
  std::vector<temporal::Time> changes_;
};

}  // namespace roci::planner::utility_htn::checking
