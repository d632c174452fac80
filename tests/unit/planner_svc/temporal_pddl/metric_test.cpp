// What a plan is judged by: time, numbers, both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using extraction::to_ipc;
using call::Options;
using task::Metric;
using temporal::Duration;
using temporal::Verdict;

Options improving(std::size_t evaluations = 3000) {
  Options options;
  options.improvement_evaluations = evaluations;
  return options;
}

// The metric as the validator reckons it.
double validated_metric(const testing::Model& model, const Result& result) {
  testing::expect_valid(model, result);
  const auto steps = pddl::parse_plan(to_ipc(*result.plan), "plan");
  return validate::validate(model.domain, model.problem, steps, {}, {}).metric.value();
}

testing::Model trip(const std::string& metric) {
  return testing::model(
      R"((:requirements :durative-actions :numeric-fluents)
    (:predicates (there) (greeted)) (:functions (total-cost) (tickets))
    (:durative-action fly :parameters () :duration (= ?duration 2)
      :condition () :effect (and (at end (there)) (at start (increase (total-cost) 100))))
    (:durative-action walk :parameters () :duration (= ?duration 30)
      :condition () :effect (and (at end (there)) (at end (increase (total-cost) (* 0.5 ?duration)))))
    (:durative-action greet :parameters () :duration (= ?duration 2)
      :condition () :effect (and (at end (greeted)) (at start (increase (total-cost) 1)))))",
      "(:init (= (total-cost) 7) (= (tickets) 2)) (:goal (and (there) (greeted)))" + metric);
}

TEST(Metric, DecidesBetweenFastAndCheap) {
  const struct {
    const char* metric;
    double best;
  } cases[] = {
      {"", 2},
      {"(:metric minimize (total-time))", 2},
      {"(:metric minimize (total-cost))", 7 + 15 + 1},
      {"(:metric minimize (+ (* 2 (total-time)) (total-cost)))", 60 + 23},
      {"(:metric minimize (+ (* 4 (total-time)) (/ (total-cost) (tickets))))", 8 + 54},
      {"(:metric maximize (- 1000 (total-cost)))", 1000 - 23},
  };
  for (const auto& [metric, best] : cases) {
    const auto made = trip(metric);
    const Result result = testing::solved(made, improving());
    ASSERT_TRUE(result.plan) << metric << result.reason;
    EXPECT_DOUBLE_EQ(result.plan->metric, best) << metric;
    if (*metric) {
      EXPECT_DOUBLE_EQ(validated_metric(made, result), best) << metric;
    }
  }
}

TEST(Metric, CostsDoNotKeepActionsApart) {
  const auto made = trip("(:metric minimize (+ (total-time) (total-cost)))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  for (const auto& activity : result.plan->activities) EXPECT_EQ(activity.start, Duration{0});
}

TEST(Metric, ARewardIsCollectedBeforeTheEnd) {
  const auto made = testing::model(R"((:requirements :durative-actions :numeric-fluents)
    (:predicates (home) (left ?x)) (:functions (reward) (worth ?x))
    (:durative-action collect :parameters (?x) :duration (= ?duration 1)
      :condition (at start (left ?x))
      :effect (and (at start (not (left ?x))) (at end (increase (reward) (worth ?x))))))",
                                   R"((:objects a b c)
    (:init (home) (left a) (left b) (left c) (= (reward) 0) (= (worth a) 5) (= (worth b) -2) (= (worth c) 4))
    (:goal (home)) (:metric maximize (reward)))");
  const Result result = testing::solved(made, improving());
  EXPECT_DOUBLE_EQ(validated_metric(made, result), 9);
}

TEST(Metric, MustBeLinear) {
  const auto made = testing::model(R"((:requirements :numeric-fluents) (:predicates (g)) (:functions (x) (y))
    (:action a :parameters () :precondition () :effect (and (g) (increase (x) 1) (increase (y) 1))))",
                                   "(:init (= (x) 0) (= (y) 0)) (:goal (g))\n(:metric minimize (* (x) (y)))");
  const Result result = testing::solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsupported);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("problem.pddl:3"));
  EXPECT_THAT(result.reason, ::testing::HasSubstr("not linear"));
}

// Ways through a random graph; every edge with a time and a price.
class RandomRoads {
 public:
  explicit RandomRoads(std::mt19937_64& random) {
    for (auto& row : time_) {
      for (auto& entry : row) entry = random() % 2 ? 1 + static_cast<int>(random() % 9) : 0;
    }
    for (auto& row : price_) {
      for (auto& entry : row) entry = static_cast<int>(random() % 9);
    }
    weight_ = static_cast<int>(random() % 4);
  }

  testing::Model model() const {
    std::string objects, init = "(at n0) (= (spent) 0)";
    for (int a = 0; a < kPlaces; ++a) {
      objects += " n" + std::to_string(a);
      for (int b = 0; b < kPlaces; ++b) {
        if (time_[a][b] == 0) continue;
        const std::string pair = " n" + std::to_string(a) + " n" + std::to_string(b) + ")";
        init += " (road" + pair + " (= (far" + pair + " " + std::to_string(time_[a][b]) + ") (= (price" +
                pair + " " + std::to_string(price_[a][b]) + ")";
      }
    }
    return testing::model(R"((:requirements :durative-actions :numeric-fluents)
      (:predicates (at ?p) (road ?a ?b)) (:functions (far ?a ?b) (price ?a ?b) (spent))
      (:durative-action drive :parameters (?a ?b) :duration (= ?duration (far ?a ?b))
        :condition (and (at start (at ?a)) (at start (road ?a ?b)))
        :effect (and (at start (not (at ?a))) (at end (at ?b)) (at start (increase (spent) (price ?a ?b))))))",
                          "(:objects" + objects + ") (:init " + init + ") (:goal (at n" +
                              std::to_string(kPlaces - 1) + ")) (:metric minimize (+ (spent) (* " +
                              std::to_string(weight_) + " (total-time))))");
  }

  // Price and weighted time of the best way, without ε; infinite if there is none.
  double best() const {
    std::vector<double> cost(kPlaces, std::numeric_limits<double>::infinity());
    cost[0] = 0;
    for (int round = 0; round < kPlaces; ++round) {
      for (int a = 0; a < kPlaces; ++a) {
        for (int b = 0; b < kPlaces; ++b) {
          if (time_[a][b] > 0) cost[b] = std::min(cost[b], cost[a] + price_[a][b] + weight_ * time_[a][b]);
        }
      }
    }
    return cost[kPlaces - 1];
  }

 private:
  static constexpr int kPlaces = 5;
  int time_[kPlaces][kPlaces];
  int price_[kPlaces][kPlaces];
  int weight_;
};

TEST(Metric, OfAnExhaustedSearchIsTheLeast) {
  std::mt19937_64 random(11);
  int found = 0;
  for (int round = 0; round < 40; ++round) {
    const RandomRoads roads(random);
    const auto made = roads.model();
    const Result result = testing::solved(made, improving(20'000));
    if (!result.plan) {
      EXPECT_EQ(roads.best(), std::numeric_limits<double>::infinity());
      continue;
    }
    ++found;
    EXPECT_NEAR(validated_metric(made, result), roads.best(), 0.05);
    EXPECT_NEAR(result.plan->metric, roads.best(), 0.05);
  }
  EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
