// No handler sees a sample of a participant whose types are not ours: shown with services in processes of their own
// against peers, ours and native ones, that announce the right contract, a changed one and none.
#include <gmock/gmock.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "services/node.hpp"
#include "services/publisher.hpp"
#include "services/transport/announcement.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/contract/robot/robot_service.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

using testing::Contains;
using testing::Each;
using testing::Not;
using testing::StartsWith;

constexpr char kOtherHash[] = "00000000";

// The announcement of this build, with another type roci::v1::Goal.
std::string changed_announcement() {
  std::string text = transport::own_announcement();
  const auto hash = text.find(";Goal=") + 6;
  return text.replace(hash, 8, kOtherHash);
}

std::string own_hash() {
  return transport::parse_announcement(transport::own_announcement())->hash_of("roci::v1::Goal");
}

class ContractTest : public testing::TestWithParam<Pairing> {
 protected:
  ContractTest() {
    std::filesystem::create_directories(mission_);
    std::ofstream(mission_ / "mission.yaml") << "name: contract\n";
  }
  ~ContractTest() override { std::filesystem::remove_all(mission_); }

  std::unique_ptr<ChildProcess> start_service(const std::string& name, const std::string& vendor,
                                              const std::vector<std::string>& environment = {},
                                              const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{ROCI_BINARY_DIR "/tests/contract-robot",
                                     "--mission",
                                     mission_.string(),
                                     "--run",
                                     "contract",
                                     "--name",
                                     name,
                                     "--dds",
                                     vendor,
                                     "--domain",
                                     std::to_string(domain_.id())};
    command.insert(command.end(), options.begin(), options.end());
    return std::make_unique<ChildProcess>(command, environment);
  }

  // A peer on the team's partition that names our run; `announcement`: "own" for this build's.
  std::unique_ptr<ChildProcess> start_peer(const std::string& kind, const std::string& role,
                                           const std::string& announcement) const {
    auto environment = peer_environment(kind);
    environment.insert(environment.end(), {"PEER_RUN=contract", "PEER_PARTITION=roci.team",
                                           "PEER_ANNOUNCEMENT=" + announcement});
    return std::make_unique<ChildProcess>(peer_command(kind, role, domain_.id()), environment);
  }

  process::DomainClaim domain_;
  std::filesystem::path mission_ =
      std::filesystem::temp_directory_path() / ("roci-contract-" + std::to_string(domain_.id()));
};

long times(const ChildProcess& process, const std::string& line) {
  return std::ranges::count(process.lines(), line);
}

// Writer: the peers' kind; reader: the service's vendor.
class ContractOfPeers : public ContractTest {};

TEST_P(ContractOfPeers, LetsPassWhatIsTheSameAndTellsOfTheRest) {
  const auto service = start_service("driver", GetParam().reader);
  const auto right = start_peer(GetParam().writer, "goal-writer", "own");
  const auto changed = start_peer(GetParam().writer, "goal-writer", changed_announcement());
  const auto without = start_peer(GetParam().writer, "goal-writer", "");
  changed->send("write changed look 1");
  without->send("write without look 1");
  right->send("write right look 1");
  EXPECT_TRUE(service->wait_for("heard goal right"));
  EXPECT_TRUE(service->wait_for("refused 2")) << "one sample of each of the others";
  EXPECT_TRUE(service->wait_for("mismatch roci/goal " + std::string(kOtherHash) + " by driver"));
  EXPECT_TRUE(service->wait_for("mismatch roci/goal none by driver"));

  // Who only reads is told of, too, though no sample of it can ever come.
  const auto reader = start_peer(GetParam().writer, "goal-reader", "own");
  const auto changed_reader = start_peer(GetParam().writer, "goal-reader", changed_announcement());
  EXPECT_TRUE(reader->wait_for("goal driver look 0"));
  changed->send("write changed look 2");
  EXPECT_TRUE(service->wait_for("refused 3"));
  while (times(*service, "mismatch roci/goal " + std::string(kOtherHash) + " by driver") < 2)
    ASSERT_TRUE(service->wait_for_more()) << "the changed reader was not told of";

  EXPECT_THAT(service->lines(), Not(Contains("heard goal changed")));
  EXPECT_THAT(service->lines(), Not(Contains("heard goal without")));
  EXPECT_EQ(times(*service, "mismatch roci/goal " + std::string(kOtherHash) + " by driver"), 2);
  EXPECT_EQ(times(*service, "mismatch roci/goal none by driver"), 1) << "once per participant and topic";
}

