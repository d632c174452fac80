// The list of dead-end detectors that stands beside the heuristics.
#include <gtest/gtest.h>

#include <string>

#include "planner_svc/temporal_pddl/dead_ends/dead_end_detector.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using dead_ends::DeadEndDetector;
using dead_ends::DeadEndDetectors;
using task::ActionCompression;

// Writes down what it is asked and told.
class Fake final : public DeadEndDetector {
 public:
  Fake(std::string name, bool proves, std::string& log)
      : name_(std::move(name)), proves_(proves), log_(log) {}

  bool proves_dead_end(task::StateView, std::span<const task::ActionId>,
                       ActionCompression compression) override {
    log_ += name_ + (compression == ActionCompression::always ? "!" : "?");
    return proves_;
  }
  void note_evaluation() override { log_ += name_ + "+"; }
  std::size_t bytes() const override { return name_.size() * 100; }

 private:
  std::string name_;
  bool proves_;
  std::string& log_;
};

TEST(DeadEndDetectors, ProveNothingWithoutAny) {
  DeadEndDetectors none;
  none.note_evaluation();
  EXPECT_FALSE(none.prove_dead_end({}, {}, ActionCompression::always));
  EXPECT_EQ(none.bytes(), 0u);
}

TEST(DeadEndDetectors, AreAskedInTheirOrderUntilOneProvesIt) {
  std::string log;
  Fake first("a", false, log), second("b", true, log), third("c", true, log);
  DeadEndDetectors detectors;
  detectors.add(first);
  detectors.add(second);
  detectors.add(third);
  EXPECT_TRUE(detectors.prove_dead_end({}, {}, ActionCompression::where_safe));
  EXPECT_EQ(log, "a?b?");
}

TEST(DeadEndDetectors, AllAreToldOfEvaluationsAndCounted) {
  std::string log;
  Fake first("a", true, log), second("bc", true, log);
  DeadEndDetectors detectors;
  detectors.add(first);
  detectors.add(second);
  detectors.note_evaluation();
  EXPECT_EQ(log, "a+bc+");
  EXPECT_EQ(detectors.bytes(), 300u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
