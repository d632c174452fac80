// Plans that the search makes pass the checker; one change to them, and it tells what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "planner_svc/timeline_htn/checking/check.hpp"
#include "tests/unit/planner_svc/timeline_htn/checking/plans.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/texts.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/windows.hpp"

namespace roci::planner::timeline_htn::checking {
namespace {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::seconds, temporal::Token;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

PlanActivity& activity(FlexiblePlan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan.activities, name, &PlanActivity::name);
  if (found == plan.activities.end()) throw std::runtime_error("the plan has no activity " + name);
  return *found;
}
Token& token(FlexiblePlan& plan, const std::string& timeline, const std::string& value) {
  const auto found = std::ranges::find_if(plan.tokens, [&](const Token& one) {
    return one.timeline == timeline && temporal::to_text(one.held) == value;
  });
  if (found == plan.tokens.end()) throw std::runtime_error("the plan has no " + value);
  return *found;
}
temporal::State& held(Token& token) { return std::get<temporal::State>(token.held); }

/// Is a model with the plan for it.
class Checked {
 public:
  explicit Checked(model::Model model) : model_(std::move(model)), plan_(plan_for(model_)) {}

  std::vector<std::string> faults() const { return checking::faults(model_, plan_); }
  std::vector<std::string> after(const std::function<void(FlexiblePlan&)>& harm) const {
    FlexiblePlan plan = plan_;
    harm(plan);
    return checking::faults(model_, plan);
  }
  std::vector<std::string> under(const std::function<void(model::Model&)>& harm) const {
    model::Model model = model_;
    harm(model);
    return checking::faults(model, plan_);
  }

