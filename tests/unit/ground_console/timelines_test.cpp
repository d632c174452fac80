// What roci timelines prints of a plan half way through and of what is observed.
#include "ground_console/cli/timelines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ground_console/cli/watch/panels.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

// The image of flying_mission() as a plan that can be executed: it takes 40 s, runs since 295 s, and now is
// 300 s.
lib::MissionView with_an_image_under_way() {
  lib::MissionView view = flying_mission();
  v1::Plan plan;
  plan.version(3);
  plan.id("planetary");
  plan.point_count(3);
  v1::PlanActivity image;
  image.id("2.a2");
  image.name("take-image");
  image.start_point(1);
  image.end_point(2);
  image.duration_lower_us(40'000'000);
  image.duration_upper_us(40'000'000);
  image.impacts().resize(2);
  image.impacts()[1].timeline("(battery)");
  image.impacts()[1].kind(v1::IMPACT_DELTA);
  image.impacts()[1].moment(v1::IMPACT_AT_START);
  image.impacts()[1].amount().kind(v1::VALUE_NUMBER);
  image.impacts()[1].amount().number(-40);
  image.impacts()[0].timeline("(have-image a)");
  image.impacts()[0].moment(v1::IMPACT_AT_END);
  image.impacts()[0].amount().kind(v1::VALUE_BOOLEAN);
  image.impacts()[0].amount().truth(true);
  plan.activities({image});
  plan.origin_us(250'000'000);
  view.take(plan);
  return view;
}

TEST(Timelines, TellWhatWasPlannedAndWhatIsStillToCome) {
  EXPECT_EQ(cli::timelines_text(cli::timelines_of(with_an_image_under_way(), {"(have-image a)"})),
            "(have-image a)\n"
            "  00:04:50  planned   true             2.a2\n"
            "  00:05:35  projected true             2.a2\n");
}

TEST(Timelines, ThatAreNumbersOfThePlanAreItsLevels) {
  const std::vector<cli::watch::Level> levels = cli::watch::levels_of(with_an_image_under_way());
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0].name, "(battery)");
  EXPECT_THAT(levels[0].changes, ElementsAre(Pair(295'000'000, -40.0)));
  EXPECT_THAT(cli::watch::levels_of(lib::MissionView()), IsEmpty());
}

TEST(Timelines, OfObservationsHaveTheNewestValueAsExecuted) {
  const auto timelines = cli::timelines_of(with_an_image_under_way(), {});
  ASSERT_TRUE(timelines.contains("rover.nav"));
  ASSERT_EQ(timelines.at("rover.nav").size(), 1U);
  EXPECT_EQ(timelines.at("rover.nav")[0].kind, temporal::ProjectionKind::executed);
  EXPECT_THAT(cli::timelines_text(timelines), HasSubstr("rover.camera\n"));
}

TEST(Timelines, AreAListOfChangesInJson) {
  const lib::MissionView view = with_an_image_under_way();
  const auto json = cli::timelines_json(view, cli::timelines_of(view, {"(have-image a)"}));
  EXPECT_EQ(json["plan_version"], 3);
  EXPECT_EQ(json["timelines"]["(have-image a)"][1]["kind"], "projected");
  EXPECT_EQ(json["timelines"]["(have-image a)"][1]["time_s"], 335);
  EXPECT_EQ(json["timelines"]["(have-image a)"][1]["value"], "true");
}

TEST(Timelines, ThatNobodyKnowsAreNone) {
  EXPECT_THAT(cli::timelines_of(with_an_image_under_way(), {"nothing"}), IsEmpty());
  EXPECT_THAT(cli::timelines_of(lib::MissionView(), {}), IsEmpty());
}

}  // namespace
}  // namespace roci::console
