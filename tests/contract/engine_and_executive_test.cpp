// The utility-driven engine and the executive as services on every transport, beside a robot that obeys: both die and
// come back, the plan goes on, and what the engine did is told in its order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "exec_svc/exec_service.hpp"
#include "planner_svc/planner_service.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci {
namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;
using namespace std::chrono_literals;
using ::testing::IsSupersetOf, ::testing::UnorderedElementsAre;

struct Vendors {
  const char* name;
  std::string engine;
  std::string others;
};

class EngineAndExecutive : public ::testing::TestWithParam<Vendors> {
 protected:
  EngineAndExecutive() {
    fs::create_directories(folder_);
    services::subscribe(robot_, topics::command, [this](const v1::Command& command) { obey(command); });
    services::subscribe(robot_, topics::event, [this](const v1::Event& event) {
      events_.push_back(event.code());
      if (event.code() == "planner.cycle") cycles_.push_back(event.text());
    });
    services::subscribe(robot_, topics::mission_status,
                        [this](const v1::MissionStatus& status) { mission_ = status; });
    services::subscribe(robot_, topics::downlink_schedule,
                        [this](const v1::DownlinkSchedule& schedule) { schedules_.push_back(schedule); });
    services::subscribe(robot_, topics::mission_outlook,
                        [this](const v1::MissionOutlook& outlook) { outlooks_.push_back(outlook); });
    services::subscribe(robot_, topics::plan, [this](const v1::Plan& plan) {
      for (const v1::PlanActivity& one : plan.activities()) activities_.insert(one.id());
    });
    robot_.at(0s, [this] {
      observe("lander.arm", temporal::state("rests"));
      observe("lander.eye", temporal::state("idle"));
      observe("lander.radio", temporal::state("quiet"));
      observe("lander.lamp", temporal::state("lit"));
      observe("lander.battery", 600000.0);
    });
    robot_.at(10s, [this] {
      v1::Goal goal;
      goal.issuer("ground");
      goal.id("network");
      goal.goal_kind("mission");
      goals_.write(goal);
    });
    start("planner_svc", 1);
    start("exec_svc", 1);
  }
  ~EngineAndExecutive() override {
    run_.join();
    planner_.reset();
    executive_.reset();
    fs::remove_all(folder_);
  }

  void start(const std::string& name, std::uint32_t incarnation) {
    services::RunSettings settings;
    settings.mission = ROCI_SOURCE_DIR "/tests/missions/lander";
    settings.run_folder = folder_;
    const bool plans = name == "planner_svc";
    services::Node& node = run_.add(name, incarnation, plans ? GetParam().engine : GetParam().others);
    if (plans) {
      planner_ = planner::make_service(node, settings);
    } else {
      executive_ = exec::make_service(node, settings);
    }
  }

  // The service dies then without a word, and starts again as its next incarnation.
  void kill_at(temporal::Time when, const std::string& name) {
    killed_ = name;
    run_.node(name).at(when, [this, name] {
      (name == "planner_svc" ? planner_ : executive_).reset();
      throw services::Crash{};
    });
  }

  void fly() {
    robot_.at(8000s, [this] { robot_.stop(); });
    run_.start();
    if (killed_) {
      run_.wait_for_crash(*killed_);
      start(*killed_, 2);
    }
    run_.run();
  }

  // Everything is done once and in its chain's order, and no version was refused.
  void expect_all_done() const {
    EXPECT_EQ(mission_.outcome(), "achieved");
    EXPECT_THAT(done_, UnorderedElementsAre("dig near", "image near", "send near", "dig far", "image far",
                                            "send far", "image horizon", "send view", "farewell"));
    for (const char* fault : {"plan.refused", "plan.broken", "planner.defect"})
      EXPECT_EQ(std::ranges::count(events_, fault), 0) << fault;
  }

  void observe(const std::string& timeline, const temporal::Value& value) {
    v1::Observation out;
    out.timeline(timeline);
    out.observed(services::wire::to_wire(value));
    out.sampled_us(robot_.now().count());
    observations_.write(out);
  }

 private:
  void tell(const v1::Command& command, v1::CommandStage stage) {
    v1::CommandAck out;
    out.commander(command.commander());
    out.epoch(command.epoch());
    out.activity(command.activity());
    out.attempt(command.attempt());
    out.stage(stage);
    out.owner("sim_svc");
    if (stage != v1::STAGE_UNKNOWN) words_[{command.activity(), command.attempt()}] = stage;
    acks_.write(out);
  }

  void make_picture(const std::string& activity, const std::string& deed) {
    v1::DataProduct out;
    out.id("picture" + deed.substr(deed.find(' ')));
    out.product_kind("picture");
    out.source(activity);
    out.bytes(1000);
    out.fate(v1::PRODUCT_STORED);
    out.tier(v1::TIER_MANDATORY);
    out.created_us(robot_.now().count());
    products_.write(out);
  }

  // Everything takes 100 s; a command that comes again is answered as before.
  void obey(const v1::Command& command) {
    const auto word = words_.find({command.activity(), command.attempt()});
    if (command.action() != v1::COMMAND_EXECUTE || word != words_.end())
      return tell(command, word == words_.end() ? v1::STAGE_UNKNOWN : word->second);
    tell(command, v1::STAGE_ACCEPTED);
    robot_.after(100s, [this, command] {
      std::string deed = command.command_name();
      for (const auto& argument : command.arguments()) deed += " " + argument.value();
      done_.push_back(deed);
      if (command.command_name() == "image" && deed != "image horizon")
        make_picture(command.activity(), deed);
      if (deed == "farewell") observe("lander.radio", temporal::state("gone"));
      tell(command, v1::STAGE_COMPLETED);
    });
  }

