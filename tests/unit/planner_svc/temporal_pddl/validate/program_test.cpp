// The command line: exit codes and output of roci-validate.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace {

using ::testing::HasSubstr;

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / ("roci-validate-" + std::string(test->name()));
    std::filesystem::create_directories(folder_);
    write("domain",
          "(define (domain d) (:modules (:module m (:function (t))))"
          "(:predicates (p)) (:durative-action a :parameters () :duration (= ?duration (t)) :effect (at end "
          "(p))))");
    write("problem", "(define (problem x) (:domain d) (:init) (:goal (p)) (:metric minimize (total-time)))");
    write("plan", "0.000: (a) [2.000]\n");
    write("functions", "(t) 2\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  std::string read(const std::string& name) {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  int run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() + "' && '" ROCI_BINARY_DIR "/bin/roci-validate' " +
                                arguments + " > out 2> err";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::filesystem::path folder_;
};

TEST_F(Program, ValidPlan) {
  EXPECT_EQ(run("domain problem plan --functions functions"), 0) << read("err");
  EXPECT_THAT(read("out"), HasSubstr("valid: 1 steps, makespan 2.000, metric 2"));
  EXPECT_EQ(run("domain problem plan --functions functions --json"), 0);
  const auto json = nlohmann::json::parse(read("out"));
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["makespan"], 2.0);
  EXPECT_EQ(json["metric"], 2.0);
  EXPECT_TRUE(json["violations"].empty());
}

TEST_F(Program, InvalidPlan) {
  write("plan", "; a comment\n0.000: (a) [3.000]\n");
  EXPECT_EQ(run("domain problem plan --functions functions"), 1);
  EXPECT_THAT(read("out"),
              HasSubstr("plan:2: at 0.000: (a): duration 3 against (= ?duration (t)), which is 2"));
  EXPECT_EQ(run("domain problem plan --functions functions --json"), 1);
  const auto violation = nlohmann::json::parse(read("out"))["violations"].at(0);
  EXPECT_EQ(violation["kind"], "time");
  EXPECT_EQ(violation["step"], 0);
  EXPECT_EQ(violation["line"], 2);
  EXPECT_EQ(violation["action"], "(a)");
  EXPECT_EQ(violation["condition"], "(= ?duration (t))");
}

TEST_F(Program, MissingFunctionValues) {
  EXPECT_EQ(run("domain problem plan"), 1);
  EXPECT_THAT(read("out"), HasSubstr("external function (t) has no value"));
}

TEST_F(Program, UnreadableInput) {
  EXPECT_EQ(run("domain problem nowhere"), 2);
  EXPECT_THAT(read("err"), HasSubstr("nowhere: error: cannot be read"));
  EXPECT_EQ(run("domain problem ."), 2);
  EXPECT_EQ(run("domain problem"), 2);
  EXPECT_EQ(run("domain problem plan --what"), 2);
  write("plan", "0.000: (a [2.000]\n");
  EXPECT_EQ(run("domain problem plan"), 2);
  EXPECT_THAT(read("err"), HasSubstr("plan:1:"));
  write("domain",
        "(define (domain d) (:functions (f)) (:durative-action a :parameters () :duration (= ?duration 2)\n"
        ":effect (increase (f) (* #t 1))))");
  EXPECT_EQ(run("domain problem plan"), 2);
  EXPECT_EQ(run("--help"), 0);
}

TEST_F(Program, RefusesContinuousEffectsByNameAndLine) {
  write("domain",
        "(define (domain d) (:predicates (p)) (:functions (f))\n(:durative-action burn :parameters ()"
        " :duration (= ?duration 2)\n :effect (increase (f) (* #t 1))))");
  EXPECT_EQ(run("domain problem plan"), 2);
  EXPECT_THAT(read("err"), HasSubstr("domain:3:10: error: action 'burn' has a continuous effect on (f)"));
}

}  // namespace
