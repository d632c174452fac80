#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kFolders = {"core",         "services",       "planner_svc", "exec_svc",
                                           "pathplan_svc", "dedicated_svc",  "arm_svc",     "science_svc",
                                           "sim_svc",      "ground_console", "rehearsal"};

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
  EXPECT_THAT(
      broken(file("planner_svc/timeline_htn/checking/a.cpp", "planner_svc/timeline_htn/search/ground.hpp")),
      ElementsAre(HasSubstr("the checker sees the model")));
  EXPECT_THAT(
      broken(file("planner_svc/timeline_htn/checking/a.cpp", "planner_svc/timeline_htn/model/model.hpp")),
      IsEmpty());
  EXPECT_THAT(broken(file("planner_svc/utility_htn/checking/a.cpp", "core/temporal/timelines/line.hpp")),
              ElementsAre(HasSubstr("the checker sees the model")));
  EXPECT_THAT(broken(file("planner_svc/temporal_pddl/search/a.cpp", "core/pddl/ast.hpp")),
              ElementsAre(HasSubstr("never sees PDDL text")));
  EXPECT_THAT(broken(file("core/temporal/common/a.cpp", "vector")), ElementsAre(HasSubstr("has a name")));
  EXPECT_THAT(broken(file("services/node/a.cpp", "sqlite3.h")),
              ElementsAre(HasSubstr("is linked by exec_svc alone")));
  EXPECT_THAT(broken(file("arm_svc/a.cpp", "ompl/base/Planner.h")), IsEmpty());
  SourceFile source = file("exec_svc/a.cpp", "chrono");
  source.lines = {"const auto t = std::chrono::steady_clock::now();"};
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("asks the system for the time")));
  for (const char* line : {"fs::rename(next, file);", "  std::filesystem::rename(next, file, error);",
                           "rename(next.c_str(), file.c_str());"}) {
    source.lines = {line};
    EXPECT_THAT(broken(source), ElementsAre(HasSubstr("core/durable does, and syncs its folder"))) << line;
  }
  source.lines = {"  rename(activity.parent);"};
  EXPECT_THAT(broken(source), IsEmpty()) << "of something else than a file";
  source.lines = {"if (mission == \"planetary\") return;"};
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("missions are data")));
  source.lines = {"endpoint.partitions = {\"roci.team\"};"};
  EXPECT_THAT(broken(source),
              ElementsAre(HasSubstr("names a DDS partition"), HasSubstr("names a DDS partition")));
  source.lines.assign(601, "");
  EXPECT_THAT(broken(source), ElementsAre(HasSubstr("601 lines")));
}

TEST(ArchitectureTest, OfTheExecutiveOnlyMissionsAndProblemsKnowPddl) {
  const SourceFile tree = file("core/pddl/ast.hpp", "vector");
  const SourceFile writer = file("exec_svc/problem/pddl_problem.hpp", "core/pddl/ast.hpp");
  EXPECT_THAT(broken_rules({tree, writer, file("exec_svc/mission/a.cpp", "core/pddl/ast.hpp")}), IsEmpty());
  EXPECT_THAT(broken_rules({tree, file("exec_svc/reactor/a.cpp", "core/pddl/ast.hpp")}),
              ElementsAre(HasSubstr("exec_svc/reactor/a.cpp: reaches core/pddl/ast.hpp")));
  EXPECT_THAT(
      broken_rules({tree, writer, file("exec_svc/journal/a.cpp", "exec_svc/problem/pddl_problem.hpp")}),
      ElementsAre(HasSubstr("exec_svc/problem/pddl_problem.hpp -> core/pddl/ast.hpp")));
  EXPECT_THAT(broken_rules({tree, file("exec_svc/a_service.cpp", "core/pddl/ast.hpp")}),
              ElementsAre(HasSubstr("exec_svc/a_service.cpp: reaches")));
}

TEST(ArchitectureTest, ACommentDoesNotTearItsDeclaration) {
  SourceFile source = file("core/temporal/a.hpp", "vector");
  source.lines = {"  std::vector<int> values;  ///< Of the longest name."};
  EXPECT_THAT(broken_rules({source}), IsEmpty());
  source.lines = {"  std::vector<int>", "      values;  ///< Of the longest name."};
  EXPECT_THAT(broken_rules({source}), ElementsAre(HasSubstr("stands torn")));
}

TEST(ArchitectureTest, ACommentFitsTheScreen) {
  SourceFile source = file("core/temporal/a.cpp", "vector");
  const auto comment_of = [](std::size_t columns) { return "  // " + std::string(columns - 5, 'x'); };
  source.lines = {comment_of(120), "  f(" + std::string(200, 'x') + ");"};
  EXPECT_THAT(broken_rules({source}), IsEmpty());
  source.lines = {comment_of(121)};
  EXPECT_THAT(broken_rules({source}), ElementsAre(HasSubstr("wider than 120 columns")));
}

