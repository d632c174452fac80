// What roci downlinks, utility, energy and subway make of fixed samples: text, JSON and pictures.
#include "ground_console/cli/outlook/outlook.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ground_console/cli/outlook/svg.hpp"
#include "ground_console/lib/mission_view.hpp"
#include "tests/unit/ground_console/outlook_samples.hpp"

namespace roci::console {
namespace {

using namespace cli::outlook;
using nlohmann::json;
using ::testing::ElementsAre, ::testing::EndsWith, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not,
    ::testing::SizeIs, ::testing::StartsWith;
using testing::outlook_of_a_lander, testing::schedule_of_a_lander;

// Returns what keeps a document from being well-formed XML of the kind that Svg writes; empty: nothing.
std::string fault_of(const std::string& document) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const auto byte = static_cast<unsigned char>(document[i]);
    if (byte < 0x20 && byte != '\n') return "a control character at " + std::to_string(i);
    if (document[i] == '&' && document.find(';', i) > i + 6) return "a bare & at " + std::to_string(i);
    if (document[i] != '<') continue;
    const std::size_t end = document.find('>', i);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = document.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return "a bare < at " + std::to_string(i);
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.starts_with('/')) {
      if (open.empty() || open.back() != name.substr(1))
        return "an end of " + name + " that has no beginning";
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
    i = end;
  }
  if (!open.empty()) return open.back() + " has no end";
  // nlohmann's strict reader refuses what is no UTF-8.
  try {
    (void)json(document).dump();
  } catch (const json::exception& error) {
    return error.what();
  }
  return {};
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t out = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++out;
  return out;
}

std::vector<std::string> all_pictures(const v1::DownlinkSchedule& schedule,
                                      const v1::MissionOutlook& outlook) {
  return {downlinks_svg(schedule), utility_svg(outlook), energy_svg(outlook), subway_svg(outlook),
          chains_svg(outlook)};
}

TEST(DownlinksView, TellsWhatGoesWhenInWhichOrderAndWhatDoesNotAndWhy) {
  v1::DownlinkSchedule schedule = schedule_of_a_lander();
  schedule.downlinks().resize(1);
  schedule.left_out().resize(1);
  EXPECT_EQ(downlinks_text(schedule),
            "Downlink schedule 7 of lander, made at 90:00:00 with plan 12 (network rsm1, version 3)\n"
            "\n"
            "START     END       TAKES     BYTES     ENERGY  TIER        WHAT\n"
            "92:00:00  92:30:00  29.1 min  10900000  174 kJ              downlink#31.3\n"
            "                              400000            critical      lab-0001\n"
            "                              2500000           decisional    lab-0002\n"
            "                              8000000           mandatory     cam-0007\n"
            "\n"
            "LEFT OUT    TIER      BYTES     WHY\n"
            "lab-0003    residual  30000000  what the others leave of the downlinks is 8.25 MB at most in "
            "one, it has "
            "30 MB\n"
            "\n"
            "LATE        TIER        BYTES    WHY\n"
            "lab-0002    decisional  2500000  it should go with downlink#30.3, which higher tiers fill\n");
}

TEST(DownlinksView, WithoutARateThereIsNothingToSchedule) {
  v1::DownlinkSchedule schedule;
  schedule.version(1);
  EXPECT_THAT(downlinks_text(schedule), HasSubstr("all data get home"));
  EXPECT_THAT(downlinks_svg(schedule), HasSubstr("all data get home"));
}

TEST(DownlinksView, JsonHoldsTheWholeSample) {
  const json told = downlinks_json(schedule_of_a_lander());
  EXPECT_EQ(told["robot"], "lander");
  EXPECT_EQ(told["version"], 7);
  EXPECT_EQ(told["time_s"], 324000);
  EXPECT_EQ(told["limited"], true);
  EXPECT_EQ(told["ranks"][0]["name"], "mission");
  EXPECT_THAT(told["downlinks"], SizeIs(3));
  EXPECT_EQ(told["downlinks"][1]["products"][0], (json{{"id", "sample_2_0/science_analyze/summary_2_0"},
                                                       {"exists", false},
                                                       {"bytes", 2'500'000},
                                                       {"tier", "decisional"}}));
  EXPECT_EQ(told["downlinks"][0]["takes_s"], 1744);
  EXPECT_EQ(told["left_out"][1]["id"], "cam-0009");
  EXPECT_EQ(told["late"][0]["why"], "it should go with downlink#30.3, which higher tiers fill");
}

