// The outcome of a run with one executive, and with several.
#include "services/process/run_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class RunSummary : public ::testing::Test {
 protected:
  RunSummary() { fs::create_directories(folder_); }
  ~RunSummary() override { fs::remove_all(folder_); }

  void write(const std::string& file, const std::string& result, int achieved, int failed) const {
    std::ofstream(folder_ / file) << json{
        {"format", 1},
        {"seed", 7},
        {"result", result},
        {"goals", {{"achieved", achieved}, {"failed", failed}}},
        {"planner", {{"calls", 2}, {"max_s", 0.5}}},
        {"replans", 1},
        {"trace_sha256", file}}.dump();
  }
  json read(const std::vector<std::string>& executives) const {
    mission::ServiceList list;
    for (const std::string& name : executives) {
      mission::ServiceEntry entry;
      entry.name = name;
      entry.program = kExecutive;
      list.services.push_back(entry);
    }
    return read_summary(folder_, list);
  }

  fs::path folder_ = fs::temp_directory_path() / ("roci_summary_" + std::to_string(::getpid()));
};

TEST_F(RunSummary, OfOneExecutiveIsItsOwn) {
  EXPECT_TRUE(read({"exec_svc"}).empty());
  write("summary.json", "partial", 1, 1);
  EXPECT_EQ(read({"exec_svc"}).value("result", ""), "partial");
  EXPECT_FALSE(read({"exec_svc"}).contains("executives"));
}

TEST_F(RunSummary, OfSeveralAddsUpAndKeepsEachOnesOwn) {
  write("a.summary.json", "achieved", 2, 0);
  write("b.summary.json", "achieved", 1, 0);
  const json both = read({"a", "b"});
  EXPECT_EQ(both.value("result", ""), "achieved");
  EXPECT_EQ(both["goals"].value("achieved", 0), 3);
  EXPECT_EQ(both["planner"].value("calls", 0), 4);
  EXPECT_EQ(both.value("seed", 0), 7);
  EXPECT_EQ(both["executives"]["b"].value("trace_sha256", ""), "b.summary.json");
}

TEST_F(RunSummary, IsAsGoodAsTheWorstOfThoseThatHadGoals) {
  write("a.summary.json", "achieved", 2, 0);
  write("b.summary.json", "partial", 1, 1);
  EXPECT_EQ(read({"a", "b"}).value("result", ""), "partial");
  write("c.summary.json", "failed", 0, 1);
  EXPECT_EQ(read({"a", "b", "c"}).value("result", ""), "failed");
  write("d.summary.json", "failed", 0, 0);
  EXPECT_EQ(read({"a", "d"}).value("result", ""), "achieved") << "nobody asked anything of d";
  EXPECT_EQ(read({"a", "e"}).value("result", ""), "failed") << "e left nothing";
}

TEST_F(RunSummary, OfANewerFormatIsRefused) {
  std::ofstream(folder_ / "a.summary.json") << R"({"format": 99})";
  EXPECT_THROW(read({"a", "b"}), std::runtime_error);
}

}  // namespace
}  // namespace roci::services::process