 private:
  model::Model model_;
  FlexiblePlan plan_;
};

const Checked& greenhouse() {
  static const Checked out(load("tests/missions/greenhouse/problem.yaml"));
  return out;
}

model::Behaviour& behaviour(model::Model& model, const std::string& name) {
  return *std::ranges::find(model.behaviours, name, &model::Behaviour::name);
}

TEST(TimelineChecker, AcceptsThePlanOfTheSearch) { EXPECT_THAT(greenhouse().faults(), IsEmpty()); }

TEST(TimelineChecker, RefusesTimelinesThatAreNone) {
  const auto& plan = greenhouse();
  EXPECT_THAT(plan.after([](auto& p) { std::swap(p.tokens[0].held, p.tokens[1].held); }),
              Contains(HasSubstr("it begins with")));
  EXPECT_THAT(plan.after([](auto& p) { std::swap(p.tokens[0], p.tokens[1]); }),
              Contains(HasSubstr("and not at the origin")));
  EXPECT_THAT(plan.after([](auto& p) { std::erase(p.tokens, token(p, "arm", "pouring(basil, row_a)")); }),
              Contains(HasSubstr("there is a gap")));
  EXPECT_THAT(plan.after([](auto& p) { held(token(p, "base", "at(well)")).arguments = {"row_b"}; }),
              Contains(HasSubstr(
                  "timeline base: no transition leads from base.driving(dock, well) to base.at(row_b)")));
  EXPECT_THAT(plan.after([](auto& p) {
    held(token(p, "base", "driving(dock, well)")).arguments = {"dock", "row_b"};
  }),
              Contains(HasSubstr("there is no state base.driving(dock, row_b)")));
  EXPECT_THAT(plan.after([](auto& p) {
    held(token(p, "base", "at(well)")) = {"stuck", {"well"}};
  }),
              Contains(HasSubstr("the error state base.stuck(well) is planned")));
  EXPECT_THAT(plan.after([](auto& p) { token(p, "base", "at(well)").held = true; }),
              Contains(HasSubstr("timeline base holds true, which is no state")));
  EXPECT_THAT(plan.after([](auto& p) { token(p, "base", "at(well)").timeline = "bass"; }),
              Contains(HasSubstr("timeline bass")));
  EXPECT_THAT(
      plan.after([](auto& p) { std::erase_if(p.tokens, [](auto& t) { return t.timeline == "tank"; }); }),
      Contains(HasSubstr("timeline tank: the plan does not have it")));
  EXPECT_THAT(plan.under([](auto& m) { m.problem->horizon += seconds(1); }),
              Contains(HasSubstr("not at the horizon, 1201 s")));
}

TEST(TimelineChecker, RefusesActivitiesThatAreNotTheModels) {
  const auto& plan = greenhouse();
  EXPECT_THAT(plan.after([](auto& p) { activity(p, "tank.filling").name = "tank.fill"; }),
              Contains(HasSubstr("'tank.fill', is neither a state nor a behaviour")));
  EXPECT_THAT(plan.after([](auto& p) { activity(p, "tank.filling").level = "abstract"; }),
              Contains(HasSubstr("stands on level 'abstract', not on 'primitive'")));
  EXPECT_THAT(
      plan.after([](auto& p) { activity(p, "tank.filling").command_name = "empty"; }),
      Contains(HasSubstr("its command, empty of sim_svc, is not that of its state, fill of sim_svc")));
  EXPECT_THAT(
      plan.after([](auto& p) { activity(p, "base.driving(dock, well)").arguments[0].value = "row_a"; }),
      Contains(HasSubstr("the arguments of its command are not those of its state")));
  EXPECT_THAT(plan.after([](auto& p) {
    activity(p, "tank.draining").owner = "sim_svc", activity(p, "tank.draining").command_name = "drain";
  }),
              Contains(HasSubstr("its state has no command")));
  EXPECT_THAT(plan.after([](auto& p) {
    activity(p, "base.driving(well, row_a)").name = "base.driving(row_a, well)";
  }),
              Contains(HasSubstr("base.driving(row_a, well) (activity")));
  EXPECT_THAT(plan.after([](auto& p) {
    std::erase(p.activities, PlanActivity(activity(p, "base.driving(row_b, row_a)")));
  }),
              Contains(HasSubstr(
                  "timeline base holds base.driving(row_b, row_a), and no activity of the plan is it")));
  EXPECT_THAT(plan.after([](auto& p) { activity(p, "tank.draining").goals_served = {"x/y"}; }),
              Contains(HasSubstr("serves 'x/y', and the problem has no such goal")));
}

TEST(TimelineChecker, RefusesDurationsThatAStateDoesNotHave) {
  const auto& plan = greenhouse();
  const auto network_without = [](FlexiblePlan& p, const PlanActivity& of) {
    std::erase_if(p.constraints, [&](const auto& c) {
      return (c.from_point == of.start_point || c.to_point == of.start_point) && c.lower > seconds(0);
    });
  };
  EXPECT_THAT(
      plan.after([&](auto& p) {
        PlanActivity& pouring = activity(p, "arm.pouring(basil, row_a)");
        pouring.duration_lower = seconds(19);
        network_without(p, pouring);
      }),
      Contains(HasSubstr(
          "timeline arm holds arm.pouring(basil, row_a) for 20 s to 1020 s, and it lasts 20 s to 30 s")));
  EXPECT_THAT(
      plan.under([](auto& m) {
        for (auto& component : m.components)
          for (auto& state : component.states)
            if (state.name == "filling") state.longest[0].constant = 50;
      }),
      Contains(HasSubstr("timeline tank holds tank.filling for 40 s to 60 s, and it lasts 40 s to 50 s")));
}

TEST(TimelineChecker, RefusesNeedsThatEndEarly) {
  const auto& plan = greenhouse();
  // The arm is to be folded while the base drives: it begins to pour before the base has come.
  EXPECT_THAT(
      plan.under([](auto& m) {
        auto& needs = m.components[1].states[1].needs;
        needs[0].state = {0, 0, {}};
      }),
      Contains(HasSubstr(
          "base.driving(dock, well) needs during care.idle, and no value of that timeline is always so")));
  EXPECT_THAT(plan.under([](auto& m) { m.components[1].states[1].needs[0].kind = model::NeedKind::met_by; }),
              Contains(HasSubstr("needs met_by arm.folded")));
  // Without what joins the two timelines the schedule decides.
  EXPECT_THAT(plan.after([](auto& p) {
    const Token& filling = token(p, "tank", "filling");
    const Token& at = token(p, "base", "at(well)");
    std::erase_if(p.constraints, [&](const auto& c) {
      return (c.from_point == filling.end_point && c.to_point == at.end_point) ||
             (c.to_point == filling.end_point && c.from_point == at.end_point);
    });
  }),
              Contains(HasSubstr("tank.filling needs during base.at(well)")));
}

TEST(TimelineChecker, RefusesDecompositionsThatAreNoBehaviours) {
  const auto& plan = greenhouse();
  EXPECT_THAT(plan.after([](auto& p) { activity(p, "tank.draining").parent = ""; }),
              Contains(HasSubstr(
                  "care.tending(basil) (activity a0) is decomposed by no behaviour; behaviour 'water': its "
                  "subgoal 'drain', tank.draining is not among the parts")));
  EXPECT_THAT(plan.after([](auto& p) { activity(p, "care.tending(mint)").name = "care.tending(basil)"; }),
              Contains(HasSubstr("does not stand on the timeline care")));
  EXPECT_THAT(
      plan.under([](auto& m) { behaviour(m, "water").where[0].negated = true; }),
      Contains(HasSubstr("behaviour 'water': the 1. of its tests ('where') does not hold for plant = basil, "
                         "place = row_a")));
  EXPECT_THAT(plan.under([](auto& m) {
    auto& water = behaviour(m, "water");
    water.constraints.push_back({{1, true}, {2, false}, {{model::Operator::constant, 0, 0, {}}}, {}});
  }),
              Contains(HasSubstr("the network does not imply its")));
  EXPECT_THAT(plan.under([](auto& m) {
    const auto seconds = [](double number) {
      return model::Expression{{model::Operator::constant, number, 0, {}}};
    };
    behaviour(m, "water").constraints.push_back({{1, true}, {2, false}, seconds(-5e12), {}});
  }),
              Contains(HasSubstr("the network does not imply its")))
      << "the search has no such behaviour, either";
  EXPECT_THAT(plan.under([](auto& m) { m.behaviours.erase(m.behaviours.begin()); }),
              Contains(HasSubstr("no behaviour achieves it")));
  EXPECT_THAT(plan.after([](auto& p) {
    activity(p, "care.tending(mint)").parent = activity(p, "care.tending(basil)").id;
  }),
              testing::Not(IsEmpty()));
}

TEST(TimelineChecker, ExecutesConditionsAndStatesToRestIn) {
  const auto& plan = greenhouse();
  EXPECT_THAT(plan.under([](auto& m) {
    auto& water = behaviour(m, "water");
    water.conditions.push_back({{3, 2, {}}, false});  // the tank is full at the start
  }),
              Contains(HasSubstr("behaviour 'water' asks for tank.full at its start")));
  // 'go' stands on the timeline alone; it cannot last from before the drive to the place on.
  EXPECT_THAT(plan.under([](auto& m) {
    auto& water = behaviour(m, "water");
    water.constraints.push_back({{{}, false}, {0, false}, {}, {{model::Operator::constant, 0, 0, {}}}});
  }),
              Contains(HasSubstr("a state to rest in that behaviour 'water' asks for does not hold")));
}

TEST(TimelineChecker, RefusesGoalsThatAreMissed) {
  const auto& plan = greenhouse();
  const auto goal = [&](const std::function<void(model::Goal&)>& harm, std::size_t which) {
    return plan.under([&](auto& m) { harm(m.problem->goals[which]); });
  };
  EXPECT_THAT(goal([](auto& g) { g.closes = seconds(70); }, 1),
              Contains(HasSubstr("goal 'mint_watered', care.tending(mint), is not reached")));
  EXPECT_THAT(goal([](auto& g) { g.opens = seconds(1); }, 0), Contains(HasSubstr("goal 'basil_watered'")));
  EXPECT_THAT(
      goal([](auto& g) { g.release = seconds(1); }, 0),
      Contains(HasSubstr("serves 'basil_watered' and may start before 1 s, when that goal is released")));
  EXPECT_THAT(goal([](auto& g) { g.after = {1}; }, 0), Contains(HasSubstr("goal 'basil_watered'")));
  EXPECT_THAT(goal([](auto& g) { g.state.terms[0].index = 1; }, 2),
              Contains(HasSubstr("goal 'home', base.at(well)")));
  EXPECT_THAT(plan.after([](auto& p) {  // nothing holds the mint within its window any more
    std::erase_if(p.constraints, [&](const auto& c) { return c.from_point == 0 && c.upper == seconds(900); });
  }),
              Contains(HasSubstr("goal 'mint_watered'")));
}

// What is predicted stands in the plan as it is known, and what needs it lies inside.
TEST(TimelineChecker, RefusesPlansThatChangeWhatIsPredicted) {
  const Checked plan(parse(reading::kWindows));
  EXPECT_THAT(plan.faults(), IsEmpty());
  const auto fixed_at = [](FlexiblePlan& p, const Token& token) -> temporal::TemporalConstraint& {
    return *std::ranges::find_if(p.constraints, [&](const auto& one) {
      return one.from_point == 0 && one.to_point == token.start_point && one.lower == one.upper;
    });
  };
  const auto nth = [](FlexiblePlan& p, int index) -> Token& {
    for (Token& one : p.tokens)
      if (one.timeline == "ground" && index-- == 0) return one;
    throw std::runtime_error("no such value");
  };
  EXPECT_THAT(
      plan.after([&](auto& p) { fixed_at(p, nth(p, 1)).lower = seconds(90); }),
      Contains(HasSubstr("timeline ground: ground.seen is predicted from 100 s on, and in the plan it "
                         "comes at 90 s to 100 s")));
  EXPECT_THAT(
      plan.after([&](auto& p) {
        auto& one = fixed_at(p, nth(p, 3));
        one.lower = one.upper = seconds(590);
      }),
      Contains(HasSubstr("ground.seen is predicted from 600 s on, and in the plan it comes at 590 s")));
  EXPECT_THAT(plan.after([&](auto& p) { held(nth(p, 2)).name = "seen"; }),
              Contains(HasSubstr("ground.hidden is predicted from 130 s on, and the plan has ground.seen")));
  EXPECT_THAT(plan.after([&](auto& p) {
    nth(p, 4).end_point = nth(p, 5).end_point;
    std::erase(p.tokens, Token(nth(p, 5)));
  }),
              Contains(HasSubstr("ground.seen is predicted from 2000 s on, and the plan has nothing there")));
  EXPECT_THAT(plan.under([](auto& m) { m.problem->predicted.back()->pop_back(); }),
              Contains(HasSubstr("timeline ground: the plan has ground.seen, which nothing predicts")));
  EXPECT_THAT(plan.under([](auto& m) { m.problem->predicted.back()->at(3).at = seconds(660); }),
              Contains(HasSubstr("ground.hidden is predicted from 660 s on")));
  // The sending that leaves its window by a second.
  EXPECT_THAT(plan.after([&](auto& p) {
    const auto start = activity(p, "antenna.sending(first)").start_point;
    std::erase_if(p.constraints, [&](const auto& one) {
      return std::set{one.from_point, one.to_point} == std::set{start, nth(p, 3).start_point};
    });
  }),
              Contains(HasSubstr("antenna.sending(first) needs during ground.seen")));
}

TEST(TimelineChecker, RefusesConditionsOutsideOfWhatIsPredicted) {
  const std::string asks = reading::with(
      reading::with(reading::kWindows, ", needs: [during ground.seen]", ""),
      "achieves: mission.telling(what), ", "achieves: mission.telling(what), conditions: [ground.seen], ");
  const Checked plan(parse(asks));
  EXPECT_THAT(plan.faults(), IsEmpty());
  EXPECT_THAT(plan.under([](auto& m) { m.behaviours.front().conditions.front().negated = true; }),
              Contains(HasSubstr("behaviour 'tell' asks for not ground.seen")));
}

TEST(TimelineChecker, WantsWhatIsTriggered) {
  model::Model stuck = load("tests/missions/greenhouse/problem.yaml");
  stuck.problem->initial[1]->state = 2;
  const Checked plan(stuck);
  EXPECT_THAT(plan.faults(), IsEmpty());
  EXPECT_THAT(plan.after([](auto& p) {
    const std::string id = activity(p, "free_the_base").id;
    for (auto& one : p.activities)
      if (one.parent == id) one.parent = "";
    std::erase(p.activities, PlanActivity(activity(p, "free_the_base")));
  }),
              Contains(HasSubstr("the plan begins in base.stuck(dock), and none of the behaviours")));
  EXPECT_THAT(plan.under([](auto& m) {
    behaviour(m, "free_the_base").subgoals[0].state.terms[0] = {1, true};
  }),
              Contains(HasSubstr("its subgoal 'back_off', base.backing_off(well) is not among the parts")));
}

const Checked& with_decisions() {
  static const Checked out(parse(reading::kSound));
  return out;
}

// The arm is lifted on the way to the goal: also that waits for the radio, and a plan in which it may not is refused.
TEST(TimelineChecker, WantsStepsTowardsGoalsToFollowWhatMends) {
  const Checked plan(
      parse("domain: d\ncomponents:\n"
            "  radio:\n    layer: primitive\n    states: {fine: {kind: default}, broken: {kind: error}, "
            "reset: {kind: simple, "
            "duration_s: 60}}\n    transitions: [broken -> reset, reset -> fine]\n"
            "  arm:\n    layer: primitive\n    states: {folded: {kind: default}, lift: {kind: simple, "
            "duration_s: 5}, up: "
            "{kind: default}, dig: {kind: simple, duration_s: 5}}\n"
            "    transitions: [folded -> lift, lift -> up, up -> dig, dig -> folded]\n"
            "behaviours:\n  mend: {triggers: [radio.broken], subgoals: {reset: radio.reset}}\n"
            "problem:\n  horizon_s: 500\n  initial: {radio: broken, arm: folded}\n  goals: {g: arm.dig}\n"));
  EXPECT_THAT(plan.faults(), IsEmpty());
  EXPECT_THAT(plan.after([](auto& p) {
    const auto ended = activity(p, "mend").end_point, started = activity(p, "arm.lift").start_point;
    std::erase_if(p.constraints, [&](const auto& one) {
      return std::minmax(one.from_point, one.to_point) == std::minmax(ended, started);
    });
  }),
              Contains(HasSubstr("arm.lift (activity a3) may start before mend (activity a0) has ended")));
}

// What is needed of a timeline that is observed is waited for, whatever object a free name stands for.
TEST(TimelineChecker, WantsActivitiesToWaitForWhatTheyNeed) {
  const auto made = [](const std::string& need) {
    return Checked(
        parse("domain: d\ntypes: [place]\nobjects: {place: [a, b]}\ncomponents:\n"
              "  base:\n    layer: primitive\n    states:\n"
              "      at: {kind: default, parameters: {p: place, q: place}, observed: {timeline: nav, value: "
              "\"parked(p, q)\"}}\n"
              "      drive: {kind: simple, parameters: {p: place}, duration_s: 5, observed: {timeline: nav, "
              "value: driving}}\n"
              "    transitions: [\"at(x, y) -> drive(y)\", \"drive(x) -> at(x, x)\"]\n"
              "  sky:\n    layer: primitive\n    states:\n      dark: {kind: default, observed: {timeline: "
              "sun, value: false}}\n"
              "      light: {kind: default, observed: {timeline: sun, value: true}}\n    transitions: [dark "
              "-> light]\n"
              "  arm:\n    layer: primitive\n    states:\n      folded: {kind: default}\n"
              "      dig: {kind: simple, duration_s: 5, command: {owner: o, component: c, command: d}, "
              "needs: [\"during " +
              need +
              "\", at_start sky.light]}\n    transitions: [folded <-> dig]\n"
              "problem:\n  horizon_s: 500\n  initial: {base: \"at(a, b)\", sky: dark, arm: folded}\n"
              "  goals: {d: base.drive(b), g: {state: arm.dig, after: [d]}}\n"));
  };
  const Checked any = made("base.at(x, y)"), half = made("base.at(x, b)");
  EXPECT_THAT(any.faults(), IsEmpty());
  EXPECT_THAT(half.faults(), IsEmpty());
  any.after([](auto& p) {
    EXPECT_EQ(temporal::describe(activity(p, "arm.dig").maintenance), "nav = parked");
    EXPECT_EQ(temporal::describe(activity(p, "arm.dig").pre), "nav = parked and sun = true");
  });
  half.after([](auto& p) {
    EXPECT_EQ(temporal::describe(activity(p, "arm.dig").maintenance),
              "nav = parked(a, b) or nav = parked(b, b)");
  });
  EXPECT_THAT(any.after([](auto& p) { activity(p, "arm.dig").maintenance = {}; }),
              Contains(HasSubstr("does not wait for what it needs of base: it permits base.drive(b)")));
  EXPECT_THAT(any.after([](auto& p) {
    activity(p, "arm.dig").pre =
        temporal::compare("nav", temporal::ConditionOp::eq, temporal::state("parked", {"a", "a"}));
  }),
              Contains(HasSubstr("is false in base.at(b, b), which meets its need")));
}

// R131. The porter may hand a crate over in place of setting it down, and the plan for two crates goes on behind the
// first choice alone: where the other one is taken for the second crate, what is seen stays as it was after the first.
TEST(TimelineChecker, KnowsWhatADecisionLeavesAsItWasFromWhatItBringsAbout) {
  std::ifstream in(ROCI_SOURCE_DIR "/tests/missions/porter/porter.yaml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto edit = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  edit("    constraints: [lift before put]\n",
       "      crane: gripper.handing_over(crate)\n"
       "    constraints: [lift before put, lift before crane]\n"
       "    decisions:\n      how: {resolver: ground, before: put.start, choices: {floor: {subgoals: put}, "
       "crane: {subgoals: crane}}}\n");
  edit("    transitions:\n      - \"empty -> lifting",
       "      handing_over: {kind: simple, parameters: {crate: crate}, duration_s: [5, 60]}\n"
       "    transitions:\n      - \"holding(x) -> handing_over(x)\"\n      - \"handing_over(x) -> empty\"\n"
       "      - \"empty -> lifting");
  edit("initial: {errand: idle}", "initial: {errand: idle, base: at(dock), gripper: empty}");
  edit("goals: {}", "goals: {red: errand.fetched(red), blue: {state: errand.fetched(blue), after: [red]}}");
  const Checked plan(parse(text));
  EXPECT_THAT(plan.faults(), IsEmpty());
  const auto leaves = [](auto& p, const std::string& name) -> temporal::Value& {
    auto& impacts = activity(p, name).impacts;
    return std::ranges::find(impacts, temporal::ImpactWhen::at_end, &temporal::Impact::moment)->amount;
  };
  EXPECT_THAT(plan.after([&](auto& p) {
    EXPECT_EQ(temporal::to_text(leaves(p, "errand.fetching(red)")), "idle");
    EXPECT_EQ(temporal::to_text(leaves(p, "errand.fetching(blue)")), "fetched(red)");
  }),
              IsEmpty());
  EXPECT_THAT(
      plan.after([&](auto& p) { leaves(p, "errand.fetching(blue)") = temporal::state("fetched", {"blue"}); }),
      Contains(HasSubstr("whatever is decided, errand.fetching(blue) ends with errand.fetched(blue)")));
}

TEST(TimelineChecker, HoldsDecisionsAgainstThoseOfTheBehaviour) {
  const auto& plan = with_decisions();
  EXPECT_THAT(plan.faults(), IsEmpty());
  const auto decision = [&](const std::string& name,
                            const std::function<void(temporal::DecisionPoint&)>& harm) {
    return plan.after([&](auto& p) {
      for (auto& one : p.decisions)
        if (one.id.ends_with("." + name)) harm(one);
    });
  };
  EXPECT_THAT(
      plan.after(
          [](auto& p) { std::erase_if(p.decisions, [](const auto& d) { return d.id.ends_with(".how"); }); }),
      Contains(HasSubstr("antenna.send(status) (activity a4) does not stand on the timeline antenna")))
      << "of no choice, so it would be planned on";
  EXPECT_THAT(decision("how", [](auto& d) { d.choices[0].name = "c"; }),
              Contains(HasSubstr("choice 'c' is not 'a' of the behaviour")));
  EXPECT_THAT(decision("how", [](auto& d) { d.choices[0].rule = {}; }),
              Contains(HasSubstr("or has another rule")));
  EXPECT_THAT(decision("how", [](auto& d) { d.choices[0].activities.clear(); }),
              Contains(HasSubstr("choice 'a' lacks the activity of subgoal 'tell'")));
  EXPECT_THAT(decision("how", [](auto& d) { d.id = "nobody.how"; }),
              Contains(HasSubstr("is of no activity")));
  EXPECT_THAT(decision("how", [](auto& d) { d.resolver_kind = temporal::ResolverKind::ground; }),
              Contains(HasSubstr("it is asked of somebody else")));
  EXPECT_THAT(plan.after([](auto& p) {
    for (auto& one : p.decisions) one.decide_before = p.activities[0].end_point;
  }),
              Contains(HasSubstr("it need not be made before the point that the behaviour names")));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::checking
