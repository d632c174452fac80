#include "core/pddl/forbidden.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

using ::testing::HasSubstr;

std::string forbidden(const std::string& section, const std::string& init = "") {
  std::string text;
  for (const Diagnostic& found : forbidden_effects(domain_with(section), problem_with(init))) {
    text += to_string(found) + "\n";
  }
  return text;
}

std::string durative(const std::string& duration, const std::string& effect) {
  return "(:durative-action burn :parameters (?t - thing ?l - place) :duration " + duration + " :effect " +
         effect + ")";
}

TEST(Forbidden, ContinuousEffects) {
  EXPECT_THAT(forbidden(durative("(= ?duration 3)", "\n(decrease (f) (* #t 2))")),
              HasSubstr("d.pddl:8:1: error: action 'burn' has a continuous effect on (f)"));
}

TEST(Forbidden, NonLinearEffects) {
  const std::string changes_g = "(:action other :effect (assign (g hammer) 1))";
  EXPECT_THAT(forbidden(changes_g + "(:action a :effect (increase (f) (* (g hammer) (f))))"),
              HasSubstr("action 'a' has a non-linear effect on (f)"));
  EXPECT_THAT(forbidden(changes_g + "(:action a :effect (increase (f) (/ 1 (g hammer))))"),
              HasSubstr("non-linear"));
  EXPECT_THAT(forbidden(changes_g + "(:action a :effect (scale-up (f) (g hammer)))"),
              HasSubstr("non-linear"));
  EXPECT_THAT(forbidden(changes_g + durative("(= ?duration 1)", "(at end (increase (f) (* (g ?t) (g ?t))))")),
              HasSubstr("action 'burn' has a non-linear"));
  EXPECT_THAT(forbidden("(:action a :effect (increase (f) (* (g hammer) (f))))", "(at 3 (= (g hammer) 2))"),
              HasSubstr("non-linear"))
      << "timed facts change fluents too";
}

TEST(Forbidden, NotWhatIsLinearInWhatChanges) {
  EXPECT_EQ(forbidden("(:action a :effect (increase (f) (* (g hammer) (f))))"), "") << "g never changes";
  EXPECT_EQ(forbidden("(:action a :effect (increase (f) (/ (f) (cost hammer base))))"), "");
  EXPECT_EQ(forbidden("(:action a :effect (and (scale-up (f) 2) (assign (f) (- (f) (* 2 (f))))))"), "");
}

TEST(Forbidden, DurationDependentEffectsUnlessFixed) {
  EXPECT_THAT(forbidden(durative("(<= ?duration 3)", "(at end (increase (f) ?duration))")),
              HasSubstr("duration-dependent effect on (f)"));
  EXPECT_THAT(forbidden(durative("(at end (= ?duration (f)))", "(at end (increase (f) (* 2 ?duration)))")),
              HasSubstr("duration-dependent"));
  EXPECT_EQ(
      forbidden(durative("(= ?duration (/ (f) (g ?t)))", "(at end (increase (f) (* ?duration (g ?t))))")), "")
      << "Rovers Metric Time has this (R1)";
}

}  // namespace
}  // namespace roci::pddl
