#include "tests/scenario/europa_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::AllOf, ::testing::DoubleNear, ::testing::Each, ::testing::Ge, ::testing::IsEmpty,
    ::testing::Le, ::testing::Not;

using Words = std::vector<std::string>;

// What communication may take (rsm1.yaml), by the power that the network foresees. Limits bind plans: how long sending
// takes varies with the noise of the rate, which no plan knows.
constexpr double kDownlinkW = 120, kSolS = 86400, kTolerance = 1.05;
struct CommunicationLimits {
  double session_j = 1'000'000, sol_j = 1'500'000;
};

// Targets of each site by their looks (rsm1.yaml); how warm and cold each zone may be (mission.yaml).
const std::map<char, std::string> kByLooks{{'0', "201"}, {'1', "012"}, {'2', "120"}};
const std::map<std::string, std::pair<double, double>> kRanges{
    {"lander.heat.arm", {110, 330}}, {"lander.heat.vault", {240, 350}}, {"lander.heat.antenna", {120, 400}}};
const Words kAllInOrder{"1 0", "1 1", "1 2", "0 2", "0 0", "0 1", "2 1", "2 2", "2 0"};

std::vector<double> numbers(const Words& words) {
  std::vector<double> out;
  for (const std::string& word : words) out.push_back(std::stod(word));
  return out;
}

CommunicationLimits limits_of(const std::string& scenario, double at_s) {
  if (scenario == "comm_energy_35") return {.sol_j = 35 * CommunicationLimits{}.sol_j};
  if (scenario == "slow_downlink" && at_s >= *hears_the_ground_at(scenario)) return {10'000'000, 15'000'000};
  return {};
}

// The session during which the ground changes the limits counts by the new ones, and so does its sol.
void check_communication(const std::string& scenario, const std::filesystem::path& run_folder) {
  std::map<int, double> sols;
  for (const Session& session : sessions(run_folder)) {
    const double joules = (session.to_s - session.from_s) * kDownlinkW;
    EXPECT_LE(joules, kTolerance * limits_of(scenario, session.to_s).session_j)
        << "the session that begins at " << session.from_s << " s";
    sols[static_cast<int>(session.from_s / kSolS)] += joules;
  }
  EXPECT_FALSE(sols.empty()) << "nothing was sent";
  for (const auto& [sol, joules] : sols)
    EXPECT_LE(joules, kTolerance * limits_of(scenario, (sol + 1) * kSolS).sol_j) << "sol " << sol;
}

// From its record alone each cycle comes out as it was flown, and every schedule of downlinks is right for the independent
// checker.
void check_record(const std::filesystem::path& run_folder) {
  std::size_t records = 0;
  for (const auto& record : std::filesystem::directory_iterator(run_folder / "planner_steps")) {
    const Ended again = run("roci-network cycle " + record.path().string());
    EXPECT_EQ(again.exit_code, 0) << again.output;
    ++records;
  }
  EXPECT_GT(records, 0U);
}

// Nobody hears without listening: the radio receives when what the ground says arrives.
void check_uplink(double at_s, const std::filesystem::path& run_folder) {
  std::string state;
  for (const Reading& one : readings(run_folder, "lander.radio")["lander.radio"])
    if (one.at_s <= at_s) state = one.value;
  EXPECT_EQ(state, "receiving") << "at " << at_s << " s";
}

// What the ground sets of a timeline is ordered when it is heard, and not before.
void check_orders(double at_s, const std::filesystem::path& run_folder) {
  EXPECT_THAT(ordered_at(run_folder), AllOf(Not(IsEmpty()), Each(DoubleNear(at_s, 0.001))));
}

void check_limits(const std::filesystem::path& run_folder) {
  const auto heat = observed(run_folder, "lander.heat.");
  EXPECT_EQ(heat.size(), kRanges.size());
  for (const auto& [zone, kelvins] : heat) {
    const auto [coldest, warmest] = kRanges.at(zone);
    EXPECT_THAT(numbers(kelvins), Each(AllOf(Ge(coldest), Le(warmest)))) << zone;
  }
  for (const auto& [timeline, joules] : observed(run_folder, "lander.battery"))
    EXPECT_THAT(numbers(joules), Each(Ge(0)));
}

