#include "core/temporal/function_values.hpp"

#include <gmock/gmock.h>

namespace roci::temporal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<FunctionValueUse> kValues{{"time", {"a", "b"}, 1},
                                            {"time", {"b", "a"}, 2},
                                            {"energy", {"b"}, 3},
                                            {"lift", {"b", "m"}, 4},
                                            {"time", {"b", "c"}, 5}};

TEST(FunctionValues, OfAnActivityAreThoseOfItsArgumentsInTheirOrder) {
  EXPECT_THAT(function_values_of({"a", "b"}, kValues), ElementsAre(0, 2));
  EXPECT_THAT(function_values_of({"b", "a"}, kValues), ElementsAre(1, 2));
  EXPECT_THAT(function_values_of({"x"}, kValues), IsEmpty());
}

TEST(FunctionValues, WhoseArgumentsStandInAnotherOrderAreThoseWhereThereIsNoOther) {
  EXPECT_THAT(function_values_of({"m", "a", "b"}, kValues), ElementsAre(0, 2, 3));
}

// (f a a) needs a twice.
TEST(FunctionValues, CountAnArgumentOnceForEachOfTheirs) {
  const std::vector<FunctionValueUse> twice{{"f", {"a", "a"}, 1}, {"f", {"a"}, 2}};
  EXPECT_THAT(function_values_of({"a"}, twice), ElementsAre(1));
  EXPECT_THAT(function_values_of({"a", "a"}, twice), ElementsAre(0, 1));
  const std::vector<FunctionValueUse> to_itself{{"time", {"b", "b"}, 0}};
  EXPECT_THAT(function_values_of({"image", "b"}, to_itself), IsEmpty());
}

}  // namespace
}  // namespace roci::temporal
