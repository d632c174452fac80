// What the README tells a newcomer to type, typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf, ::testing::HasSubstr, ::testing::Not;

// The lines of the README's examples that begin so, without their comments.
std::vector<std::string> commands(const std::string& beginning) {
  std::vector<std::string> out;
  std::ifstream readme(ROCI_SOURCE_DIR "/README.md");
  for (std::string line; std::getline(readme, line);)
    if (line.starts_with(beginning)) out.push_back(line.substr(0, line.find("  #")));
  return out;
}

// The goal of its example is asked of the mission that it starts, and is achieved. Two others have no way: why is told in
// the words of the mission, and to who asks --why in the planner's, too.
TEST(Readme, ItsGoalIsAchievedAndWhyOneIsNotIsToldToWhoAsks) {
  const std::string program = "build/release/bin/";
  const auto adds = commands(program + "roci goal add ");
  ASSERT_EQ(adds.size(), 1U);
  std::string add = adds.front().substr(program.size());
  if (add.find("--wait") == std::string::npos) add += " --wait";
  const fs::path folder = fs::temp_directory_path() / ("roci_readme_" + std::to_string(::getpid()));
  const fs::path asked = folder.string() + ".why", plain = folder.string() + ".plain";
  const auto far = [](const std::string& id, const std::string& more, const fs::path& out) {
    return "timeout 100 roci goal add " + id + " photo x=1000 y=60 --wait" + more + " >" + out.string() +
           " 2>&1 & ";
  };
  const services::process::DomainClaim domain;
  const std::string joins = "ROCI_DOMAIN=" + std::to_string(domain.id()) + " ROCI_DDS=cyclonedds ";
  const Ended ended =
      run("roci-launch " ROCI_SOURCE_DIR "/missions/planetary --dds cyclonedds --domain " +
          std::to_string(domain.id()) + " --speed 800 --headless --json --run-folder " + folder.string() +
          " >/dev/null & " + joins + far("far", " --why", asked) + joins + far("plain", "", plain) + joins +
          "timeout 100 " + add + "; code=$?; wait; rm -rf " + folder.string() + "; exit $code");
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("achieved"));
  const std::string why = text_of(asked), words = text_of(plain);
  EXPECT_THAT(why, AllOf(HasSubstr("out of reach: place-far (x=1000 y=60): the place lies outside the map"),
                         HasSubstr("\n  the planner: ")));
  EXPECT_THAT(words,
              AllOf(HasSubstr("out of reach: place-plain (x=1000 y=60): the place lies outside the map"),
                    Not(HasSubstr("the planner:"))));
  fs::remove(asked);
  fs::remove(plain);
}

}  // namespace
}  // namespace roci::scenario