// A site that is begun goes on until a negative signature or its last sample of `most`, its targets by their looks
// (R112). `positive` was found so by the ground, whatever the lander has found.
void check_subway_map(const Course& course, const std::filesystem::path& run_folder, std::size_t most,
                      const std::string& positive = "") {
  auto signatures = observed(run_folder, "lander.signature.");
  if (!positive.empty()) signatures[positive].push_back("positive");
  const Words samples = course.samples();
  std::map<char, std::size_t> taken;
  std::map<char, bool> negative;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const char site = samples[i][0], target = samples[i][2];
    const auto begun = i > 0 ? samples[i - 1][0] : site;
    EXPECT_TRUE(site == begun || negative[begun] || taken[begun] == most)
        << samples[i] << " though site " << begun << " was not finished";
    EXPECT_FALSE(negative[site]) << samples[i] << " after a negative one of its site";
    ASSERT_LT(taken[site], most) << samples[i];
    EXPECT_EQ(kByLooks.at(site)[taken[site]++], target) << samples[i];
    const auto known = signatures.find(std::string("lander.signature.") + site + "_" + target);
    negative[site] = known != signatures.end() && known->second.back() == "negative";
  }
}

// What the ground decides by goes with the next downlink, or with one that is under way (R110).
void check_decisional_data(const Course& course) {
  for (const Course::Product& product : course.products()) {
    if (product.tier != "decisional") continue;
    const auto is_next = [&](const Course::Deed& deed) {
      return deed.kind == "send" && deed.at_s >= product.made_s;
    };
    const auto next = std::ranges::find_if(course.deeds(), is_next);
    ASSERT_NE(next, course.deeds().end()) << product.id << " was made after the last downlink";
    const auto goes = std::ranges::find(course.deeds(), product.id, &Course::Deed::object);
    ASSERT_NE(goes, course.deeds().end()) << product.id << " was never sent";
    const auto later = std::find_if(next + 1, course.deeds().end(), is_next);
    EXPECT_TRUE(later == course.deeds().end() || goes->at_s < later->at_s)
        << product.id << " did not go with " << next->activity;
  }
}

// A sample that was analyzed is on Earth: its summary, and its data in the form that was chosen.
void check_samples(const Course& course) {
  for (const std::string& sample : course.analyzed()) {
    EXPECT_TRUE(course.is_home("summary_" + sample)) << sample;
    EXPECT_TRUE(course.is_home("raw_" + sample) || course.is_home("compressed_" + sample)) << sample;
  }
  EXPECT_EQ(course.samples().size(), course.analyzed().size());
}

void expect_home(const Course& course, const std::string& tier) {
  for (const Course::Product& product : course.products())
    if (product.tier == tier) {
      EXPECT_GE(product.received_s, 0) << product.id;
    }
}

// Data taking ends early enough for all that it brings: what stays behind is residual.
void expect_residual_left_behind(const Course& course) {
  Words left;
  for (const Course::Product& product : course.products()) {
    if (product.received_s >= 0) continue;
    EXPECT_EQ(product.tier, "residual") << product.id << " stayed behind";
    left.push_back(product.id);
  }
  EXPECT_FALSE(left.empty()) << "nothing stayed behind";
  for (const char* taking : {"collect", "analyze", "panorama", "start"})
    EXPECT_LT(course.last(taking), course.last("send")) << taking;
}

void expect_in_order(const Course& course, const Words& order, std::size_t least) {
  const Words samples = course.samples();
  ASSERT_THAT(samples.size(), AllOf(Ge(least), Le(order.size())));
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], order[i]);
}

// In each downlink no data go before others of a higher tier that are there when their transmission begins.
void expect_tiers_in_order(const Course& course, double since_s) {
  const Words tiers{"critical", "decisional", "mandatory", "residual"};
  struct Sent {
    double begins_s;
    std::ptrdiff_t tier;
    const Course::Product* product;
  };
  std::map<std::string, std::vector<Sent>> sessions;
  std::map<std::string, double> newest;  // by activity: when its last deed was
  for (const Course::Deed& deed : course.deeds()) {
    const double begins_s = std::exchange(newest[deed.activity], deed.at_s);
    if (deed.kind != "downlink" || deed.at_s < since_s) continue;
    const auto product = std::ranges::find(course.products(), deed.object, &Course::Product::id);
    ASSERT_NE(product, course.products().end()) << deed.object;
    const auto tier = std::ranges::find(tiers, product->tier) - tiers.begin();
    for (const Sent& before : sessions[deed.activity]) {
      EXPECT_TRUE(before.tier <= tier || product->made_s > before.begins_s)
          << deed.object << " went after " << before.product->id;
    }
    sessions[deed.activity].push_back({begins_s, tier, &*product});
  }
  EXPECT_FALSE(sessions.empty());
}

using Rule = void (*)(const Course&);

