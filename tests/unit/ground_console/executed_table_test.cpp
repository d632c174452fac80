// Plans that have ended, as `roci executed` shows them (R144).
#include "ground_console/cli/executed_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console {
namespace {

v1::ExecutedActivity activity(const std::string& id, const std::string& parent, double started_s,
                              double ended_s) {
  v1::ExecutedActivity out;
  out.id(id);
  out.name("drive");
  out.parent(parent);
  out.state(v1::ACTIVITY_SUCCEEDED);
  out.started_us(static_cast<std::int64_t>(started_s * 1e6));
  out.ended_us(static_cast<std::int64_t>(ended_s * 1e6));
  out.results().energy_j(std::numeric_limits<double>::quiet_NaN());
  return out;
}

v1::ExecutedPlan plan() {
  v1::ExecutedPlan out;
  out.executive("exec_svc");
  out.version(3);
  out.origin_us(10'000'000);
  out.outcome(v1::EXECUTED_BROKEN);
  out.reason("b failed");
  v1::ExecutedActivity late = activity("b", "whole", 60, 70);
  late.state(v1::ACTIVITY_FAILED);
  late.cause("no-go");
  late.attempts(2);
  late.results().energy_j(12.5);
  v1::NamedValue depth;
  depth.name("depth");
  depth.held().kind(v1::VALUE_NUMBER);
  depth.held().number(0.3);
  late.results().measured().push_back(depth);
  v1::ExecutedActivity never = activity("c", "whole", -1, -1);
  never.started_us(-1);
  never.ended_us(-1);
  never.state(v1::ACTIVITY_SKIPPED);
  out.activities({never, late, activity("a", "whole", 20, 50), activity("whole", "", 20, 70)});
  return out;
}

TEST(ExecutedTable, PartsStandBehindTheirWholeInTheOrderOfRealStarts) {
  EXPECT_EQ(cli::executed_table(plan()),
            "plan 3, from 00:00:10: broken (b failed)\n\n"
            "ACTIVITY  WHAT   STATE      STARTED   ENDED     TRIES  BROUGHT           WHY\n"
            "whole     drive  succeeded  00:00:20  00:01:10\n"
            "  a       drive  succeeded  00:00:20  00:00:50\n"
            "  b       drive  failed     00:01:00  00:01:10  2      12.5 J depth=0.3  no-go\n"
            "  c       drive  skipped\n");
  const nlohmann::json json = cli::executed_json(plan());
  EXPECT_EQ(json["outcome"], "broken");
  EXPECT_EQ(json["activities"][2]["energy_j"], 12.5);
  EXPECT_EQ(json["activities"][2]["values"]["depth"], "0.3");
  EXPECT_FALSE(json["activities"][3].contains("started_s"));
}

TEST(ExecutedTable, ParentsInACircleOrUnknownHideNobodyForEver) {
  v1::ExecutedPlan odd = plan();
  odd.activities({activity("a", "b", 1, 2), activity("b", "a", 1, 2), activity("c", "nobody", 1, 2)});
  EXPECT_THAT(cli::executed_table(odd), testing::HasSubstr("\nc "));
}

TEST(MissionView, KeepsTheNewestPlansThatHaveEnded) {
  lib::MissionView view;
  v1::MissionStatus status;
  status.executive("exec_svc");
  view.take(status);
  EXPECT_TRUE(view.executed().empty());
  v1::ExecutedPlan ended = plan();
  for (std::uint32_t version = 1; version <= lib::MissionView::kExecuted + 3; ++version) {
    ended.version(version);
    view.take(ended);
  }
  EXPECT_EQ(view.executed().size(), lib::MissionView::kExecuted);
  EXPECT_EQ(view.executed().begin()->first, 4U);
}

}  // namespace
}  // namespace roci::console
