// The Debian package: what it needs is named and known, and a mission flies from it.
#include <gmock/gmock.h>

#include <regex>

#include "tests/scenario/installed.hpp"

namespace roci::scenario {
namespace {

class Packaged : public Prefix {};

TEST_F(Packaged, FliesWithThePackagesThatItNames) {
  const Ended packed = run("cd " ROCI_BINARY_DIR " && cpack -B " + (folder / "deb").string() + " 2>&1");
  ASSERT_EQ(packed.exit_code, 0) << packed.output;
  const std::string package = (folder / "deb/rocinante_*.deb").string();
  const Ended needs = run("dpkg-deb -f " + package + " Depends");
  const std::regex name("([a-z0-9.+-]+)( \\(>= [^)]+\\))?");
  int named = 0;
  for (std::sregex_iterator one(needs.output.begin(), needs.output.end(), name), end; one != end;
       ++one, ++named)
    EXPECT_EQ(run("dpkg-query -W " + (*one)[1].str()).exit_code, 0) << (*one)[1];
  EXPECT_GE(named, 10) << needs.output;
  for (const char* vendor : {"libfastrtps", "libddsc"})
    EXPECT_THAT(needs.output, ::testing::HasSubstr(vendor));

  ASSERT_EQ(run("dpkg-deb -x " + package + " " + (folder / "root").string()).exit_code, 0);
  if (!may_hide_the_source()) GTEST_SKIP() << "this user cannot hide the source folder (unshare -rm)";
  expect_to_fly_from(folder / "root/usr");
}

}  // namespace
}  // namespace roci::scenario
