// Two robots in one domain, with the same programs: what is inner to one never reaches the other, what is the team's
// does, and services without a robot hear all and are heard by all; under both clocks, on every transport and mixed.
#include <gmock/gmock.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "services/node.hpp"
#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/contract/robot/robot_service.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {
namespace {

constexpr std::chrono::seconds kPatience{60};

struct Member {
  std::string name;
  std::string robot;
};

const std::vector<Member> kMembers{{"world", ""},      {"ground", ""},    {"a.driver", "a"},
                                   {"a.planner", "a"}, {"b.driver", "b"}, {"b.planner", "b"}};

bool hears_inner(const Member& one, const Member& other) {
  return one.robot == other.robot || one.robot.empty() || other.robot.empty();
}

std::vector<std::string> expected_of(const Member& member) {
  std::vector<std::string> lines;
  for (const Member& other : kMembers) {
    if (other.name == member.name) continue;
    lines.push_back("heard event " + other.name);
    lines.push_back("heard goal " + other.name);
    if (!hears_inner(member, other)) continue;
    lines.push_back("heard observation " + other.name);
    lines.push_back("heard request " + other.name);
  }
  return lines;
}

bool is_heard(const std::string& line) { return line.starts_with("heard "); }

std::vector<std::string> heard_in(std::vector<std::string> lines) {
  std::erase_if(lines, [](const std::string& line) { return !is_heard(line); });
  return lines;
}

struct Setting {
  std::string name;
  std::vector<std::string> vendors;  // one after the other, for the members
  std::string clock;
};

void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name << " " << setting.clock; }

std::vector<Setting> settings(bool network) {
  std::vector<Setting> all;
  for (const std::string clock : {"simulated", "live"}) {
    if (!network) all.push_back({"inproc", {"inproc"}, clock});
    if (!network) continue;
    all.push_back({"fastdds", {"fastdds"}, clock});
    all.push_back({"cyclonedds", {"cyclonedds"}, clock});
    all.push_back(
        {"mixed", {"fastdds", "cyclonedds", "cyclonedds", "fastdds", "fastdds", "cyclonedds"}, clock});
  }
  return all;
}

std::string setting_name(const testing::TestParamInfo<Setting>& info) {
  return info.param.name + "_" + info.param.clock;
}

const std::string& vendor_of(const Setting& setting, std::size_t member) {
  return setting.vendors[member % setting.vendors.size()];
}

// Lines of one member that runs on a thread of this process.
class Notes {
 public:
  void add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(line);
    changed_.notify_all();
  }
  bool wait_for(const std::string& line) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience,
                             [&] { return std::ranges::find(lines_, line) != lines_.end(); });
  }
  std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

class RobotsOfOneProcess : public testing::TestWithParam<Setting> {
 protected:
  node::NodeOptions options_of(const Member& member) const {
    node::NodeOptions options;
    options.name = member.name;
    options.robot = member.robot;
    options.run = "robots";
    if (GetParam().clock == "live") return options;
    const bool master = member.name == kMembers.front().name;
    options.clock = master ? clock::ClockMode::master : clock::ClockMode::simulated;
    if (master) {
      for (const Member& each : kMembers) options.master.roster.push_back(each.name);
    }
    return options;
  }
};

TEST_P(RobotsOfOneProcess, KeepWhatIsInnerToThemselves) {
  const process::DomainClaim domain;
  std::vector<Notes> notes(kMembers.size());
  std::vector<std::unique_ptr<Node>> nodes;
  std::vector<std::unique_ptr<Service>> services;
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    transport::TransportOptions options;
    options.domain = domain.id();
    options.participant = kMembers[i].name;
    nodes.push_back(std::make_unique<Node>(options_of(kMembers[i]),
                                           transport::open_transport(vendor_of(GetParam(), i), options)));
    services.push_back(
        make_robot_service(*nodes.back(), [&notes = notes[i]](const std::string& line) { notes.add(line); }));
  }
  std::vector<std::jthread> threads;
  for (const auto& node : nodes) threads.emplace_back([&node] { node->run(); });
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    for (const std::string& line : expected_of(kMembers[i])) EXPECT_TRUE(notes[i].wait_for(line)) << line;
    for (const Member& other : kMembers) {
      if (other.name == kMembers[i].name) continue;
      EXPECT_TRUE(notes[i].wait_for("rounds " + other.name)) << kMembers[i].name;
    }
  }
  for (const auto& node : nodes) node->stop();
  threads.clear();
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    EXPECT_THAT(heard_in(notes[i].lines()), testing::UnorderedElementsAreArray(expected_of(kMembers[i])))
        << kMembers[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, RobotsOfOneProcess, testing::ValuesIn(settings(false)), setting_name);

class RobotsInProcesses : public testing::TestWithParam<Setting> {
 protected:
  RobotsInProcesses() {
    std::filesystem::create_directories(mission_);
    std::ofstream(mission_ / "mission.yaml") << "name: robots\n";
  }
  ~RobotsInProcesses() override { std::filesystem::remove_all(mission_); }

  std::vector<std::string> command_of(std::size_t index) const {
    const Member& member = kMembers[index];
    std::vector<std::string> command{ROCI_BINARY_DIR "/tests/contract-robot",
                                     "--mission",
                                     mission_.string(),
                                     "--name",
                                     member.name,
                                     "--dds",
                                     vendor_of(GetParam(), index),
                                     "--domain",
                                     std::to_string(domain_.id())};
    if (!member.robot.empty()) command.insert(command.end(), {"--robot", member.robot});
    const bool master = GetParam().clock == "simulated" && index == 0;
    command.insert(command.end(), {"--clock", master ? "master" : GetParam().clock});
    if (master) {
      std::string roster;
      for (const Member& each : kMembers) roster += (roster.empty() ? "" : ",") + each.name;
      command.insert(command.end(), {"--roster", roster});
    }
    return command;
  }

  process::DomainClaim domain_;
  std::filesystem::path mission_ =
      std::filesystem::temp_directory_path() / ("roci-robots-" + std::to_string(domain_.id()));
};

TEST_P(RobotsInProcesses, KeepWhatIsInnerToThemselves) {
  std::vector<std::unique_ptr<ChildProcess>> processes;
  for (std::size_t i = 0; i < kMembers.size(); ++i)
    processes.push_back(std::make_unique<ChildProcess>(command_of(i)));
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    for (const std::string& line : expected_of(kMembers[i]))
      EXPECT_TRUE(processes[i]->wait_for(line, kPatience)) << kMembers[i].name << ": " << line;
    for (const Member& other : kMembers) {
      if (other.name == kMembers[i].name) continue;
      EXPECT_TRUE(processes[i]->wait_for("rounds " + other.name, kPatience)) << kMembers[i].name;
    }
    EXPECT_THAT(heard_in(processes[i]->lines()), testing::UnorderedElementsAreArray(expected_of(kMembers[i])))
        << kMembers[i].name;
  }
  if (GetParam().clock == "live") return;
  for (const auto& process : processes) EXPECT_EQ(process->finish(), 0);
}

INSTANTIATE_TEST_SUITE_P(Transports, RobotsInProcesses, testing::ValuesIn(settings(true)), setting_name);

}  // namespace
}  // namespace roci::services::contract
