// The form of flexible timelines (R142) and the matrix of values (R143).
#include "planner_svc/timeline_htn/extraction/matrix.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/temporal/execution_windows.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/windows.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::extraction {
namespace {

using temporal::FlexiblePlan, temporal::seconds, temporal::Token;
using testing::HasSubstr;

FlexiblePlan small_plan() {
  const std::string page = text_of_file("docs/timeline-format.md");
  const std::size_t from = page.find("# small.yaml");
  return *planned(model_of({page.substr(from, page.find("```", from) - from)})).plan;
}

TEST(FlexibleTimelines, HaveNeitherGapNorOverlapFromOriginToHorizon) {
  const FlexiblePlan plan = small_plan();
  temporal::ExecutionWindows windows(plan.point_count, temporal::all_constraints(plan),
                                     temporal::Duration{0});
  std::map<std::string, std::vector<Token>> timelines;
  for (const Token& token : plan.tokens) timelines[token.timeline].push_back(token);
  ASSERT_EQ(timelines.size(), 3U);
  for (const auto& [name, tokens] : timelines) {
    EXPECT_EQ(tokens.front().start_point, temporal::origin_point) << name;
    const temporal::Window end = windows.window(tokens.back().end_point);
    EXPECT_EQ(end.lower, seconds(3600)) << name;
    EXPECT_EQ(end.upper, seconds(3600)) << name;
    for (std::size_t i = 1; i < tokens.size(); ++i)
      EXPECT_EQ(tokens[i].start_point, tokens[i - 1].end_point) << name;
  }
}

TEST(FlexibleTimelines, AnActivityBeginsWithItsValueAndEndsNoLater) {
  const FlexiblePlan plan = small_plan();
  std::size_t seen = 0;
  for (const Token& token : plan.tokens)
    for (const auto& activity : plan.activities) {
      if (activity.start_point != token.start_point) continue;
      ++seen;
      EXPECT_EQ(activity.name, token.timeline + "." + temporal::to_text(token.held));
      bool ends_before = false;
      for (const auto& constraint : plan.constraints)
        ends_before = ends_before ||
                      (constraint.from_point == activity.end_point &&
                       constraint.to_point == token.end_point && constraint.lower == seconds(0)) ||
                      (constraint.from_point == token.end_point &&
                       constraint.to_point == activity.end_point && constraint.upper == seconds(0));
      EXPECT_TRUE(ends_before) << activity.name;
    }
  EXPECT_EQ(seen, 5U);  // that within another one of its timeline has no value of its own
}

TEST(Matrix, OfTheSmallModelIsTheGoldenOne) {
  EXPECT_EQ(to_text(matrix_of(small_plan())),
            "j    earliest_s  latest_s    navigation          wheels           mast\n"
            "0    0           0           idle                at(wp0)          stowed\n"
            "1    0           3505        traverse(wp0, wp2)  |                |\n"
            "2    0           3505        |                   |                look\n"
            "3    10          3515        |                   drive(wp0, wp1)  |\n"
            "4    10          3515        |                   |                stowed\n"
            "5    50          3555        |                   at(wp1)          |\n"
            "6    50          3555        |                   |                look\n"
            "7    60          3565        |                   drive(wp1, wp2)  |\n"
            "8    60          3565        |                   |                stowed\n"
            "9    95          3600        idle                |                |\n"
            "10   95          3600        |                   at(wp2)          |\n");
}

TEST(Matrix, IsThatOfThePlanAlone) {
  const Matrix matrix = matrix_of(small_plan());
  ASSERT_EQ(matrix.values.size(), 3U);
  for (std::size_t j = 1; j < matrix.transitions.size(); ++j) {
    bool changes = false;
    for (std::size_t i = 0; i < matrix.values.size(); ++i) {
      changes = changes || matrix.changes[i][j];
      if (matrix.changes[i][j]) continue;
      EXPECT_EQ(matrix.values[i][j], matrix.values[i][j - 1]);
    }
    EXPECT_TRUE(changes) << j;
  }
  const auto json = nlohmann::json::parse(to_json(matrix));
  EXPECT_EQ(json["plan"][1][3], "drive(wp0, wp1)");
  EXPECT_EQ(json["transitions"][3]["earliest_s"], 10);
  const std::string svg = to_svg(matrix, "a < b");
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr("drive(wp0, wp1)"));
}

// What is predicted is a timeline like the others, in words and as a picture.
TEST(Matrix, HoldsWhatIsPredictedAtItsTimes) {
  const FlexiblePlan plan = *planned(model_of({reading::kWindows})).plan;
  const Matrix matrix = matrix_of(plan);
  const std::string text = to_text(matrix);
  EXPECT_THAT(text, HasSubstr("0    0           0           idle             silent           hidden\n"));
  EXPECT_THAT(text, HasSubstr("2    100         100         |                |                seen\n"));
  EXPECT_THAT(text, HasSubstr("3    130         130         |                |                hidden\n"));
  EXPECT_THAT(text, HasSubstr("5    600         610         |                sending(first)   |\n"));
  const std::string picture = to_svg(matrix, "relay");
  EXPECT_THAT(picture, HasSubstr(">ground</text>"));
  EXPECT_THAT(picture, HasSubstr("<title>seen</title>"));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::extraction
