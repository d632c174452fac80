// roci-plan started as its users start it, in a folder of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace roci::planner::temporal_pddl::testing {

class RociPlanProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / ("roci-plan-" + std::string(test->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  std::string read(const std::string& name) {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // Returns its exit code; what it says stands in the files `out` and `err`.
  int run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() +
                                "' && \"${ROCI_BIN:-" ROCI_BINARY_DIR "/bin}/roci-plan\" " + arguments +
                                " > out 2> err";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::filesystem::path folder_;
};

}  // namespace roci::planner::temporal_pddl::testing