  services::process::DomainClaim domain_;
  const fs::path folder_ = fs::temp_directory_path() /
                           ("roci_engine_" + std::to_string(::getpid()) + "_" + std::to_string(domain_.id()));
  services::SimRun run_{{"sim_svc", "planner_svc", "exec_svc"}, domain_.id()};

 protected:
  services::Node& robot_ = waiting(run_);

 private:
  services::Publisher<v1::Goal> goals_ = services::advertise(robot_, topics::goal);
  services::Publisher<v1::Observation> observations_ = services::advertise(robot_, topics::observation);
  services::Publisher<v1::DataProduct> products_ = services::advertise(robot_, topics::data_product);
  services::Publisher<v1::CommandAck> acks_ = services::advertise(robot_, topics::command_ack);
  std::unique_ptr<services::Service> planner_;
  std::unique_ptr<services::Service> executive_;
  std::map<std::pair<std::string, std::uint32_t>, v1::CommandStage> words_;
  std::optional<std::string> killed_;
  std::vector<std::string> done_;
  std::vector<std::string> events_;
  v1::MissionStatus mission_;

  // Mission time waits for a service that was killed to come back.
  static services::Node& waiting(services::SimRun& run) {
    run.master.restart_hold_s = 1000;
    return run.add("sim_svc", 1, GetParam().others);
  }

 protected:
  std::vector<std::string> cycles_;  // texts of planner.cycle
  std::vector<v1::DownlinkSchedule> schedules_;
  std::vector<v1::MissionOutlook> outlooks_;
  std::set<std::string> activities_;  // of all versions of the plan
};

// For a while the battery's gauge tells of less than all needs, so that cycles repair the plan, and place it anew later.
TEST_P(EngineAndExecutive, DoAllThatTheNetworkAsksForAndTellPartsOfCyclesInTheirOrder) {
  robot_.at(100s, [this] { observe("lander.battery", 250000.0); });
  robot_.at(310s, [this] { observe("lander.battery", 590000.0); });
  fly();
  expect_all_done();
  const std::vector<std::string> order{"commit", "consolidate", "schedule", "repair", "optimize"};
  std::set<std::string> seen;
  ASSERT_FALSE(cycles_.empty());
  for (const std::string& text : cycles_) {
    std::istringstream parts(text.substr(0, text.find(';')));
    auto last = order.begin();
    for (std::string part; std::getline(parts >> std::ws, part, ',');) {
      if (part.ends_with("explored")) continue;
      last = std::find(last, order.end(), part);
      ASSERT_NE(last, order.end()) << part << " in: " << text;
      ++last;
      seen.insert(part);
    }
  }
  EXPECT_EQ(seen, std::set<std::string>(order.begin(), order.end()));
}

// Every downlink that is told is one of the plan, versions go up,
// and what the pictures were is sent under their own ids once they exist.
TEST_P(EngineAndExecutive, TellTheDownlinkScheduleAndWhatThePlanIsExpectedToBring) {
  fly();
  ASSERT_FALSE(schedules_.empty());
  std::set<std::string> planned;
  std::set<std::string> existing;
  for (std::size_t i = 0; i < schedules_.size(); ++i) {
    const v1::DownlinkSchedule& one = schedules_[i];
    EXPECT_EQ(one.version(), i + 1);
    EXPECT_EQ(one.network(), "small-lander");
    EXPECT_TRUE(one.limited());
    EXPECT_EQ(one.omitted(), 0U);
    for (const v1::ScheduledDownlink& downlink : one.downlinks()) {
      EXPECT_TRUE(activities_.contains(downlink.activity())) << downlink.activity();
      for (const v1::ScheduledProduct& data : downlink.products())
        (data.exists() ? existing : planned).insert(data.id());
    }
  }
  EXPECT_THAT(planned,
              UnorderedElementsAre("sample_near/image_near/picture", "sample_far/image_far/picture"));
  EXPECT_THAT(existing, UnorderedElementsAre("picture near", "picture far"));
  ASSERT_FALSE(outlooks_.empty());
  const v1::MissionOutlook& last = outlooks_.back();
  EXPECT_EQ(last.ranks().size(), 1U);
  EXPECT_EQ(last.products().size(), 2U);
  EXPECT_EQ(last.budget(), "lander.battery");
  std::set<std::string> done;
  for (const v1::ChainOutlook& one : last.chains())
    if (one.stage() == v1::CHAIN_DONE) done.insert(one.request());
  EXPECT_THAT(done, IsSupersetOf({"sample_near", "sample_far", "view"}));
}

TEST_P(EngineAndExecutive, TheEngineDiesAndGoesOnWithThePlanThatRuns) {
  kill_at(200s, "planner_svc");
  fly();
  expect_all_done();
  ASSERT_FALSE(schedules_.empty());
  EXPECT_EQ(schedules_.front().header().incarnation(), 1U);
  EXPECT_EQ(schedules_.back().header().incarnation(), 2U) << "the next one tells its schedule, too";
}

TEST_P(EngineAndExecutive, TheExecutiveDiesAndNoCommitmentIsLost) {
  kill_at(200s, "exec_svc");
  fly();
  expect_all_done();
}

INSTANTIATE_TEST_SUITE_P(Transports, EngineAndExecutive,
                         ::testing::Values(Vendors{"inproc", "inproc", "inproc"},
                                           Vendors{"fastdds", "fastdds", "fastdds"},
                                           Vendors{"cyclonedds", "cyclonedds", "cyclonedds"},
                                           Vendors{"mixed", "fastdds", "cyclonedds"}),
                         [](const auto& transport) { return transport.param.name; });

}  // namespace
}  // namespace roci
