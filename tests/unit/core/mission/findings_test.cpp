// A reader that collects goes on to the end of the file; one that does not ends with the first fault.
#include "core/mission/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/mission/entry.hpp"
#include "core/mission/finding_json.hpp"
#include "core/mission/finding_report.hpp"

namespace roci::mission {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Finding, IsTheTextOfAFileErrorTakenApart) {
  const Finding one = finding_of("/a/b.yaml:3:14: expected a number, not 'x'; write one; or two");
  EXPECT_EQ(one.file, "/a/b.yaml");
  EXPECT_EQ(one.line, 3);
  EXPECT_EQ(one.column, 14);
  EXPECT_EQ(one.what, "expected a number, not 'x'");
  EXPECT_EQ(one.remedy, "write one; or two");
  EXPECT_EQ(one.text(), "/a/b.yaml:3:14: expected a number, not 'x'");
}

TEST(Finding, MayHaveNoPlaceInItsFile) {
  const Finding file = finding_of("/a/b.yaml: cannot be read; check that the file exists");
  EXPECT_EQ(file.file, "/a/b.yaml");
  EXPECT_EQ(file.line, 0);
  EXPECT_EQ(file.what, "cannot be read");
  const Finding line = finding_of("a.pgm:7: too short");
  EXPECT_EQ(line.line, 7);
  EXPECT_EQ(line.column, 0);
  EXPECT_EQ(line.remedy, "");
  EXPECT_EQ(finding_of("nothing works").what, "nothing works");
}

TEST(Findings, AreKeptOnceAndSortedByPlace) {
  Findings all;
  all.add("b.yaml:1:1: later");
  all.add("a.yaml:10:1: second");
  all.add("a.yaml:9:5: first");
  all.add("a.yaml:9:5: first");
  ASSERT_EQ(all.size(), 3U);
  std::vector<std::string> texts;
  for (const Finding& one : all.sorted()) texts.push_back(one.what);
  EXPECT_THAT(texts, ElementsAre("first", "second", "later"));
}

TEST(Findings, AreOneForEachPlaceInWhatAReaderOfPddlSays) {
  Findings all;
  all.add(
      "d.pddl:3:4: error: unknown type 'lcoation' (did you mean 'location'? else declare it (in :types))\n"
      "d.pddl:9:1: warning: a comma (leave it out)\n"
      "and 3 more");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.all()[0].what, "unknown type 'lcoation'");
  EXPECT_EQ(all.all()[0].remedy, "did you mean 'location'? else declare it (in :types)");
  EXPECT_EQ(all.all()[1].line, 9);
  EXPECT_EQ(all.all()[1].severity, Severity::warning);
  EXPECT_THAT(all.all()[1].what, HasSubstr("a comma"));
  Findings one;
  one.add("m.yaml:1:1: it names no services; add for example\n  services:\n    - {name: a}");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.all()[0].remedy, "add for example\n  services:\n    - {name: a}");
}

class CollectedFile : public ::testing::Test {
 protected:
  CollectedFile() {
    std::ofstream(file_) << "speeds: [1, fast, 3, slow]\n"
                            "limits: {a: 1, b: none}\n"
                            "naem: x\n";
  }
  ~CollectedFile() override { fs::remove(file_); }

  std::vector<double> read(const Entry& root) {
    std::vector<double> out;
    root.allow_only({"name", "speeds", "limits"});
    root.at("speeds").each([&](const Entry& item) { out.push_back(item.number()); });
    root.at("limits").each_field(
        [&](const std::string&, const Entry& value) { out.push_back(value.number()); });
    root.attempt([&] { root.at("name"); });
    return out;
  }

  fs::path file_ = fs::temp_directory_path() / ("roci_collected_" + std::to_string(::getpid()) + ".yaml");
};

TEST_F(CollectedFile, IsReadToItsEndWithAllFaultsNoted) {
  Findings findings;
  EXPECT_THAT(read(Entry::load(file_, &findings)), ElementsAre(1, 3, 1));
  std::vector<std::string> told;
  for (const Finding& one : findings.sorted())
    told.push_back(std::to_string(one.line) + ":" + std::to_string(one.column) + " " + one.what);
  EXPECT_THAT(told, ElementsAre("1:1 'name' is missing", "1:13 expected a finite number, not 'fast'",
                                "1:22 expected a finite number, not 'slow'",
                                "2:19 expected a finite number, not 'none'", "3:1 unknown key 'naem'"));
  EXPECT_THAT(findings.all().front().remedy, HasSubstr("did you mean 'name'?"));
}

TEST_F(CollectedFile, EndsAtTheFirstFaultWithoutACollection) {
  try {
    read(Entry::load(file_));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr(":3:1: unknown key 'naem'"));
  }
}

TEST(FindingReport, HasEachWithItsPlaceAndBelowItWhatToDo) {
  Findings findings;
  findings.add({"b.yaml", 3, 7, Severity::error, "unknown key 'naem'", "did you mean 'name'?"});
  findings.add({"a.yaml", 0, 0, Severity::warning, "it is empty", ""});
  EXPECT_EQ(
      report(findings),
      "a.yaml: warning: it is empty\nb.yaml:3:7: error: unknown key 'naem'\n    did you mean 'name'?\n");
}

TEST(FindingJson, HasEachWithAllThatIsKnownOfIt) {
  Findings findings;
  findings.add({"b.yaml", 3, 7, Severity::error, "unknown key 'naem'", "did you mean 'name'?"});
  findings.add({"a.yaml", 0, 0, Severity::warning, "it is empty", ""});
  EXPECT_EQ(to_json(findings).dump(),
            R"([{"file":"a.yaml","line":0,"column":0,"severity":"warning","what":"it is empty","remedy":""},)"
            R"({"file":"b.yaml","line":3,"column":7,"severity":"error","what":"unknown key 'naem'",)"
            R"("remedy":"did you mean 'name'?"}])");
  EXPECT_EQ(to_json({}).dump(), "[]");
}

}  // namespace
}  // namespace roci::mission