TEST(DownlinksView, ThePictureHasAPartForEachProductAndTheReasons) {
  const std::string picture = downlinks_svg(schedule_of_a_lander());
  for (const char* const id :
       {"cam-0007", "seis-0003", "downlink#33.3", "nothing to send", "lab-0003", "Left out (2)", "Late (1)",
        "sample_2_0/science_analyze/raw_2_0, 9 MB, mandatory, planned"})
    EXPECT_THAT(picture, HasSubstr(id));
  EXPECT_EQ(count_of(picture, "<g><title>"), 6U);
}

TEST(UtilityView, TellsPredictedAndExecutedApartByRank) {
  const std::string text = utility_text(outlook_of_a_lander());
  EXPECT_THAT(text, HasSubstr("mission         a sample where the science subway map leads\n"));
  EXPECT_THAT(text,
              HasSubstr("sample_1_1  running    60:00:00   92:00:00   4.2 MJ   mission 1, analysis 0.7   "
                        "analysis 0.1\n"));
  EXPECT_THAT(text,
              HasSubstr("sample_2_0/science_analyze/raw_2_0  planned   mandatory   9000000  analysis 0.6\n"));
  EXPECT_THAT(text, HasSubstr("On Earth: analysis 0.5, pre_collection 0.3\n"));
}

TEST(UtilityView, JsonHoldsChainsProductsAndWhatRanksMean) {
  const json told = utility_json(outlook_of_a_lander());
  EXPECT_EQ(told["received"], (json{0, 0.5, 0.3}));
  EXPECT_EQ(told["chains"][1]["request"], "sample_1_1");
  EXPECT_EQ(told["chains"][1]["stage"], "running");
  EXPECT_EQ(told["chains"][1]["predicted"], (json{1, 0.7}));
  EXPECT_EQ(told["chains"][1]["executed"], (json{0, 0.1}));
  EXPECT_EQ(told["chains"][1]["cost_j"], 4.2e6);
  EXPECT_EQ(told["products"][3]["fate"], "lost");
  EXPECT_EQ(told["products"][4]["fate"], "planned");
  EXPECT_EQ(told["ranks"][0]["meaning"], "a sample where the science subway map leads");
}

TEST(UtilityView, ThePictureGoesByUtilityTheHighestRankFirst) {
  const std::string picture = utility_svg(outlook_of_a_lander());
  EXPECT_LT(picture.find(">sample_1_0"), picture.find(">sample_1_1"));
  EXPECT_LT(picture.find(">sample_1_1"), picture.find(">sample_2_0"));
  EXPECT_LT(picture.find(">sample_2_0"), picture.find(">excavate_2"));
  EXPECT_LT(picture.find(">excavate_2"), picture.find(">panorama_4"));
  EXPECT_THAT(picture, HasSubstr(">0.1 of 0.7<"));
}

TEST(ChainsView, HasARowForRequestsThatDifferInNumbersAndALaneWhereTheyOverlap) {
  v1::MissionOutlook outlook = outlook_of_a_lander();
  outlook.chains().push_back(outlook.chains()[3]);  // at the time of sample_2_0
  outlook.chains().back().request("sample_2_10");
  const std::string picture = chains_svg(outlook);
  EXPECT_EQ(fault_of(picture), "");
  EXPECT_EQ(count_of(picture, ">sample<"), 1U);
  EXPECT_THAT(picture, HasSubstr("× 4"));
  EXPECT_THAT(picture, HasSubstr("sample_1_0 (done), 20:00:00 – 44:00:00, sample_1_0/whole"));
  const auto place = [&](const std::string& request) {
    const std::size_t y = picture.find(" y=\"", picture.find("<title>" + request + " ")) + 4;
    return std::stod(picture.substr(y, picture.find('"', y) - y));
  };
  EXPECT_EQ(place("sample_2_0"), place("sample_1_1"));
  EXPECT_EQ(place("sample_2_10"), place("sample_2_0") + 22) << "below it";
  EXPECT_THAT(chains_text(outlook),
              HasSubstr("60:00:00   92:00:00   running    sample_1_1   sample_1_1/whole\n"));
  EXPECT_EQ(chains_json(outlook)["chains"][2]["stage"], "committed");
}

