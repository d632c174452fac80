#include "core/words/nearest_word.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace roci::words {
namespace {

TEST(NearestWord, IsTheOneThatIsTheFewestEditsAway) {
  const std::vector<std::string> known{"drive", "rover.battery", "x", "y", "idle-at", "robot", "location"};
  EXPECT_EQ(nearest_word("drvie", known), "drive") << "two exchanged are one edit";
  EXPECT_EQ(nearest_word("rover.batery", known), "rover.battery");
  EXPECT_EQ(nearest_word("idle-ta", known), "idle-at");
  EXPECT_EQ(nearest_word("locatoin_", known), "location");
  EXPECT_EQ(nearest_word("xx", known), "x");
  EXPECT_EQ(nearest_word("z", known), "") << "no letter of it is right";
  EXPECT_EQ(nearest_word("rbt", known), "") << "two edits of five";
  EXPECT_EQ(nearest_word("on", known), "");
  EXPECT_EQ(nearest_word("camera", known), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'x'), known), "");
}

TEST(NearestWord, IsOfferedAsARemedy) {
  const std::vector<std::string> known{"drive"};
  EXPECT_EQ(did_you_mean("drvie", known), "; did you mean 'drive'?");
  EXPECT_EQ(did_you_mean("camera", known), "");
  EXPECT_EQ(nearest("drvie", known).remedy("declare it"), "did you mean 'drive'? else declare it");
  EXPECT_EQ(nearest("camera", known).remedy("declare it"), "declare it");
}

}  // namespace
}  // namespace roci::words
