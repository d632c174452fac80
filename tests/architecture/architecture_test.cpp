#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kFolders = {"core",           "services", "planner_svc", "exec_svc",
                                           "pathplan_svc",   "arm_svc",  "science_svc", "sim_svc",
                                           "ground_console", "rehearsal"};

TEST(ArchitectureTest, TheTreeKeepsItsRules) {
  const auto files = read_sources(ROCI_SOURCE_DIR, kFolders);
  EXPECT_GT(files.size(), 100U);
  EXPECT_THAT(broken_rules(files), IsEmpty());
}

SourceFile file(const std::string& path, const std::string& include) { return {path, {include}, {}}; }

// Each rule must be able to fail.
TEST(ArchitectureTest, EachRuleCanBeBroken) {
  const auto broken = [](const SourceFile& source) { return broken_rules({source}); };
  EXPECT_THAT(broken(file("core/pddl/a.cpp", "services/node.hpp")),
              ElementsAre(HasSubstr("core/ knows no process")));
  EXPECT_THAT(broken(file("services/node.cpp", "exec_svc/x.hpp")),
              ElementsAre(HasSubstr("services/ knows no process")));
  EXPECT_THAT(broken(file("exec_svc/exec_service.cpp", "arm_svc/ik.hpp")),
              ElementsAre(HasSubstr("no process includes another")));
  EXPECT_THAT(broken(file("arm_svc/ik.cpp", "roci_idl/goal.h")),
              ElementsAre(HasSubstr("translate at the door")));
  EXPECT_THAT(broken(file("arm_svc/arm_service.cpp", "roci_idl/goal.h")), IsEmpty());
  EXPECT_THAT(broken(file("exec_svc/exec_service.cpp", "fastdds/dds/domain/DomainParticipant.hpp")),
              ElementsAre(HasSubstr("vendor headers")));
  EXPECT_THAT(
      broken(file("planner_svc/temporal_pddl/validate/a.cpp", "planner_svc/temporal_pddl/planner.hpp")),
      ElementsAre(HasSubstr("the validator shares only core/pddl")));
  EXPECT_THAT(broken(file("planner_svc/temporal_pddl/search/a.cpp", "core/pddl/ast.hpp")),
              ElementsAre(HasSubstr("never sees PDDL text")));
  EXPECT_THAT(broken(file("core/common/a.cpp", "vector")), ElementsAre(HasSubstr("has a name")));
  SourceFile source = file("exec_svc/a.cpp", "chrono");
  source.lines = {"const auto t = std::chrono::steady_clock::now();"};
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("asks the system for the time")));
  source.lines = {"if (mission == \"planetary\") return;"};
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("missions are data")));
  source.lines.assign(601, "");
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("601 lines")));
}

}  // namespace
}  // namespace roci::architecture