TEST(EnergyView, TellsWhatIsLeftAndWhenTheWorstCaseIsEmpty) {
  const std::string text = energy_text(outlook_of_a_lander());
  EXPECT_THAT(
      text,
      HasSubstr("At 177:00:00, after all that is planned: 4 MJ left, 0 J in the worst case, 9.7 MJ in the "
                "best. In the worst case nothing is left from 177:00:00 on.\n"));
  EXPECT_THAT(text, HasSubstr("110:00:00  43 MJ      41.2 MJ  44.8 MJ  excavate#32.0\n"));
  const json told = energy_json(outlook_of_a_lander());
  EXPECT_EQ(told["empty_in_worst_case_s"], 177 * 3600);
  EXPECT_EQ(told["energy"][2]["best_j"], 44.8e6);
  EXPECT_EQ(told["budget"], "lander.battery");
  EXPECT_THAT(energy_svg(outlook_of_a_lander()), HasSubstr("worst case: empty"));
}

TEST(EnergyView, ThatLastsHasNoEnd) {
  v1::MissionOutlook outlook = outlook_of_a_lander();
  outlook.energy().resize(3);
  EXPECT_EQ(energy_json(outlook)["empty_in_worst_case_s"], nullptr);
  EXPECT_THAT(energy_text(outlook), Not(HasSubstr("nothing is left")));
  EXPECT_THAT(energy_svg(outlook), Not(HasSubstr("worst case: empty")));
}

TEST(SubwayView, TellsOutcomesAndWhichIsNext) {
  const std::string text = subway_text(outlook_of_a_lander());
  EXPECT_THAT(text, HasSubstr("After what is planned the map leads to sample_2_1.\n"));
  EXPECT_THAT(text, HasSubstr("site_1  0.5     0.7        sample_1_0  0.45   positive\n"));
  EXPECT_THAT(text, HasSubstr("sample_0_1  0.288  unknown\n")) << "targets of a site go by their weight";
  EXPECT_LT(text.find("sample_0_1"), text.find("sample_0_0"));
  const json told = subway_json(outlook_of_a_lander());
  EXPECT_EQ(told["next_target"], "sample_2_1");
  std::vector<std::string> states;
  for (const json& site : told["sites"])
    for (const json& target : site["targets"]) states.push_back(target["state"]);
  EXPECT_THAT(states, ElementsAre("planned", "next", "unknown", "positive", "negative", "closed", "unknown",
                                  "unknown", "unknown"));
}

TEST(SubwayView, OfAMissionWithoutOneSaysSo) {
  EXPECT_THAT(subway_text(v1::MissionOutlook()), HasSubstr("no subway map"));
  EXPECT_THAT(subway_svg(v1::MissionOutlook()), HasSubstr("no subway map"));
}

