// The check before use (R78, R83): each fault alone, told with the part of the network that it lies in.
#include "planner_svc/utility_htn/model/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "tests/unit/planner_svc/utility_htn/random/random_network.hpp"

namespace roci::planner::utility_htn::model {
namespace {

using temporal::ImpactKind, temporal::ImpactWhen;
using temporal::seconds;
using temporal::timelines::Kind, temporal::timelines::Phase;
using testing::HasSubstr;

// Tasks: 0 dig (template), 1 heat (template), 2 site (parent of dig and heat), 3 load.
Network sound() {
  Network out;
  out.name = "sound";
  out.ranks = {"mission", "analysis"};
  out.batches = {"first"};
  out.parameters = {{"dig_s", 10, 1, 100, "chosen"}};
  out.timelines = {{"battery", Kind::cumulative_rate, {}, 100, 0, 100},
                   {"phase", Kind::state, {"landed", "sampling"}},
                   {"arm", Kind::atomic, {}, 0, 0, 1},
                   {"power", Kind::claimable, {}, 0, 0, 50},
                   {"bytes", Kind::cumulative, {}, 0, 0, 1000},
                   {"signature", Kind::state, {"unknown", "negative", "positive"}}};
  Task dig;
  dig.id = "dig";
  dig.is_template = true;
  dig.commands = {{"sim_svc", "", "arm", "dig", {}, temporal::no_bound}};
  dig.duration = {0, 0, 1};
  dig.impacts = {{0, ImpactKind::rate, ImpactWhen::during, {-1, {}, 1}},
                 {1, ImpactKind::assign, ImpactWhen::at_end, {1, {}, 1}},
                 {2, ImpactKind::delta, ImpactWhen::during, {1, {}, 1}},
                 {3, ImpactKind::delta, ImpactWhen::during, {20, {}, 1}},
                 {4, ImpactKind::delta, ImpactWhen::at_end, {30, {}, 1}}};
  dig.constraints = {{1, Phase::pre, -INFINITY, INFINITY, 1}, {0, Phase::pre, 5}};
  dig.contingency = Contingency{{1}, {3}};
  dig.utility = {{0, {}, 1}, {0.5, {}, 1}};
  dig.products = {{"image", Tier::mandatory, {5, {}, 1}, {0, 0.5}}};
  dig.learns = {{Measure::duration_s, 0}};
  Task heat;
  heat.id = "heat";
  heat.is_template = true;
  Task site;
  site.id = "site";
  site.decompositions = {
      {"way", {{1, Phase::pre, -INFINITY, INFINITY, 1}}, {{0}, {1, seconds(1), seconds(2)}}}};
  Task load;
  load.id = "load";
  load.fixed = true;
  load.preferred_start = seconds(5);
  out.tasks = {dig, heat, site, load};
  out.subway.sites = {{"site_0", {0.5, {}, 1}, {{2, 5, {0.5, {}, 1}}}}};
  out.cycle = {seconds(10), seconds(2), seconds(20), temporal::no_bound, seconds(1000)};
  return out;
}

std::string said(const Network& network) {
  std::string out;
  for (const Fault& fault : check(network))
    out += (fault.warning ? "warning: " : "") + to_text(fault, network) + "\n";
  return out;
}

TEST(NetworkCheck, ASoundNetworkHasNoFault) { EXPECT_EQ(said(sound()), ""); }

struct Case {
  std::function<void(Network&)> damage;
  std::string says;
};

TEST(NetworkCheck, TellsEachFault) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases{
      // the head
      {[](Network& n) { n.name = ""; }, "network '': the network's name is empty"},
      {[](Network& n) { n.ranks.clear(); }, "it has no ranks of utility"},
      {[](Network& n) { n.ranks[1] = "mission"; }, "rank 'mission' stands there twice"},
      {[](Network& n) { n.batches = {"a b"}; }, "batch 'a b' is no name"},
      {[](Network& n) {
         n.budget = 4;
         n.timelines[4].kind = Kind::claimable;
       },
       "its budget 'bytes' is of kind claimable"},
      {[](Network& n) { n.budget = 9; }, "its budget is no timeline"},
      {[](Network& n) { n.exploration_bound = 0; }, "exploration bound is 0"},
      // parameters
      {[](Network& n) { n.parameters[0].prior = 101; },
       "parameter 'dig_s': its value 101 is not within its range 1 .. 100"},
      {[](Network& n) { n.parameters[0].highest = INFINITY; }, "its range 1 .. none is none"},
      {[&](Network& n) { n.parameters[0].prior = nan; }, "is not within its range"},
      {[](Network& n) { n.parameters.push_back(n.parameters[0]); }, "the name is that of another parameter"},
      {[](Network& n) { n.parameters[0].source = "a\nb"; }, "its source holds control characters"},
      {[](Network& n) { n.parameters[0].source = std::string(kLongestText + 1, 'x'); },
       "is longer than 1000 bytes"},
      // timelines
      {[](Network& n) { n.timelines[4].name = "battery"; },
       "timeline 'battery': the name is that of another timeline"},
      {[](Network& n) { n.timelines[0].initial = 101; },
       "its initial value 101 is not within its range 0 .. 100"},
      {[](Network& n) { n.timelines[1].states.clear(); }, "it has no states"},
      {[](Network& n) { n.timelines[1].initial = 2; }, "its initial value is none of its states"},
      {[](Network& n) { n.timelines[1].states.assign(65, "s"); }, "65 states do not fit: at most 64"},
      {[](Network& n) { n.timelines[2].highest = 2; }, "it is atomic, and its range is not 0 .. 1"},
      {[](Network& n) { n.timelines[3].highest = INFINITY; }, "there is no end to what can be claimed"},
      {[](Network& n) { n.timelines[4].states = {"full"}; }, "it has states, and is of kind cumulative"},
      // impacts
      {[](Network& n) { n.tasks[0].impacts[0].timeline = 7; }, "an impact names timeline number 7 of 6"},
      {[](Network& n) { n.tasks[0].impacts[0].timeline = 4; },
       "only a timeline of kind cumulative_rate runs at a rate"},
      {[](Network& n) { n.tasks[0].impacts[1].amount.constant = 2; }, "impact on 'phase' is out of range: 2"},
      {[](Network& n) { n.tasks[0].impacts[1].kind = ImpactKind::delta; }, "a state is set, not counted"},
      {[](Network& n) { n.tasks[0].impacts[2].amount.constant = 2; }, "impact on 'arm' is out of range: 2"},
      {[](Network& n) { n.tasks[0].impacts[3].moment = ImpactWhen::at_end; }, "is taken while the task runs"},
      {[](Network& n) { n.tasks[0].impacts[3].amount.constant = 51; },
       "impact on 'power' is out of range: 51"},
      {[](Network& n) { n.tasks[0].impacts[4].amount.constant = -1001; },
       "impact on 'bytes' is out of range: 1001"},
      {[](Network& n) {
         n.tasks[0].impacts[4] = {4, ImpactKind::assign, ImpactWhen::at_end, {1001, {}, 1}};
       },
       "impact on 'bytes' is 1001, which is not within 0 .. 1000"},
      {[](Network& n) {
         n.tasks[0].impacts[4] = {4, ImpactKind::assign, ImpactWhen::during, {1, {}, 1}};
       },
       "a value is set at the start or at the end"},
      {[](Network& n) { n.tasks[0].impacts[0].amount.parameter = 3; }, "names parameter number 3 of 1"},
      // constraints
      {[](Network& n) { n.tasks[0].constraints[0].timeline = 99; },
       "a constraint names timeline number 99 of 6"},
      {[](Network& n) { n.tasks[0].constraints[0].lowest = 1; },
       "compares 'phase', which has named states, with a number"},
      {[](Network& n) { n.tasks[0].constraints[0].states = 4; },
       "permits no state of 'phase', or one that it does not have"},
      {[](Network& n) { n.tasks[0].constraints[1].states = 1; },
       "asks for a state of 'battery', whose values are numbers"},
      {[](Network& n) { n.tasks[0].constraints[1].highest = 4; }, "its lower bound is above the upper one"},
      {[](Network& n) { n.tasks[0].constraints[1].lowest = 101; }, "'battery >= 101' never holds"},
      // tasks
      {[](Network& n) { n.tasks[1].id = "dig"; }, "task 'dig': the id is that of another task"},
      {[](Network& n) { n.tasks[1].id = "di/g"; }, "the task's id 'di/g' is no name"},
      {[](Network& n) {
         n.tasks[0].duration = {-1, {}, 1};
       },
       "its duration in seconds is -1"},
      {[](Network& n) {
         n.tasks[0].duration = {-5, 0, 1};
       },
       "can leave 0 .. 1e+09, since the range of 'dig_s' is 1 .. 100"},
      {[](Network& n) { n.tasks[0].closes = seconds(9); }, "it does not fit into its window"},
      {[](Network& n) { n.tasks[3].preferred_start = temporal::no_bound; }, "it is fixed without a time"},
      {[](Network& n) { n.tasks[3].opens = seconds(6); }, "it would start at 5 s, outside of its window"},
      {[](Network& n) { n.tasks[0].batch = 1; }, "it is in a batch that is not there"},
      {[](Network& n) { n.tasks[0].utility[1].constant = 1.5; },
       "a score of its utility is 1.5, which is not within 0 .. 1"},
      {[](Network& n) { n.tasks[0].utility.resize(3); }, "it has more scores than there are ranks"},
      {[](Network& n) { n.tasks[0].products.push_back(n.tasks[0].products[0]); },
       "product 'image' stands there twice"},
      {[](Network& n) { n.tasks[0].products[0].bytes.constant = -1; }, "the size of 'image' in bytes is -1"},
      {[](Network& n) { n.tasks[0].products[0].utility = {2}; }, "a score of product 'image' is 2"},
      {[](Network& n) { n.tasks[0].learns[0].parameter = 1; }, "it learns a parameter that is not there"},
      {[](Network& n) {
         n.tasks[0].learns = {{Measure::value, 0, ""}};
       },
       "result is empty; give it a name"},
      {[](Network& n) {
         n.tasks[0].learns = {{Measure::value, 0, "a value"}};
       },
       "result 'a value' is no name"},
      {[](Network& n) {
         n.tasks[0].commands.clear();
         n.tasks[0].learns = {{Measure::energy, 0}};
       },
       "warning: task 'dig': it learns from the results of commands and has none"},
      {[](Network& n) { n.tasks[0].contingency->requests = {2}; },
       "on failure it requests 'site', which is requested already"},
      {[](Network& n) { n.tasks[0].contingency->withdraws = {1}; },
       "on failure it withdraws 'heat', which is a template"},
      {[](Network& n) { n.tasks[0].commands[0].owner = ""; }, "a command's owner is empty"},
      {[](Network& n) { n.tasks[0].control.wait_timeout = seconds(-1); }, "it waits for -1 s"},
      // the hierarchy
      {[](Network& n) { n.tasks[2].decompositions[0].subtasks.clear(); },
       "task 'site': decomposition 'way' is empty"},
      {[](Network& n) { n.tasks[2].decompositions[0].subtasks[1].task = 2; },
       "it is a part of itself: 'site' holds 'site'"},
      {[](Network& n) { n.tasks[2].decompositions[0].subtasks[1].task = 8; }, "names task number 8 of 4"},
      {[](Network& n) { n.tasks[2].decompositions[0].subtasks[1].longest_gap = seconds(0); },
       "the gap before 'heat' in decomposition 'way' is none"},
      {[](Network& n) { n.tasks[2].decompositions[0].subtasks[0].shortest_gap = seconds(1); },
       "the first subtask 'dig'"},
      {[](Network& n) { n.tasks[2].decompositions.push_back(n.tasks[2].decompositions[0]); },
       "decomposition 'way' stands there twice"},
      {[](Network& n) { n.tasks[2].duration.constant = 5; }, "it has decompositions, and duration"},
      {[](Network& n) {
         for (int level = 0; level < 17; ++level) {
           n.tasks.push_back(n.tasks[2]);
           n.tasks.back().id = "level_" + std::to_string(level);
           n.tasks.back().decompositions[0].subtasks = {
               {level == 0 ? 2U : static_cast<TaskIndex>(n.tasks.size() - 2)}};
         }
       },
       "it stands on 17 levels of subtasks"},
      {[](Network& n) {
         n.tasks[2].decompositions.resize(20, n.tasks[2].decompositions[0]);
         for (std::size_t i = 0; i < 20; ++i) n.tasks[2].decompositions[i].name = "way" + std::to_string(i);
         n.tasks.push_back(n.tasks[2]);
         n.tasks.back().id = "many";
         n.tasks.back().decompositions.resize(1);
         n.tasks.back().decompositions[0].subtasks.assign(4, {2});  // 20^4
       },
       "it can be done in more than 100000 ways"},
      // rules of the mission
      {[](Network& n) { n.cycle.process_interval = seconds(2); }, "a cycle takes up to 2 s"},
      {[](Network& n) { n.cycle.commit_window = seconds(9); },
       "its commit window of 9 s is shorter than the process interval of 10 s"},
      {[](Network& n) { n.cycle.scheduling_window = seconds(20); },
       "its scheduling window of 20 s ends with the commit window"},
      {[](Network& n) { n.cycle.worst_cycle = seconds(0); }, "its worst cycle is not above 0"},
      {[](Network& n) { n.subway.rank = 2; }, "enforced at a rank that is not there"},
      {[](Network& n) { n.subway.sites[0].targets[0].signature = 1; },
       "site 'site_0': the signature 'phase' does not have the states"},
      {[](Network& n) { n.subway.sites[0].targets[0].task = 0; }, "a target's task 'dig' is a template"},
      {[](Network& n) { n.subway.sites[0].value.constant = 2; }, "its value is 2"},
      // memory
      {[](Network& n) { n.tasks[0].impacts.resize(kMostInList + 1, n.tasks[0].impacts[0]); },
       "1001 impacts do not fit: at most 1000"},
      {[](Network& n) { n.tasks.resize(kMostTasks + 1, n.tasks[3]); },
       "20001 tasks do not fit: at most 20000"},
      // what can hardly be meant
      {[](Network& n) {
         n.tasks[2].decompositions[0].subtasks.resize(1);
         n.tasks[0].contingency.reset();
       },
       "warning: task 'heat': the template is never used"},
      {[](Network& n) { n.tasks[0].is_template = false; },
       "warning: task 'dig': it is requested by itself, and a subtask of others besides"},
  };
  for (const Case& c : cases) {
    Network network = sound();
    c.damage(network);
    EXPECT_THAT(said(network), HasSubstr(c.says));
    EXPECT_EQ(usable(check(network)), c.says.starts_with("warning")) << c.says;
  }
}

TEST(NetworkCheck, TellsAllFaultsAtOnce) {
  Network network = sound();
  network.parameters[0].prior = 0;
  network.tasks[0].batch = 1;
  network.cycle.commit_window = seconds(1);
  EXPECT_EQ(check(network).size(), 3U);
}

TEST(NetworkCheck, RandomNetworksAreUsable) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    const Network network = random_network(random);
    ASSERT_TRUE(usable(check(network))) << "round " << round << ":\n" << said(network);
  }
}

}  // namespace
}  // namespace roci::planner::utility_htn::model