TEST(ArchitectureTest, AHeaderSaysWhatItOffers) {
  const auto broken = [](std::vector<std::string> lines) {
    return broken_rules({{"core/temporal/a.hpp", {}, std::move(lines)}});
  };
  EXPECT_THAT(broken({"// The head.", "class Plan final : public Base<int> {", "};"}),
              ElementsAre(HasSubstr("Plan has no comment above it")));
  EXPECT_THAT(broken({"/// Holds a plan.", "class Plan {", "};", "", "enum class Kind {", "  a", "};"}),
              ElementsAre(HasSubstr("Kind has no comment")));
  EXPECT_THAT(broken({"struct Outer::Inner {", "};"}), ElementsAre(HasSubstr("Outer::Inner has no comment")));
  EXPECT_THAT(broken({"template <class T>", "requires std::integral<T>", "struct Box {"}),
              ElementsAre(HasSubstr("Box has no comment")));
  EXPECT_THAT(broken({"template <class T>", "std::vector<T> sorted(std::vector<T> items,", "    bool up) {"}),
              ElementsAre(HasSubstr("sorted has no comment")));
  EXPECT_THAT(
      broken({"/// Holds one T.", "template <class T>", "struct Box {", "  struct Lid {", "  };", "};"}),
      IsEmpty());
  EXPECT_THAT(broken({"class Node;", "struct Wide", "    : Base;", "struct Empty {};  ///< stands for none"}),
              IsEmpty());
  EXPECT_THAT(broken({"template <>", "struct std::hash<Id> {", "};"}), IsEmpty());
  EXPECT_THAT(broken({"namespace roci::temporal {", "namespace detail {", "struct Part {", "};",
                      "}  // namespace detail", "}  // namespace roci::temporal"}),
              IsEmpty());
  EXPECT_THAT(broken({"template <class A>", "void fields(A& a) {", "}"}), IsEmpty());
  EXPECT_THAT(broken_rules({{"core/temporal/a.cpp", {}, {"struct Local {", "};"}}}), IsEmpty());
}

SourceFile in_namespace(const std::string& path, const std::string& name) {
  return {path, {}, {"namespace " + name + " {", "int f();", "}  // namespace " + name}};
}

TEST(ArchitectureTest, AFolderHasOneNamespace) {
  const auto broken = [](const SourceFile& source) { return broken_rules({source}); };
  EXPECT_THAT(broken(in_namespace("core/pddl/a.hpp", "roci::pddl")), IsEmpty());
  EXPECT_THAT(broken(in_namespace("core/pddl/a.hpp", "roci::pddl::grammar")), IsEmpty());
  EXPECT_THAT(broken(in_namespace("services/node.hpp", "roci::services")), IsEmpty());
  EXPECT_THAT(broken(in_namespace("ground_console/cli/watch/a.cpp", "roci::console::cli::watch")), IsEmpty());
  EXPECT_THAT(broken(in_namespace("services/clock/a.hpp", "roci::services")),
              ElementsAre(HasSubstr("its folder's is roci::services::clock")));
  EXPECT_THAT(broken(in_namespace("arm_svc/a.cpp", "roci::arms")),
              ElementsAre(HasSubstr("its folder's is roci::arm")));
  EXPECT_THAT(broken_rules({in_namespace("services/node.hpp", "roci::services::clock"),
                            in_namespace("services/clock/a.hpp", "roci::services::clock")}),
              ElementsAre(HasSubstr("services/node.hpp: opens namespace roci::services::clock")));
}

TEST(ArchitectureTest, ClassesOfOthersMayBeDeclared) {
  SourceFile source = in_namespace("arm_svc/a.hpp", "roci::arm");
  source.lines.insert(source.lines.begin(), {"namespace YAML {", "class Node;", "}"});
  EXPECT_THAT(broken_rules({source}), IsEmpty());
  source.lines[1] = "class Node {};  ///< of theirs";
  EXPECT_THAT(broken_rules({source}), ElementsAre(HasSubstr("opens namespace YAML")));
}

TEST(ArchitectureTest, NobodyReachesAFloorAboveThroughAnyChain) {
  EXPECT_THAT(broken_rules({file("services/rpc/a.cpp", "services/node/b.hpp"),
                            file("services/node/b.hpp", "services/clock/c.hpp"),
                            file("services/clock/c.hpp", "core/temporal/d.hpp"),
                            file("core/temporal/d.hpp", "vector")}),
              IsEmpty());
  EXPECT_THAT(
      broken_rules({file("services/clock/a.cpp", "services/node.hpp"), file("services/node.hpp", "vector")}),
      ElementsAre(HasSubstr("services/clock/a.cpp: reaches services/node.hpp, a floor above it")));
  EXPECT_THAT(broken_rules({file("services/node/a.cpp", "tests/b.hpp"),
                            file("tests/b.hpp", "services/rpc/c.hpp"), file("services/rpc/c.hpp", "vector")}),
              ElementsAre(HasSubstr("services/node/a.cpp -> tests/b.hpp -> services/rpc/c.hpp")));
  EXPECT_THAT(broken_rules({file("services/attic/a.cpp", "vector")}),
              ElementsAre(HasSubstr("stands on no floor")));
}

}  // namespace
}  // namespace roci::architecture
