// What the services really publish and subscribe against the table of rights: each service of the missions is made on a
// transport that notes its endpoints, live and simulated.
#include "services/security/topic_rights.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "rehearsal/flight.hpp"
#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/time_watch.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::scenario {
namespace {

namespace transport = services::transport;
namespace security = services::security;
using security::Role;

// Topics by role, as they were opened.
struct Used {
  std::set<std::string> written;
  std::set<std::string> read;
};

class NotingTransport : public transport::Transport {
 public:
  NotingTransport(std::unique_ptr<Transport> under, Used& used) : under_(std::move(under)), used_(used) {}
  std::string_view vendor() const override { return under_->vendor(); }
  std::unique_ptr<transport::Writer> create_writer(const transport::EndpointDescription& endpoint,
                                                   transport::WriterEvents events) override {
    used_.written.insert(endpoint.topic);
    return under_->create_writer(endpoint, std::move(events));
  }
  std::unique_ptr<transport::Reader> create_reader(const transport::EndpointDescription& endpoint,
                                                   transport::ReaderEvents events) override {
    used_.read.insert(endpoint.topic);
    return under_->create_reader(endpoint, std::move(events));
  }
  std::string announcement() const override { return under_->announcement(); }
  std::optional<transport::Participant> participant_of(const transport::Guid& guid) override {
    return under_->participant_of(guid);
  }
  bool speaks_as(const transport::Guid& writer, std::string_view sender) const override {
    return under_->speaks_as(writer, sender);
  }

 private:
  std::unique_ptr<Transport> under_;
  Used& used_;
};

// A run folder of its own, so that nothing is written where the test stands.
struct RunFolder {
  RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "roci_rights_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

Used used_by(const std::filesystem::path& mission, const mission::ServiceEntry& entry, bool live) {
  Used used;
  services::node::NodeOptions options = rehearsal::node_options(mission, entry, 0);
  if (live) {
    options.clock = services::clock::ClockMode::live;
    options.epoch_unix_us = services::clock::unix_us();  // mission time begins now
  }
  services::Node node(
      options, std::make_unique<NotingTransport>(
                   transport::open_transport("inproc", {.domain = 3, .participant = entry.name}), used));
  const services::TimeWatch time_watch(node, {.reference = "another"});
  const RunFolder folder;
  services::RunSettings run{.mission = mission};
  run.run_folder = folder.path;
  run.settings = entry.settings;
  const auto service = rehearsal::make_of(entry)(node, run);
  if (live) node.spin_once(std::chrono::milliseconds(0));
  return used;
}

std::set<Role> roles_of(const mission::ServiceEntry& entry) {
  auto roles = security::roles_of_program(entry.program);
  if (!entry.rights.empty()) roles = {Role::service};
  for (const std::string& word : entry.rights) roles.insert(security::role_of(word).value());
  if (entry.clock_master) roles.insert(Role::master);
  return roles;
}

bool any_of(const std::set<Role>& some, const std::set<Role>& others) {
  return std::any_of(some.begin(), some.end(), [&](Role role) { return others.contains(role); });
}

const std::vector<std::filesystem::path> kMissions{ROCI_SOURCE_DIR "/missions/planetary",
                                                   ROCI_SOURCE_DIR "/missions/orbital",
                                                   ROCI_SOURCE_DIR "/missions/faster"};

class TopicRightsOfMissions : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(TopicRightsOfMissions, CoverWhatTheirServicesPublishAndSubscribe) {
  for (const mission::ServiceEntry& entry : rehearsal::crew_of(GetParam())) {
    for (const bool live : {false, true}) {
      const Used used = used_by(GetParam(), entry, live);
      EXPECT_TRUE(used.written.contains("roci/event")) << entry.name;
      for (const security::TopicRights& row : security::topic_rights()) {
        if (used.written.contains(row.topic)) {
          EXPECT_TRUE(any_of(row.writers, roles_of(entry))) << entry.name << " writes " << row.topic;
        }
        if (used.read.contains(row.topic)) {
          EXPECT_TRUE(any_of(row.readers, roles_of(entry))) << entry.name << " reads " << row.topic;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Missions, TopicRightsOfMissions, ::testing::ValuesIn(kMissions),
                         [](const auto& mission) { return mission.param.filename().string(); });

// What the services of this program use, over all missions.
Used used_by_program(const std::string& program) {
  Used out;
  for (const std::filesystem::path& mission : kMissions) {
    for (const mission::ServiceEntry& entry : rehearsal::crew_of(mission)) {
      if (entry.program != program) continue;
      for (const bool live : {false, true}) {
        const Used used = used_by(mission, entry, live);
        out.written.insert(used.written.begin(), used.written.end());
        out.read.insert(used.read.begin(), used.read.end());
      }
    }
  }
  return out;
}

// A right that no service of a program uses is one too many. The engines that plan all the time, pairs, decisions and
// maps that are told have no part in these missions; an executive of a pair writes the goals anew that it takes over,
// and an engine that plans all the time reads more.
TEST(TopicRightsOfServices, GiveNoMoreThanWhatIsUsed) {
  const std::set<std::string> elsewhere{"roci/exec/member",     "roci/exec/journal",
                                        "roci/exec/goal",       "roci/lease/request",
                                        "roci/lease/state",     "roci/decision",
                                        "roci/decision/answer", "roci/decision/receipt",
                                        "roci/planner/delta",   "roci/planner/receipt",
                                        "roci/goal/status",     "roci/plan",
                                        "roci/plan/step",       "roci/order",
                                        "roci/order/status",    "roci/network/order",
                                        "roci/network/status",  "roci/downlink/schedule",
                                        "roci/mission/outlook"};
  for (const mission::ServiceEntry& entry : rehearsal::crew_of(kMissions.front())) {
    const Used used = used_by_program(entry.program);
    std::set<Role> own = roles_of(entry);
    own.erase(Role::service);  // what every process may
    own.erase(Role::master);   // its topics are opened when the clock starts
    for (const security::TopicRights& row : security::topic_rights()) {
      if (elsewhere.contains(row.topic)) continue;
      const bool continuous =
          entry.program == "planner_svc" && (row.topic == "roci/goal" || row.topic == "roci/observation" ||
                                             row.topic == "roci/product" || row.topic == "roci/command/ack");
      const bool paired = entry.program == "exec_svc" && row.topic == "roci/goal";
      if (any_of(row.writers, own) && !paired) {
        EXPECT_TRUE(used.written.contains(row.topic)) << entry.name << " may write " << row.topic;
      }
      if (any_of(row.readers, own) && !continuous) {
        EXPECT_TRUE(used.read.contains(row.topic)) << entry.name << " may read " << row.topic;
      }
    }
  }
}

}  // namespace
}  // namespace roci::scenario