INSTANTIATE_TEST_SUITE_P(Wire, ContractOfPeers,
                         testing::Values(Pairing{"fastdds", "fastdds"}, Pairing{"cyclonedds", "cyclonedds"},
                                         Pairing{"native-fastdds", "fastdds"},
                                         Pairing{"native-fastdds", "cyclonedds"},
                                         Pairing{"native-cyclonedds", "fastdds"},
                                         Pairing{"native-cyclonedds", "cyclonedds"}),
                         [](const auto& instance) {
                           auto name = name_of(instance.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Two services of ours, one of another build.
class ContractOfServices : public ContractTest {};

TEST_P(ContractOfServices, BothSidesTellAndTheOtherTopicsGoOn) {
  const auto ours = start_service("driver", GetParam().reader);
  const auto theirs =
      start_service("other", GetParam().writer, {"ROBOT_ANNOUNCEMENT=" + changed_announcement()});
  for (const auto* side : {&ours, &theirs}) {
    const std::string other = side == &ours ? "other" : "driver";
    EXPECT_TRUE((*side)->wait_for("mismatch roci/goal " + std::string(kOtherHash) + " by driver"));
    EXPECT_TRUE((*side)->wait_for("mismatch roci/goal " + own_hash() + " by other"));
    EXPECT_TRUE((*side)->wait_for("heard observation " + other));
    EXPECT_TRUE((*side)->wait_for("heard request " + other));
    EXPECT_TRUE((*side)->wait_for("rounds " + other));
    EXPECT_TRUE((*side)->wait_for("refused 5"));
    EXPECT_THAT((*side)->lines(), Not(Contains("heard goal " + other)));
  }
}

// The clock waits for samples that are refused; whoever watches is told why.
TEST_P(ContractOfServices, AStandstillOfTheSimulatedClockIsExplained) {
  transport::TransportOptions options;
  options.domain = domain_.id();
  options.participant = "ground";
  node::NodeOptions observer;
  observer.name = "ground";
  observer.run = "contract";
  observer.clock = clock::ClockMode::observer;
  Node ground(observer, transport::open_transport(GetParam().reader, options));
  std::vector<std::string> told;
  subscribe(ground, topics::event, [&told](const v1::Event& event) {
    if (event.code() == "contract.mismatch") told.push_back(event.header().sender() + ": " + event.text());
  });
  ground.spin_once(std::chrono::milliseconds(0));
  const auto world =
      start_service("world", GetParam().reader, {}, {"--clock", "master", "--roster", "world,other"});
  const auto other = start_service(
      "other", GetParam().writer, {"ROBOT_ANNOUNCEMENT=" + changed_announcement()}, {"--clock", "simulated"});
  const auto give_up = std::chrono::steady_clock::now() + kDeadline;
  while (told.size() < 2 && std::chrono::steady_clock::now() < give_up)
    ground.spin_once(std::chrono::milliseconds(100));
  EXPECT_THAT(told, Contains(StartsWith("world: participant other")));
  EXPECT_THAT(told, Contains(StartsWith("other: participant world")));
  EXPECT_THAT(told, Each(testing::HasSubstr("build both from the same idl/")));
}

INSTANTIATE_TEST_SUITE_P(Transports, ContractOfServices, kEveryNetworkPairing, pairing_name);

// Without a network there is one process, and its participants are on threads.
TEST(ContractOfOneProcess, BothSidesTell) {
  const process::DomainClaim domain;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> said;
  std::vector<std::unique_ptr<Node>> nodes;
  std::vector<std::unique_ptr<Service>> services;
  for (const std::string name : {"driver", "other"}) {
    transport::TransportOptions options;
    options.domain = domain.id();
    options.participant = name;
    if (name == "other") options.announcement = changed_announcement();
    node::NodeOptions node_options;
    node_options.name = name;
    node_options.run = "contract";
    nodes.push_back(std::make_unique<Node>(node_options, transport::open_transport("inproc", options)));
    services.push_back(make_robot_service(*nodes.back(), [&, name](const std::string& line) {
      const std::lock_guard lock(mutex);
      said.push_back(name + ": " + line);
      changed.notify_all();
    }));
  }
  std::vector<std::jthread> threads;
  for (const auto& node : nodes) threads.emplace_back([&node] { node->run(); });
  const auto wait_for = [&](const std::string& line) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, kDeadline, [&] { return std::ranges::find(said, line) != said.end(); });
  };
  EXPECT_TRUE(wait_for("driver: mismatch roci/goal " + std::string(kOtherHash) + " by driver"));
  EXPECT_TRUE(wait_for("driver: mismatch roci/goal " + own_hash() + " by other"));
  EXPECT_TRUE(wait_for("other: mismatch roci/goal " + std::string(kOtherHash) + " by driver"));
  EXPECT_TRUE(wait_for("driver: heard observation other"));
  EXPECT_TRUE(wait_for("driver: refused 5"));
  EXPECT_TRUE(wait_for("other: refused 5"));
  for (const auto& node : nodes) node->stop();
  threads.clear();
  EXPECT_THAT(said, Not(Contains("driver: heard goal other")));
  EXPECT_THAT(said, Not(Contains("other: heard goal driver")));
}

}  // namespace
}  // namespace roci::services::contract