// Sites go by value: 1, 0, 2.
const std::map<std::string, Rule> kRules{
    {"nominal",
     [](const Course& course) {
       EXPECT_FALSE(course.samples().empty());
       const auto [blocks, unreleased] = course.blocks_and_those_unreleased();
       EXPECT_THAT(blocks, Ge(6));
       EXPECT_EQ(unreleased, 0) << "fully_autonomous is no";
     }},
    {"autonomous",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (Words{"1 0", "0 2", "2 1"}));
       EXPECT_THAT(course.blocks_and_those_unreleased().second, Ge(1)) << "no block waits for the ground";
     }},
    {"ground_lets_go",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (Words{"1 0", "0 2", "2 1"}));
       EXPECT_THAT(course.blocks_and_those_unreleased().second, Ge(1)) << "no block waits any more";
     }},
    // R108.
    {"basic",
     [](const Course& course) {
       EXPECT_EQ(course.sites(), Words{"0"});
       // All are worth the same until the trench is seen, when the first chain has begun; then the best one is next.
       EXPECT_EQ(course.samples(), (Words{"0 0", "0 2", "0 1"}));
       EXPECT_THAT(course.objects("panorama").size(), Ge(5U)) << "one now and then";
       EXPECT_THAT(course.objects("start").size(), Ge(5U)) << "days of seismometry";
       EXPECT_THAT(course.objects("receive"), IsEmpty()) << "there is no ground";
       EXPECT_TRUE(course.is_home("quakes"));
     }},
    // The lander has found none in the first sample and has left its site, to which it comes back.
    {"ground_positive",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (Words{"1 0", "1 1", "0 2", "2 1"}));
     }},
    // From the uplink on one target at each site, though each has a signature; the one before is the first at its site.
    {"ground_one_target",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (Words{"1 0", "0 2", "2 1"}));
     }},
    {"all_positive", [](const Course& course) { expect_in_order(course, kAllInOrder, 7); }},
    {"all_negative",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (Words{"1 0", "0 2", "2 1"}));
     }},
    {"first_negative",
     [](const Course& course) {
       expect_in_order(course, {"1 0", "0 2", "0 0", "0 1", "2 1", "2 2", "2 0"}, 6);
     }},
    {"low_start",
     [](const Course& course) {
       expect_in_order(course, kAllInOrder, 2);
       expect_residual_left_behind(course);
     }},
    {"sudden_low",
     [](const Course& course) {
       expect_in_order(course, kAllInOrder, 1);
       expect_residual_left_behind(course);
     }},
    // The first sample had been collected at site 1 when the order came.
    {"ground_reorders",
     [](const Course& course) {
       EXPECT_EQ(course.sites(), (Words{"1", "2", "0"}));
       EXPECT_EQ(course.samples(), (Words{"1 0", "2 1", "0 2"})) << "the new order counts";
     }},
    {"more_decisional",
     [](const Course& course) {
       expect_in_order(course, kAllInOrder, 1);
       expect_home(course, "decisional");
     }},
    {"more_mandatory",
     [](const Course& course) {
       expect_in_order(course, kAllInOrder, 1);
       expect_home(course, "mandatory");
     }},
    {"comm_energy_35", [](const Course& course) { expect_in_order(course, kAllInOrder, 7); }},
    {"cold_85K", [](const Course& course) { expect_in_order(course, kAllInOrder, 5); }},
    {"slow_downlink",
     [](const Course& course) {
       expect_in_order(course, kAllInOrder, 3);
       const double heard_s = *hears_the_ground_at("slow_downlink");
       const auto& deeds = course.deeds();
       EXPECT_EQ(std::ranges::count_if(
                     deeds,
                     [&](const Course::Deed& deed) { return deed.kind == "analyze" && deed.at_s < heard_s; }),
                 3)
           << "the order comes after the third sample";
       expect_tiers_in_order(course, heard_s);
     }},
};

}  // namespace

// One light time after a window of the link has opened (missions/europa/scenarios).
std::optional<double> hears_the_ground_at(const std::string& scenario) {
  static const std::map<std::string, double> kHears{{"ground_reorders", 94200},
                                                    {"ground_one_target", 51000},
                                                    {"ground_lets_go", 94200},
                                                    {"ground_positive", 137400},
                                                    {"slow_downlink", 310200}};
  const auto hears = kHears.find(scenario);
  return hears == kHears.end() ? std::nullopt : std::optional(hears->second);
}

void check_rules(const std::string& scenario, const Course& course, const std::filesystem::path& run_folder) {
  check_limits(run_folder);
  check_record(run_folder);
  if (scenario != "basic") check_communication(scenario, run_folder);  // its network has no limits
  if (const auto at_s = hears_the_ground_at(scenario)) {
    check_uplink(*at_s, run_folder);
    if (scenario == "ground_positive" || scenario == "ground_lets_go") check_orders(*at_s, run_folder);
  }
  const bool one_target = scenario == "ground_one_target";  // its order comes before the second sample
  if (scenario != "basic")                                  // Basic Surface Mission 1 has no map
    check_subway_map(course, run_folder, one_target ? 1 : 3,
                     scenario == "ground_positive" ? "lander.signature.1_0" : "");
  check_decisional_data(course);
  check_samples(course);
  kRules.at(scenario)(course);
}

}  // namespace roci::scenario
