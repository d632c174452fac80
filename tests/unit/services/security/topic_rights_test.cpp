// The table of rights against the table of topics, and the permissions that come of it.
#include "services/security/topic_rights.hpp"

#include <gmock/gmock.h>

#include "services/security/documents.hpp"
#include "tests/contract/hostile/every_topic.hpp"

namespace roci::services::security {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(TopicRights, EveryTopicHasOneRow) {
  std::vector<std::string> topics, rows;
  contract::hostile::for_each_topic([&](const auto& topic) { topics.emplace_back(topic.name); });
  for (const TopicRights& row : topic_rights()) rows.push_back(row.topic);
  EXPECT_THAT(rows, testing::UnorderedElementsAreArray(topics));
}

TEST(TopicRights, OnlyExecutivesAndDedicatedOnesCommand) {
  for (const TopicRights& row : topic_rights()) {
    EXPECT_FALSE(row.writers.empty()) << row.topic;
    EXPECT_FALSE(row.readers.empty()) << row.topic;
    if (row.topic == "roci/command") {
      EXPECT_EQ(row.writers, (std::set{Role::executive, Role::commander}));
    }
    if (row.topic == "roci/order") {
      EXPECT_EQ(row.writers, std::set{Role::console});
    }
  }
  EXPECT_THAT(writable(roles_of_program("pathplan_svc"), transport::Scope::robot),
              Not(Contains("roci/command")));
}

TEST(TopicRights, WordsAndRolesAreOneToOne) {
  EXPECT_EQ(role_of(word_of(Role::path_planner)), Role::path_planner);
  EXPECT_EQ(role_of("king"), std::nullopt);
}

TEST(TopicRights, AProgramHasTheRolesOfItsDeclaration) {
  EXPECT_EQ(roles_of_program("dedicated_svc"), (std::set{Role::service, Role::owner, Role::commander}));
  EXPECT_EQ(roles_of_program("planner_svc"), (std::set{Role::service, Role::planner, Role::resolver}));
  EXPECT_EQ(roles_of_program("roci-plan"), std::set<Role>{});
  EXPECT_EQ(roles_of_program("beacon"), std::set<Role>{});
}

TEST(Permissions, InnerTopicsAreThoseOfTheOwnRobot) {
  const std::string text =
      permissions("exec_svc", "CN=exec_svc", roles_of_program("exec_svc"), "rover", {0, 1});
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("<topic>roci/command</topic>"), HasSubstr("<partition>roci.inner.rover</partition>"),
            HasSubstr("<partition>roci.team</partition>"), HasSubstr("<default>DENY</default>"),
            HasSubstr("<not_after>1970-01-01T00:00:01Z</not_after>"), Not(HasSubstr("roci.inner.*"))));
}

}  // namespace
}  // namespace roci::services::security
