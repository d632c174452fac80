// What no plan can come to: never said where there is a plan, and said with its reason.
#include "planner_svc/timeline_htn/search/relaxed_reachability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/unit/planner_svc/timeline_htn/search/oracle.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/random_problem.hpp"

namespace roci::planner::timeline_htn::search {
namespace {

using testing::HasSubstr;

std::optional<NeverReached> never(const model::Model& model) {
  return never_reached(model, ~std::size_t{0}, [] { return false; });
}

// Brute force knows no conditions; with them the search is the judge, in all its passes.
TEST(RelaxedReachability, IsNeverWrongWhereBruteForceOrTheSearchFindsAPlan) {
  int proved = 0, solvable = 0;
  for (std::uint64_t seed = 0; seed < 900; ++seed) {
    const bool with_conditions = seed % 3 != 0;
    const std::string text = RandomProblem(seed, with_conditions).text();
    mission::Findings findings;
    const auto model = reading::parse_model({{"random", text}}, findings);
    if (!model) continue;
    const auto proof = never(*model);
    proved += proof ? 1 : 0;
    if (!with_conditions && (proof || seed % 9 == 0)) {
      const bool there_is_one = Oracle(*model, proof ? 6 : 4).solvable();
      ASSERT_FALSE(proof && there_is_one) << "seed " << seed << "\n" << text << proof->reason;
    }
    Search search(*model, {});
    search.prove_by_search_alone();
    const bool found = search.run(20'000, 0, [] { return false; }) == Outcome::solved;
    ASSERT_FALSE(proof && found) << "seed " << seed << "\n" << text << proof->reason;
    solvable += found ? 1 : 0;
  }
  EXPECT_GT(proved, 60);
  EXPECT_GT(solvable, 200);
}

// Where an error is mended first, the goals begin from where that leaves the timelines. So many seeds hold one at least
// in which a plan depends on each of: a timeline that stays where it began, parts that no order makes the last one, a
// state to rest in that is left at once, and one that ended just as the mending did.
TEST(RelaxedReachability, IsNeverWrongBehindWhatMendsAnError) {
  int proved = 0, solvable = 0;
  for (std::uint64_t seed = 0; seed < 1800; ++seed) {
    const std::string text = RandomProblem::with_error(seed).text();
    mission::Findings findings;
    const auto model = reading::parse_model({{"random", text}}, findings);
    if (!model) continue;
    const auto proof = never(*model);
    Search search(*model, {});
    search.prove_by_search_alone();
    const bool found = search.run(5'000, 0, [] { return false; }) == Outcome::solved;
    ASSERT_FALSE(proof && found) << "seed " << seed << "\n" << text << proof->reason;
    proved += proof ? 1 : 0;
    solvable += found ? 1 : 0;
  }
  EXPECT_GT(proved, 60);
  EXPECT_GT(solvable, 200);
}

const std::string kRover = R"yaml(domain: d
types: [place]
objects: {place: [a, b, c]}
relations: {leg: {arguments: [place, place], rows: [[b, c]]}}
components:
  mission:
    layer: abstract
    states:
      idle: {kind: default}
      visiting: {kind: complex, parameters: {to: place}}
      visited: {kind: default, parameters: {to: place}}
    transitions: ["idle -> visiting(x)", "visiting(x) -> visited(x)", "visited(x) -> visiting(y)"]
  wheels:
    layer: primitive
    states:
      at: {kind: default, parameters: {place: place}}
      driving: {kind: simple, parameters: {from: place, to: place}, duration_s: 10}
      stuck: {kind: error, parameters: {place: place}}
    transitions: ["at(x) -> driving(x, y)", "driving(x, y) -> at(y)", "stuck(x) -> at(x)"]
  sun:
    layer: primitive
    states: {down: {kind: default}, up: {kind: default}}
    transitions: [up -> down]
  camera:
    layer: primitive
    states: {off: {kind: default}, imaging: {kind: simple, duration_s: 5, needs: [during sun.up]}}
    transitions: [off <-> imaging]
behaviours:
  drive:
    achieves: mission.visiting(to)
    variables: {from: place}
    where: ["leg(from, to)"]
    conditions: ["wheels.at(from)"]
    subgoals: {go: "wheels.driving(from, to)"}
  free: {triggers: ["wheels.stuck(x)"], subgoals: {stand: "wheels.at(x)"}}
)yaml";

std::string problem(const std::string& wheels, const std::string& goal) {
  return "problem:\n  horizon_s: 900\n  initial: {mission: idle, wheels: " + wheels +
         ", sun: down, camera: off}\n  goals: {other: \"wheels.at(a)\", g: \"" + goal + "\"}\n";
}

// The only leg begins where the wheels are not, and nothing that can be begun asks for them to move.
TEST(RelaxedReachability, NamesTheConditionThatIsNeverMet) {
  for (const char* wheels : {"at(a)", "stuck(a)"}) {
    const auto out = never(model_of({kRover, problem(wheels, "mission.visited(c)")}));
    ASSERT_TRUE(out) << wheels;
    EXPECT_EQ(out->goal, 1U);
    EXPECT_THAT(out->reason, HasSubstr("behaviour 'drive' for mission.visiting(c) asks for wheels.at(b), and "
                                       "that timeline comes to wheels."));
  }
  EXPECT_FALSE(never(model_of({kRover, problem("at(b)", "mission.visited(c)")})));
  const std::string moved =
      with(problem("at(a)", "mission.visited(c)"), "wheels.at(a)", "wheels.driving(a, b)");
  EXPECT_FALSE(never(model_of({kRover, moved}))) << "the other goal takes the wheels there";
}

TEST(RelaxedReachability, NamesTheNeedAndTheTransitionThatAreMissing) {
  EXPECT_EQ(never(model_of({kRover, problem("at(a)", "camera.imaging")}))->reason,
            "camera.imaging needs sun.up, and that timeline comes to sun.down alone");
  EXPECT_EQ(never(model_of({kRover, problem("at(a)", "sun.up")}))->reason,
            "no transitions lead to sun.up, and that timeline comes to sun.down alone");
}

TEST(RelaxedReachability, GivesUpWhereItIsToldTo) {
  const model::Model model = model_of({kRover, problem("at(a)", "mission.visited(c)")});
  EXPECT_FALSE(never_reached(model, 0, [] { return false; }));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::search
