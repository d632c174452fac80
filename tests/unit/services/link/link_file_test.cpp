#include "services/link/link_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace roci::services::link {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

class LinkFile : public testing::Test {
 protected:
  LinkFile()
      : folder_(std::filesystem::temp_directory_path() / ("roci_links_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / "scenarios");
    write("mission.yaml",
          "robots: [rover, scout]\nservices: [{name: sim_svc}, {name: exec_svc, robot: rover}]\n");
  }
  ~LinkFile() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  LinkTable load(const std::string& links) {
    write("scenarios/day.yaml", "duration_s: 100\nlinks:\n" + links);
    return load_links(folder_, "day", 7);
  }
  std::string refusal(const std::string& links) {
    try {
      load(links);
      return "taken";
    } catch (const mission::FileError& error) {
      return error.what();
    }
  }

  std::filesystem::path folder_;
};

TEST_F(LinkFile, ReadsEverySetting) {
  const LinkTable table = load(
      "  - {ends: [ground, rover], windows: [[10, 50], [70, 80]], cuts: [[20, 30]], light_time_s: 4.5,\n"
      "     rate_bit_s: 2000, loss: 0.25}\n"
      "  - {name: radio, ends: [rover, scout]}\n");
  ASSERT_EQ(table.links().size(), 2U);
  const Link& up = table.links()[0];
  EXPECT_EQ(up.name, "ground-rover");
  EXPECT_EQ(up.open.closes(15s), 20s);
  EXPECT_EQ(up.open.next_open(60s), 70s);
  EXPECT_EQ(up.light_time, 4500ms);
  EXPECT_EQ(up.rate_bit_s, 2000);
  EXPECT_EQ(up.loss, 0.25);
  EXPECT_EQ(table.links()[1].name, "radio");
  EXPECT_TRUE(table.links()[1].open.open(-1s));
  EXPECT_EQ(table.seed(), 7U);
  EXPECT_EQ(table.party("exec_svc").robot, "rover");
}

TEST_F(LinkFile, WithoutLinksOrWithoutAScenarioThereAreNone) {
  write("scenarios/day.yaml", "duration_s: 100\n");
  EXPECT_TRUE(load_links(folder_, "day", 1).empty());
  EXPECT_TRUE(load_links(folder_, "another", 1).empty());
  EXPECT_TRUE(load_links("", "nominal", 1).empty());
}

TEST_F(LinkFile, BadInputIsRefusedWithPlaceAndRemedy) {
  const auto of_line_3 = [](const std::string& what) {
    return AllOf(HasSubstr("day.yaml:3:"), HasSubstr(what));
  };
  EXPECT_THAT(refusal("  - {ends: [ground]}\n"), of_line_3("ends: [ground, rover]"));
  EXPECT_THAT(refusal("  - {name: x}\n"), of_line_3("'ends' is missing"));
  EXPECT_THAT(refusal("  - {ends: [ground, mars]}\n"),
              of_line_3("choose of: ground, rover, scout, sim_svc, exec_svc"));
  EXPECT_THAT(refusal("  - {ends: [rover, rover]}\n"), of_line_3("a link joins two"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], los: 0.1}\n"), of_line_3("unknown key 'los'"));
  for (const char* loss : {"1.1", "-0.1", ".nan", "much"})
    EXPECT_THAT(refusal("  - {ends: [rover, ground], loss: " + std::string(loss) + "}\n"),
                HasSubstr("day.yaml:3:"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], loss: 1.1}\n"), of_line_3("a share from 0 to 1"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], light_time_s: -1}\n"), of_line_3("from 0 to 86400 s"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], rate_bit_s: 0}\n"),
              of_line_3("leave it out for no limit"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], windows: []}\n"), of_line_3("windows is empty"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], windows: [[5, 1]]}\n"), of_line_3("swap the two"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], cuts: [[1, 5], [4, 6]]}\n"),
              of_line_3("sort or join them"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground], cuts: [[1, 5, 6]]}\n"), of_line_3("[from, to]"));
  EXPECT_THAT(refusal("  - {ends: [rover, ground]}\n  - {ends: [ground, rover]}\n"),
              AllOf(HasSubstr("day.yaml:4:"), HasSubstr("put both into one")));
  EXPECT_THAT(refusal("  - {name: a, ends: [rover, ground]}\n  - {name: a, ends: [ground, scout]}\n"),
              AllOf(HasSubstr("day.yaml:4:"), HasSubstr("a name of its own")));
  EXPECT_THAT(refusal("  one: two\n"), of_line_3("expected a list"));
}

}  // namespace
}  // namespace roci::services::link
