#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"
#include "core/temporal/verdict.hpp"

namespace roci::temporal {
namespace {

TEST(DurationText, DropsWhatIsZero) {
  EXPECT_EQ(to_text(seconds(12.5)), "12.5 s");
  EXPECT_EQ(to_text(seconds(100)), "100 s");
  EXPECT_EQ(to_text(Duration{1}), "0.000001 s");
  EXPECT_EQ(to_text(Duration{-1'500'000}), "-1.5 s");
  EXPECT_EQ(to_text(Duration{0}), "0 s");
  EXPECT_EQ(to_text(no_bound), "unbounded");
}

TEST(DurationSum, SaturatesAtUnbounded) {
  EXPECT_EQ(plus(no_bound, Duration{-5}), no_bound);
  EXPECT_EQ(plus(Duration{5}, -no_bound), -no_bound);
  EXPECT_EQ(plus(Duration{5}, Duration{7}), Duration{12});
  EXPECT_EQ(plus(Duration{INT64_MAX - 1}, Duration{7}), no_bound);
  EXPECT_EQ(plus(Duration{INT64_MIN + 2}, Duration{-7}), -no_bound);
}

TEST(ValueText, NamesStatesWithArguments) {
  EXPECT_EQ(to_text(Value{}), "none");
  EXPECT_EQ(to_text(Value{true}), "true");
  EXPECT_EQ(to_text(Value{0.25}), "0.25");
  EXPECT_EQ(to_text(state("idle")), "idle");
  EXPECT_EQ(to_text(state("going-to", {"wp-1", "fast"})), "going-to(wp-1, fast)");
}

TEST(VerdictText, IsAnotherOneForEachVerdict) {
  std::set<std::string> texts{to_string(static_cast<Verdict>(99))};
  EXPECT_TRUE(texts.contains("unknown"));
  for (int i = 0; i <= static_cast<int>(Verdict::no_reply); ++i)
    EXPECT_TRUE(texts.insert(to_string(static_cast<Verdict>(i))).second) << i;
  EXPECT_STREQ(to_string(Verdict::solved), "solved");
  EXPECT_STREQ(to_string(Verdict::no_reply), "no_reply");
}

}  // namespace
}  // namespace roci::temporal
