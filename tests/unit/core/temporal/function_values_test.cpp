#include "core/temporal/function_values.hpp"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace roci::temporal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

FunctionValueUse value(std::string function, std::vector<std::string> arguments) {
  FunctionValueUse out;
  out.function = std::move(function);
  out.arguments = std::move(arguments);
  return out;
}

const std::vector<FunctionValueUse> kValues{value("time", {"a", "b"}), value("time", {"b", "a"}),
                                            value("energy", {"b"}), value("lift", {"b", "m"}),
                                            value("time", {"b", "c"})};

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
  const std::vector<FunctionValueUse> twice{value("f", {"a", "a"}), value("f", {"a"})};
  EXPECT_THAT(function_values_of({"a"}, twice), ElementsAre(1));
  EXPECT_THAT(function_values_of({"a", "a"}, twice), ElementsAre(0, 1));
  const std::vector<FunctionValueUse> to_itself{value("time", {"b", "b"})};
  EXPECT_THAT(function_values_of({"image", "b"}, to_itself), IsEmpty());
}

}  // namespace
}  // namespace roci::temporal
