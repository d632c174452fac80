// The problems of the two rovers (missions/faster): each is planned with the behaviour that the paper
// names, and passes the checker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/temporal/network_distances.hpp"
#include "planner_svc/timeline_htn/checking/check.hpp"
#include "tests/unit/planner_svc/timeline_htn/checking/plans.hpp"

namespace roci::planner::timeline_htn::checking {
namespace {

using model::Index, temporal::FlexiblePlan, temporal::PlanActivity;
using testing::Contains;
using testing::IsEmpty;

std::vector<std::string> names(const FlexiblePlan& plan) {
  std::vector<std::string> out;
  for (const PlanActivity& activity : plan.activities) out.push_back(activity.name);
  return out;
}

std::size_t count(const FlexiblePlan& plan, const std::string& beginning) {
  return static_cast<std::size_t>(std::ranges::count_if(
      plan.activities, [&](const PlanActivity& activity) { return activity.name.starts_with(beginning); }));
}

FlexiblePlan checked_plan(const std::string& problem) {
  const model::Model model = load("missions/faster/" + problem + ".yaml");
  FlexiblePlan plan = plan_for(model);
  EXPECT_THAT(faults(model, plan), IsEmpty()) << problem;
  return plan;
}

// R147, R148: the two goals, five planned timelines, a cycle of a traverse as a team for each
// way between two way-points.
TEST(FasterModel, TheTrialIsPlannedAsACycleForEachWay) {
  const FlexiblePlan plan = checked_plan("problem");
  EXPECT_EQ(count(plan, "navigation.team_cycle("), 9U);
  EXPECT_EQ(count(plan, "scout_locomotion.traversing_with_ss("), 9U);
  EXPECT_EQ(count(plan, "primary_locomotion.following("), 9U);
  EXPECT_EQ(count(plan, "antenna.downlinking(traverse_done)"), 1U);
  EXPECT_EQ(plan.decisions.size(), 10U) << "the route, and in each cycle whether the primary follows";
  std::set<std::string> owners;
  for (const PlanActivity& activity : plan.activities)
    if (!activity.owner.empty()) owners.insert(activity.owner);
  EXPECT_EQ(owners, (std::set<std::string>{"communications", "primary.locomotion", "primary.path_planning",
                                           "scout.locomotion", "scout.path_planning"}));
}

// R139: in one cycle, whatever the durations.
TEST(FasterModel, TheStepsOfACycleFollowEachOtherAndItsDecisionIsOpen) {
  const FlexiblePlan plan = checked_plan("problem");
  const temporal::NetworkDistances network(plan.point_count, all_constraints(plan));
  const auto first = [&](const std::string& beginning) {
    return *std::ranges::find_if(plan.activities,
                                 [&](const auto& activity) { return activity.name.starts_with(beginning); });
  };
  const std::vector<std::string> steps{"primary_path.selecting",
                                       "primary_path.localising",
                                       "antenna.telling_place",
                                       "scout_locomotion.turning",
                                       "scout_path.imaging",
                                       "antenna.fetching_map",
                                       "primary_path.merging",
                                       "primary_path.planning",
                                       "antenna.telling_path",
                                       "scout_path.planning",
                                       "scout_locomotion.traversing_with_ss",
                                       "primary_locomotion.following"};
  for (std::size_t i = 1; i < steps.size(); ++i)
    EXPECT_TRUE(network.implies(first(steps[i - 1]).end_point, first(steps[i]).start_point,
                                temporal::Duration{0}, temporal::no_bound))
        << steps[i - 1] << " before " << steps[i];
  EXPECT_TRUE(network.same_time(first("scout_locomotion.turning").start_point,
                                first("primary_locomotion.turning").start_point));
  const auto& decision = plan.decisions.back();
  ASSERT_EQ(decision.choices.size(), 2U);
  EXPECT_EQ(decision.choices[0].name, "follow");
  EXPECT_EQ(decision.choices[1].name, "bring_back");
}

TEST(FasterModel, ALostScoutLeavesThePrimaryToTraverseAlone) {
  const FlexiblePlan plan = checked_plan("scout_lost");
  EXPECT_EQ(count(plan, "navigation.cycle_alone("), 8U);
  EXPECT_EQ(count(plan, "scout_locomotion."), 0U);
}

TEST(FasterModel, EachTriggerBringsTheScoutBackAndANewCycleFollows) {
  for (const auto& [problem, behaviour, cycles] :
       std::vector<std::tuple<std::string, std::string, std::size_t>>{
           {"scout_no_path", "bring_back_without_path", 9},
           {"primary_blocked", "bring_back_to_blocked", 9},
           {"goal_change", "bring_back_for_new_goals", 2}}) {
    const FlexiblePlan plan = checked_plan(problem);
    EXPECT_THAT(names(plan), Contains(behaviour));
    EXPECT_EQ(count(plan, "scout.coming_back("), 1U) << problem;
    EXPECT_EQ(count(plan, "navigation.team_cycle("), cycles) << problem;
  }
}

TEST(FasterModel, WithoutAPathBothWaitForTheGroundAndReport) {
  const FlexiblePlan plan = checked_plan("no_path");
  EXPECT_THAT(names(plan), Contains("report_no_path"));
  EXPECT_THAT(names(plan), Contains("antenna.downlinking(no_global_path)"));
  EXPECT_EQ(count(plan, "primary_locomotion.") + count(plan, "scout_locomotion."), 0U);
}

// With the windows as they are predicted the traverse is planned so that its end leaves time for the one that is next.
TEST(FasterModel, TheLastCommunicationIsPlannedInAWindowOfTheGround) {
  const FlexiblePlan plan = checked_plan("ground_windows");
  const temporal::NetworkDistances network(plan.point_count, all_constraints(plan));
  const auto downlink =
      std::ranges::find(plan.activities, "antenna.downlinking(traverse_done)", &PlanActivity::name);
  ASSERT_NE(downlink, plan.activities.end());
  EXPECT_EQ(network.between(0, downlink->start_point).lower, temporal::seconds(3600));
  EXPECT_EQ(network.between(0, downlink->end_point).upper, temporal::seconds(5400));
  EXPECT_EQ(count(plan, "navigation.team_cycle("), 9U);
}

TEST(FasterModel, AMarkerThatIsNotSeenAndAHazardAreMendedFirst) {
  EXPECT_THAT(names(checked_plan("marker_not_seen")), Contains("scout_locomotion.positioning(w0)"));
  EXPECT_THAT(names(checked_plan("hazard_detected")), Contains("avoid_hazard"));
}

Index object(const model::Model& model, const std::string& name) {
  return static_cast<Index>(std::ranges::find(model.objects, name, &model::Object::name) -
                            model.objects.begin());
}

// Sets where a component begins; `place` where its state has one.
void begin_with(model::Model& model, const std::string& component, const std::string& state,
                const std::string& place) {
  const auto index = [](const auto& list, const auto& name, auto member) {
    return static_cast<Index>(std::ranges::find(list, name, member) - list.begin());
  };
  const Index c = index(model.components, component, &model::Component::name);
  model::Pattern& initial = *model.problem->initial[c];
  initial.state = index(model.components[c].states, state, &model::State::name);
  initial.terms.clear();
  if (!model.components[c].states[initial.state].parameters.empty())
    initial.terms.push_back({object(model, place), true});
}

// What mends an error asks for the other rover in its place; in trouble are sometimes both, and the goals have changed
// as well. There is a plan all the same, with the last communication in it.
TEST(FasterModel, WhateverErrorsMeetThereIsAPlan) {
  using Begin = std::pair<const char*, const char*>;
  const model::Model trial = load("missions/faster/problem.yaml");
  for (const char* path : {"ready", "marker_not_seen", "no_path"})
    for (const char* primary : {"at", "blocked"})
      for (const char* scout_path : {"ready", "no_path"})
        for (const auto& [scout, place] :
             {Begin{"at", "w3"}, Begin{"at", "w4"}, Begin{"hazard_detected", "w4"},
              Begin{"drive_interrupted", "w4"}, Begin{"lost", ""}})
          for (const bool changed : {false, true}) {
            if (changed && path == std::string("no_path")) continue;  // takes its time
            model::Model model = trial;
            begin_with(model, "primary_path", path, "w3");
            begin_with(model, "primary_locomotion", primary, "w3");
            begin_with(model, "scout_path", scout_path, *place ? place : "w4");
            begin_with(model, "scout_locomotion", scout, place);
            model.problem->goals_changed = changed;
            model.problem->goals[0].state.terms = {{object(model, "w5"), true}};
            const std::string where = std::string(path) + ' ' + primary + ' ' + scout_path + ' ' + scout +
                                      ' ' + place + (changed ? " changed" : "");
            search::Search search(model, {});
            ASSERT_EQ(search.run(200'000, 0, [] { return false; }), search::Outcome::solved)
                << where << ": " << search.reason();
            const FlexiblePlan plan = extraction::plan_of(search, {"p1", "a", temporal::Time{0}});
            EXPECT_THAT(faults(model, plan), IsEmpty()) << where;
            EXPECT_GE(count(plan, "antenna.downlinking("), 1U) << where;
          }
}

// No hazard is known, and the scout is brought back all the same: the next cycle begins beside the primary.
TEST(FasterModel, AScoutWhoseDriveWasInterruptedIsBroughtBack) {
  const FlexiblePlan plan = checked_plan("drive_interrupted");
  EXPECT_EQ(count(plan, "bring_back_interrupted"), 1U);
  EXPECT_EQ(count(plan, "avoid_hazard"), 0U);
  EXPECT_EQ(count(plan, "scout.coming_back(w1, w0)"), 1U);
  EXPECT_EQ(count(plan, "navigation.team_cycle("), 9U);
}

// R131: where several ways lead on it stays open which way-point comes next; once one was chosen its way is planned, and
// nothing is asked there.
TEST(FasterModel, AGuidedTraverseLeavesOpenWhichWayPointComesNext) {
  model::Model model = load("missions/faster/problem.yaml");
  model.problem->goals.resize(1);
  const auto& states = model.components[model.problem->goals[0].state.component].states;
  model.problem->goals[0].state.state =
      static_cast<Index>(std::ranges::find(states, "traversed_guided", &model::State::name) - states.begin());
  const auto open = [](const FlexiblePlan& plan) {
    std::vector<std::string> out;
    for (const auto& decision : plan.decisions) {
      if (!decision.id.ends_with(".next")) continue;
      out.emplace_back();
      for (const auto& choice : decision.choices) out.back() += choice.name + " ";
    }
    return out;
  };
  const FlexiblePlan first = plan_for(model);
  EXPECT_THAT(faults(model, first), IsEmpty());
  EXPECT_THAT(open(first), testing::ElementsAre("w1 v1 u1 ", "w4 n4 "));
  for (const char* component : {"primary_locomotion", "scout_locomotion"})
    begin_with(model, component, "at", "w3");
  begin_with(model, "scout", "bound_for", "n4");
  const FlexiblePlan chosen = plan_for(model);
  EXPECT_THAT(faults(model, chosen), IsEmpty());
  EXPECT_THAT(open(chosen), IsEmpty());
  EXPECT_EQ(count(chosen, "navigation.team_cycle(w3, n4)"), 1U);
  EXPECT_EQ(count(chosen, "navigation.team_cycle("), 6U);
}

// A goal was given up since what mends an error failed again and again: the goals that are left are planned without it.
TEST(FasterModel, WhatMendsNothingIsNotTriedForTheGoalsThatAreLeft) {
  for (const auto& [problem, left] :
       std::vector<std::pair<std::string, std::string>>{{"marker_not_seen", "not_seen_all_the_same"},
                                                        {"hazard_detected", "hazard_all_the_same"},
                                                        {"drive_interrupted", "interrupted_all_the_same"},
                                                        {"primary_blocked", "blocked_all_the_same"},
                                                        {"scout_no_path", "without_path_all_the_same"},
                                                        {"goal_change", "new_goals_all_the_same"}}) {
    for (const bool trusted : {true, false}) {
      model::Model model = load("missions/faster/" + problem + ".yaml");
      std::erase_if(model.problem->goals, [](const auto& goal) { return goal.id != "last_communication"; });
      for (model::Goal& goal : model.problem->goals) goal.after.clear();
      if (!trusted)
        std::ranges::find(model.relations, "distrusted", &model::Relation::name)->rows = {
            {object(model, "scout_locomotion")}};
      const FlexiblePlan plan = plan_for(model);
      EXPECT_THAT(faults(model, plan), IsEmpty()) << problem;
      EXPECT_EQ(count(plan, left), trusted ? 0U : 1U) << problem;
      EXPECT_EQ(count(plan, "antenna.downlinking("), 1U) << problem;
    }
  }
}

// It has found no way back to where the primary is, nor behind it: it is not called again, and the primary goes on.
TEST(FasterModel, AScoutWithoutAWayBackIsLeftWhereItIs) {
  for (const auto& [problem, primary] : std::vector<std::pair<std::string, std::string>>{
           {"hazard_detected", "w0"}, {"primary_blocked", "w0"}, {"goal_change", "w1"}}) {
    model::Model model = load("missions/faster/" + problem + ".yaml");
    std::ranges::find(model.relations, "stand_taken", &model::Relation::name)
        ->rows.push_back({object(model, primary)});
    const FlexiblePlan plan = plan_for(model);
    EXPECT_THAT(faults(model, plan), IsEmpty()) << problem;
    EXPECT_EQ(count(plan, "scout.coming_back("), 0U) << problem;
    EXPECT_GE(count(plan, "navigation.cycle_alone("), 1U) << problem;
    EXPECT_EQ(count(plan, "antenna.downlinking(traverse_done)"), 1U) << problem;
  }
}

// Where legs are closed, no route is begun that comes to one of them: behind the south way's last stand the team goes
// all the way back and along the edge.
TEST(FasterModel, ClosedLegsAreGoneRoundWithoutASearch) {
  const auto plan = [](const std::vector<std::pair<std::string, std::string>>& legs) {
    model::Model model = load("missions/faster/problem.yaml");
    const auto object = [&](const std::string& name) {
      return static_cast<Index>(std::ranges::find(model.objects, name, &model::Object::name) -
                                model.objects.begin());
    };
    for (const std::string component : {"primary_locomotion", "scout_locomotion"}) {
      const auto found = std::ranges::find(model.components, component, &model::Component::name);
      model.problem->initial[static_cast<std::size_t>(found - model.components.begin())]->terms[0].index =
          object("v6");
    }
    auto& closed = std::ranges::find(model.relations, "closed", &model::Relation::name)->rows;
    for (const auto& [from, to] : legs) closed.push_back({object(from), object(to)});
    std::ranges::sort(closed);
    auto search = std::make_unique<search::Search>(model, search::Resolver{});
    const search::Outcome outcome = search->run(100'000, 0, [] { return false; });
    EXPECT_LT(search->count().evaluated, 3000U);
    return outcome;
  };
  EXPECT_EQ(plan({}), search::Outcome::solved);
  EXPECT_EQ(plan({{"v6", "w5"}, {"w2", "w3"}, {"u3", "u4"}}), search::Outcome::solved);
}

// All legs are closed but one far off, at which routes begin: nothing takes the rovers there, which is proved and said.
TEST(FasterModel, WhereTheOnlyLegLeftIsFarOffThatIsProved) {
  for (const std::string problem :
       {"problem", "scout_lost", "hazard_detected", "scout_no_path", "primary_blocked"}) {
    model::Model model = load("missions/faster/" + problem + ".yaml");
    auto& legs = std::ranges::find(model.relations, "leg", &model::Relation::name)->rows;
    const auto far = [&](const std::vector<Index>& row) {
      return model.objects[row[0]].name == "right_on" && model.objects[row[1]].name == "w8";
    };
    std::erase_if(legs, [&](const auto& row) { return !far(row); });
    ASSERT_EQ(legs.size(), 1U);
    search::Search search(model, search::Resolver{});
    ASSERT_EQ(search.run(100'000, 64U << 20U, [] { return false; }), search::Outcome::exhausted) << problem;
    EXPECT_THAT(search.reason(),
                testing::HasSubstr("for mission.traversing(w9) asks for primary_locomotion.at(w8), and that "
                                   "timeline comes to primary_locomotion.at("))
        << problem;
    ASSERT_LT(search.blocking_goal(), model.problem->goals.size()) << problem;
    EXPECT_EQ(model.problem->goals[search.blocking_goal()].id, "long_traverse") << problem;
  }
}

// R138: each of them missing, the traverse as a team does not apply.
TEST(FasterModel, ATraverseAsATeamNeedsFormationAndTheUplink) {
  const auto planned = [](const std::string& component, const std::string& state) {
    model::Model model = load("missions/faster/problem.yaml");
    const auto c = static_cast<std::size_t>(
        std::ranges::find(model.components, component, &model::Component::name) - model.components.begin());
    model::Pattern& initial = *model.problem->initial[c];
    const auto& states = model.components[c].states;
    initial.state =
        static_cast<model::Index>(std::ranges::find(states, state, &model::State::name) - states.begin());
    if (state == "at") initial.terms[0].index += 2;  // w1
    search::Search search(model, {});
    return search.run(100'000, 0, [] { return false; });
  };
  EXPECT_EQ(planned("uplink", "complete"), search::Outcome::solved);
  EXPECT_NE(planned("uplink", "missing"), search::Outcome::solved);
  EXPECT_NE(planned("scout_locomotion", "at"), search::Outcome::solved);
}

// R128, E5: a target comes with the request for it; where it lies is for the executive to say.
TEST(FasterModel, AFindIsInspectedBeforeTheTeamGoesOn) {
  model::Model model = load("missions/faster/problem.yaml");
  const auto index = [](const auto& list, const auto& name, auto member) {
    return static_cast<Index>(std::ranges::find(list, name, member) - list.begin());
  };
  const Index science = index(model.components, "science", &model::Component::name);
  const Index inspected = index(model.components[science].states, "inspected", &model::State::name);
  model.objects.push_back({"odd", index(model.types, "target", std::identity{})});
  model.problem->goals.push_back(
      {"find",
       {science, inspected, {{static_cast<Index>(model.objects.size() - 1), true}}},
       {},
       temporal::no_bound,
       {}});
  const FlexiblePlan plan = plan_for(model);
  EXPECT_THAT(faults(model, plan), IsEmpty());
  const auto first = [&](const std::string& beginning) {
    return *std::ranges::find_if(plan.activities,
                                 [&](const auto& activity) { return activity.name.starts_with(beginning); });
  };
  const PlanActivity imaging = first("primary_path.imaging(odd)");
  EXPECT_THAT(imaging.arguments,
              testing::ElementsAre(temporal::Property{"target", "odd"}, temporal::Property{"x", "odd.x"},
                                   temporal::Property{"y", "odd.y"}));
  const temporal::NetworkDistances network(plan.point_count, all_constraints(plan));
  EXPECT_TRUE(network.consistent());
  for (const char* after : {"primary_path.localising", "primary_locomotion.turning"})
    EXPECT_TRUE(network.implies(imaging.end_point, first(after).start_point, temporal::Duration{0},
                                temporal::no_bound))
        << after;
  EXPECT_EQ(count(plan, "navigation.team_cycle("), 9U);
}

// R140: way-points form a graph, neighbours at most 4 m apart.
TEST(FasterModel, WayPointsLieAtMostFourMetresApart) {
  const model::Model model = load("missions/faster/problem.yaml");
  const model::NumberTable& metres = model.numbers[0];
  for (const auto& [row, length] : metres.rows)
    EXPECT_LE(length, 4.0) << model.objects[row[0]].name << " to " << model.objects[row[1]].name;
  EXPECT_EQ(metres.rows.size(), 82U) << "41 ways, in both directions";
}

}  // namespace
}  // namespace roci::planner::timeline_htn::checking