TEST(OutlookPictures, AreWellFormedWhateverTheWireHolds) {
  for (const std::string& picture : all_pictures(schedule_of_a_lander(), outlook_of_a_lander())) {
    EXPECT_EQ(fault_of(picture), "");
    EXPECT_THAT(picture, StartsWith("<svg "));
    EXPECT_THAT(picture, EndsWith("</svg>\n"));
  }
  for (const std::string& picture : all_pictures({}, {})) EXPECT_EQ(fault_of(picture), "");
  const std::string bad = "<b onload=\"x\">&\xff\xc0\x80\xed\xa0\x80\x01 \xf0\x9f";
  v1::DownlinkSchedule schedule = schedule_of_a_lander();
  v1::MissionOutlook outlook = outlook_of_a_lander();
  for (v1::ScheduledDownlink& one : schedule.downlinks()) {
    one.activity(bad);
    one.start_us(std::numeric_limits<std::int64_t>::max());
    one.end_us(std::numeric_limits<std::int64_t>::min());
    for (v1::ScheduledProduct& data : one.products()) data.id(bad + data.id());
  }
  schedule.left_out()[0].why(bad);
  schedule.left_out()[0].data().tier(static_cast<v1::DataTier>(99));
  schedule.robot(bad);
  outlook.network(bad);
  for (v1::ChainOutlook& one : outlook.chains()) {
    one.title(bad);
    one.request(bad);
    one.start_us(std::numeric_limits<std::int64_t>::max());
    one.end_us(std::numeric_limits<std::int64_t>::min());
    one.stage(static_cast<v1::ChainStage>(99));
    one.predicted({std::nan(""), std::numeric_limits<double>::infinity()});
  }
  for (v1::EnergyPoint& one : outlook.energy()) one.best_j(std::nan(""));
  outlook.energy()[0].predicted_j(std::numeric_limits<double>::max());
  outlook.capacity_j(std::nan(""));
  for (v1::SubwaySite& site : outlook.sites()) {
    site.name(bad);
    site.chance(std::nan(""));
    for (v1::SubwayTarget& one : site.targets()) {
      one.task(bad);
      one.visual(std::nan(""));
    }
  }
  for (const std::string& picture : all_pictures(schedule, outlook)) {
    EXPECT_EQ(fault_of(picture), "");
    EXPECT_THAT(picture, Not(HasSubstr("<b onload")));
    EXPECT_THAT(picture, Not(HasSubstr("=\"nan")));
  }
  EXPECT_THAT(downlinks_text(schedule), Not(HasSubstr("\x01")));
}

TEST(OutlookPictures, AreBoundedHoweverLongTheListsAre) {
  v1::DownlinkSchedule schedule = schedule_of_a_lander();
  schedule.downlinks().assign(5'000, schedule.downlinks().front());
  schedule.left_out().assign(5'000, schedule.left_out().front());
  const std::string picture = downlinks_svg(schedule);
  EXPECT_THAT(picture, HasSubstr("and 4800 more downlinks"));
  EXPECT_THAT(picture, HasSubstr("and 4800 more"));
  v1::MissionOutlook outlook = outlook_of_a_lander();
  outlook.chains().assign(5'000, outlook.chains().front());
  EXPECT_THAT(utility_svg(outlook), HasSubstr("and 4800 more"));
  EXPECT_EQ(fault_of(picture), "");
}

TEST(OutlookText, BreaksBetweenWordsAndCutsWhatIsTooWide) {
  EXPECT_THAT(lines_of("a bb ccc dddd", 6), ElementsAre("a bb", "ccc", "dddd"));
  EXPECT_THAT(lines_of("   ", 6), IsEmpty());
  Svg svg;
  svg.text_within(0, 0, 40, "äöüäöüäöüäöü", {.size = 10});
  EXPECT_THAT(svg.document(1, 1, ""), HasSubstr(">äöüäö…<"));
}

// A planner that has started again counts from 1 anew; its words are newer.
TEST(OutlookOfTheMission, IsTheNewestOfEachRobot) {
  lib::MissionView view;
  v1::DownlinkSchedule schedule = schedule_of_a_lander();
  schedule.header().sender("planner_svc");
  schedule.header().incarnation(1);
  schedule.header().seq(5);
  view.take(schedule);
  schedule.header().seq(4);
  schedule.version(6);
  view.take(schedule);
  EXPECT_EQ(view.schedules().at("lander").version(), 7U) << "a late one changes nothing";
  schedule.header().incarnation(2);
  schedule.header().seq(1);
  schedule.version(1);
  view.take(schedule);
  EXPECT_EQ(view.schedules().at("lander").version(), 1U);
  view.take(outlook_of_a_lander());
  EXPECT_THAT(view.outlooks(), SizeIs(1));
}

}  // namespace
}  // namespace roci::console
