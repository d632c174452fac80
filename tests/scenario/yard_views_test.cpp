// What an operator sees of the maps of two rovers: the scout finds a trap,
// and the primary knows of it when it has been told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/robots.hpp"
#include "ground_console/cli/watch/screen.hpp"
#include "services/topics/topics.hpp"
#include "tests/scenario/yard.hpp"

namespace roci::scenario {
namespace {

namespace topics = services::topics;
using nlohmann::json;
using testing::HasSubstr;
using testing::SizeIs;

class YardViews : public testing::TestWithParam<const char*> {};

TEST_P(YardViews, EachRoverHasItsOwnMapUntilItIsTold) {
  console::lib::MissionView view;
  json before;  // the scout's patch
  const std::string vendor = GetParam();
  const std::vector<std::string> vendors =
      vendor == "mixed" ? std::vector<std::string>{"fastdds", "cyclonedds", "fastdds", "cyclonedds"}
                        : std::vector<std::string>(4, vendor);
  Yard yard("yard", vendors, [&](const std::vector<YardWord>& words) -> std::optional<YardCommand> {
    if (words.empty()) return drive("scout", 21.5, 15);
    before = words.size() == 1 ? console::cli::robots_json(view) : before;
    if (words.size() == 1) return tell("scout");
    return std::nullopt;
  });
  yard.watch(view);
  yard.run();
  ASSERT_EQ(yard.words().at(0).code, "no-go");
  ASSERT_THAT(before["scout"]["maps"], SizeIs(1)) << before;
  ASSERT_THAT(before["scout"]["maps"][0]["obstacles"], SizeIs(1));
  EXPECT_TRUE(before["scout"]["maps"][0]["told"].is_null());
  EXPECT_THAT(before["primary"]["maps"][0]["obstacles"], SizeIs(0)) << "nobody has told it";
  EXPECT_EQ(before["primary"]["maps"][0]["map_version"], 1);

  const json after = console::cli::robots_json(view);
  const json& found = after["primary"]["maps"][0]["obstacles"].at(0);
  EXPECT_EQ(found, after["scout"]["maps"][0]["obstacles"][0]);
  EXPECT_EQ(found["found_by"], "scout");
  EXPECT_EQ(found["kind"], "soil");
  EXPECT_NEAR(found["y_m"], 15, 1.5);
  EXPECT_EQ(after["primary"]["maps"][0]["map_version"], 2);
  EXPECT_EQ(after["primary"]["maps"][0]["taken"][0]["author"], "scout.path");
  EXPECT_EQ(after["scout"]["maps"][0]["told"]["map_version"], 2);
  EXPECT_GT(after["scout"]["pose"]["x_m"], 8);
  EXPECT_EQ(after["primary"]["pose"]["x_m"], 5);
  EXPECT_GT(after["scout"]["battery"], 0);
  const std::string screen = console::cli::watch::watch_screen(view, 130, 50).plain();
  EXPECT_THAT(screen, HasSubstr("map version 2: 1 obstacle (1 soil of scout), took version 2 of"));
  EXPECT_THAT(screen, HasSubstr("≈"));
}

INSTANTIATE_TEST_SUITE_P(Transports, YardViews, testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace roci::scenario
