// An engine that plans all the time in the planner's service: what it hears, and what its defects cost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "planner_svc/engine_host_service.hpp"
#include "planner_svc/limits.hpp"
#include "services/clock/wall.hpp"
#include "services/publisher.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::planner {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;
using engine::StepInputs, engine::StepOutput;
using temporal::Time;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// What all engines of a test were given, one line for each goal, end and refusal.
using Heard = std::vector<std::string>;

// Sends a version for each goal: its activity is the goal's id. A goal of kind "throw" makes it fail once.
class ScriptedEngine final : public engine::SteppedEngine {
 public:
  ScriptedEngine(Heard& heard, bool& throws) : heard_(heard), throws_(throws) {}

  StepOutput step(const StepInputs& inputs) override {
    StepOutput out;
    for (const engine::Observation& observation : inputs.observations)
      heard_.push_back(observation.timeline + " " + temporal::to_text(observation.value) + " at " +
                       temporal::to_text(observation.sampled));
    for (const engine::StepStatus& step : inputs.steps)
      heard_.push_back(step.activity + " ended at " + temporal::to_text(*step.progress.ended));
    for (const engine::DataProduct& product : inputs.products)
      heard_.push_back("product " + product.id + " of " + product.source + ", " +
                       std::to_string(product.bytes) + " bytes, fate " +
                       std::to_string(static_cast<int>(product.fate)));
    for (const engine::CommandResult& result : inputs.results) {
      heard_.push_back("result " + result.activity + " " + std::to_string(result.attempt) + ": " +
                       (result.energy_j ? temporal::to_text(temporal::Value{*result.energy_j}) : "no") +
                       " J");
      for (const auto& [name, number] : result.values)
        heard_.back() += ", " + name + " " + temporal::to_text(temporal::Value{number});
    }
    for (const engine::EndedGoal& goal : inputs.ended_goals) heard_.push_back("end of " + goal.id);
    if (inputs.receipt && inputs.receipt->refused != 0)
      heard_.push_back("refused " + std::to_string(inputs.receipt->refused));
    for (const engine::Goal& goal : inputs.goals) {
      heard_.push_back("goal " + goal.id);
      if (goal.kind == "told") out.account = {{"commit", "schedule"}, 12, {"the view is taken out"}};
      if (goal.kind == "throw" && std::exchange(throws_, false)) throw std::runtime_error("out of ideas");
      out.delta.emplace();
      out.delta->added.engine = "scripted";
      out.delta->added.version = inputs.last_version + 1;
      out.delta->added.id = goal.id;
    }
    return out;
  }

 private:
  Heard& heard_;
  bool& throws_;
};

class ScriptedChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override {
    if (checked.plan.id == "bad") return {"it is bad"};
    return {};
  }
};

class SteppedService : public ::testing::Test {
 protected:
  SteppedService() {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "mission.yaml") << "planner: {engine: scripted}\n";
    services::RunSettings settings;
    settings.mission = folder_;
    service_ = host_engines(run_.add("planner_svc"), settings, table_);
    services::subscribe(executive_, topics::plan_delta, [this](const v1::PlanDelta& delta) {
      versions_.push_back(std::to_string(delta.added().version()) + " " + delta.added().id());
    });
    services::subscribe(executive_, topics::event, [this](const v1::Event& event) {
      events_.push_back(event.code() + ": " + event.text());
    });
  }
  ~SteppedService() override {
    service_.reset();
    std::filesystem::remove_all(folder_);
  }

  void tell(Time time, const std::string& id, v1::GoalState state, const std::string& kind = "") {
    executive_.at(time, [this, id, state, kind] {
      v1::Goal goal;
      goal.issuer("ground");
      goal.id(id);
      goal.goal_kind(kind);
      if (state == v1::GOAL_PENDING) goals_.write(goal);
      v1::GoalStatus status;
      status.executive("exec_svc");
      status.issuer("ground");
      status.id(id);
      status.goal_state(state);
      statuses_.write(status);
    });
  }
  void tell_product(Time time, v1::ProductFate fate, std::uint64_t bytes = 60) {
    executive_.at(time, [this, fate, bytes] {
      v1::DataProduct product;
      product.id("image");
      product.source("look#1.0");
      product.bytes(bytes);
      product.tier(v1::TIER_DECISIONAL);
      product.fate(fate);
      products_.write(product);
    });
  }
  void tell_result(Time time, const std::string& commander, v1::CommandStage stage, double energy_j) {
    executive_.at(time, [this, commander, stage, energy_j] {
      v1::CommandAck ack;
      ack.commander(commander);
      ack.epoch(1);
      ack.activity("dig#1.0");
      ack.attempt(1);
      ack.stage(stage);
      ack.owner("exec_svc");  // who writes here
      ack.outcome().energy_j(energy_j);
      for (const double worth : {0.5, std::numeric_limits<double>::infinity()}) {
        v1::NamedValue value;
        value.name(worth < 1 ? "worth" : "depth");
        value.held().kind(v1::VALUE_NUMBER);
        value.held().number(worth);
        ack.outcome().measured().push_back(value);
      }
      acks_.write(ack);
    });
  }
  void tell_value(Time time, double value, Time sampled) {
    executive_.at(time, [this, value, sampled] {
      v1::Observation observation;
      observation.timeline("battery");
      observation.observed().kind(v1::VALUE_NUMBER);
      observation.observed().number(value);
      observation.sampled_us(sampled.count());
      observations_.write(observation);
    });
  }
  void tell_receipt(Time time) {
    executive_.at(time, [this] {
      v1::PlanReceipt receipt;
      receipt.executive("exec_svc");
      receipts_.write(receipt);
    });
  }
  void run_until(Time end) {
    executive_.at(end, [this] { executive_.stop(); });
    run_.run();
  }

  Heard heard_;
  bool throws_ = true;
  const engine::Table table_{{"scripted",
                              {engine::MakeStepped([this](const engine::Setup&) {
                                 return std::make_unique<ScriptedEngine>(heard_, throws_);
                               }),
                               [] { return std::make_unique<ScriptedChecker>(); }}}};
  const int domain_ = services::next_domain();
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("roci_stepped_" + std::to_string(::getpid()) + "_" + std::to_string(domain_));
  services::SimRun run_{{"exec_svc", "planner_svc"}, domain_};
  services::Node& executive_ = run_.add("exec_svc");
  services::Publisher<v1::Goal> goals_ = services::advertise(executive_, topics::goal);
  services::Publisher<v1::GoalStatus> statuses_ = services::advertise(executive_, topics::goal_status);
  services::Publisher<v1::DataProduct> products_ = services::advertise(executive_, topics::data_product);
  services::Publisher<v1::CommandAck> acks_ = services::advertise(executive_, topics::command_ack);
  services::Publisher<v1::PlanReceipt> receipts_ = services::advertise(executive_, topics::plan_receipt);
  services::Publisher<v1::Observation> observations_ = services::advertise(executive_, topics::observation);
  std::unique_ptr<services::Service> service_;
  std::vector<std::string> versions_;
  std::vector<std::string> events_;
};

TEST_F(SteppedService, AGoalIsTheEnginesFromTheExecutivesWordToItsEnd) {
  tell(1s, "a", v1::GOAL_PENDING);
  tell(2s, "old", v1::GOAL_ACHIEVED);
  tell(3s, "a", v1::GOAL_PLANNED);
  tell(4s, "a", v1::GOAL_ACHIEVED);
  run_until(10s);
  EXPECT_THAT(heard_, ElementsAre("goal a", "end of a"));
  EXPECT_THAT(versions_, ElementsAre("1 a"));
  EXPECT_THAT(events_, IsEmpty());
}

TEST_F(SteppedService, AVersionThatTheCheckerRefusesIsToldAndNeverSent) {
  tell(1s, "bad", v1::GOAL_PENDING);
  tell(2s, "good", v1::GOAL_PENDING);
  run_until(10s);
  EXPECT_THAT(versions_, ElementsAre("2 good"));
  EXPECT_THAT(events_,
              ElementsAre("planner.defect: version 1 of engine 'scripted' is refused by its checker: "
                          "it is bad"));
  EXPECT_THAT(heard_, ElementsAre("goal bad", "refused 1", "goal good")) << "with its next step, not at once";
}

TEST_F(SteppedService, AnEngineThatFailsIsMadeAnewAndHearsWhatStillCounts) {
  tell(1s, "first", v1::GOAL_PENDING);
  tell(2s, "gone", v1::GOAL_PENDING);
  tell(3s, "gone", v1::GOAL_RECALLED);
  tell(4s, "trap", v1::GOAL_PENDING, "throw");
  tell(5s, "next", v1::GOAL_PENDING);
  run_until(10s);
  EXPECT_THAT(events_,
              ElementsAre("planner.defect: engine 'scripted' failed and is made anew: out of ideas"));
  EXPECT_THAT(heard_, ElementsAre("goal first", "goal gone", "end of gone", "goal trap", "goal first",
                                  "goal trap", "goal next"));
}

TEST_F(SteppedService, DataProductsAreHeardWhenTheyChangeAndAgainByAnEngineThatIsMadeAnew) {
  tell_product(1s, v1::PRODUCT_STORED);
  tell_product(2s, v1::PRODUCT_STORED);
  tell_product(3s, v1::PRODUCT_RECEIVED);
  tell(4s, "trap", v1::GOAL_PENDING, "throw");
  tell(5s, "next", v1::GOAL_PENDING);
  run_until(10s);
  const std::string image = "product image of look#1.0, 60 bytes, fate ";
  EXPECT_THAT(heard_,
              ElementsAre(image + "0", image + "2", "goal trap", image + "2", "goal trap", "goal next"));
}

// Whose plan it is, a receipt tells; another executive's activities may have the same names.
TEST_F(SteppedService, ResultsAreHeardOfCompletedCommandsOfItsExecutiveAlone) {
  tell_result(1s, "exec_svc", v1::STAGE_ACCEPTED, 1);
  tell_result(2s, "another", v1::STAGE_COMPLETED, 2);
  tell_result(3s, "exec_svc", v1::STAGE_COMPLETED, 3);
  tell_result(4s, "exec_svc", v1::STAGE_COMPLETED, 3);
  tell_receipt(5s);
  tell_result(6s, "another", v1::STAGE_COMPLETED, 4);
  tell_result(7s, "exec_svc", v1::STAGE_COMPLETED, std::numeric_limits<double>::quiet_NaN());
  run_until(10s);
  EXPECT_THAT(heard_, ElementsAre("result dig#1.0 1: 3 J, worth 0.5", "result dig#1.0 1: no J, worth 0.5"));
}

TEST_F(SteppedService, WhatAStepDidIsToldPartByPartWithTheVersionThatCameOfIt) {
  tell(1s, "plain", v1::GOAL_PENDING);
  tell(2s, "watched", v1::GOAL_PENDING, "told");
  run_until(5s);
  EXPECT_THAT(events_,
              ElementsAre("planner.cycle: commit, schedule; 12 explored; version 2; the view is taken out"));
}

// Beyond its bounds the service says so once, and ten times fewer for each further factor of ten.
TEST_F(SteppedService, WhatFloodsItsTablesIsRefusedAndTold) {
  constexpr std::size_t kBeyond = 20;
  executive_.at(1s, [this] {
    for (std::size_t i = 0; i < kTimelines + kBeyond; ++i) {
      v1::Observation observation;
      observation.timeline("flood-" + std::to_string(i));
      observations_.write(observation);
    }
    for (std::size_t i = 0; i < kGoals + kBeyond; ++i) {
      v1::Goal goal;
      goal.issuer("flood");
      goal.id(std::to_string(i));
      goals_.write(goal);
    }
  });
  tell(2s, "late", v1::GOAL_PENDING);
  run_until(5s);
  EXPECT_THAT(versions_, IsEmpty()) << "there is no room for the late one";
  const auto told = [this](const std::string& of) {
    return std::ranges::count_if(events_, [&](const std::string& event) {
      return event.starts_with("planner.no_room: a " + of + " is not taken in");
    });
  };
  EXPECT_EQ(told("timeline"), 2) << "the first and the tenth";
  EXPECT_EQ(told("goal"), 2);
}

// An engine may fail at any of these, and would be told it again when it is made anew.
TEST_F(SteppedService, AnImpossibleFactIsToldAndHeardAsFarAsItMayBe) {
  tell_value(1s, 5, 1s);
  tell_value(2s, std::numeric_limits<float>::max(), 2s);
  tell_value(3s, std::numeric_limits<double>::quiet_NaN(), 3s);
  tell_value(4s, 4, Time(std::int64_t{10'000'000'000'000'001}));
  tell_product(5s, v1::PRODUCT_STORED, std::numeric_limits<std::uint64_t>::max());
  executive_.at(6s, [this] {
    v1::StepStatus step;
    step.activity("dig#1.0");
    step.ended_us(std::numeric_limits<std::int64_t>::max());
    services::advertise(executive_, topics::step_status).write(step);
  });
  run_until(10s);
  EXPECT_THAT(heard_, ElementsAre("battery 5 at 1 s", "battery 4 at 4 s",
                                  "product image of look#1.0, 1000000000000000 bytes, fate 0",
                                  "dig#1.0 ended at 6 s"));
  EXPECT_THAT(events_,
              ElementsAre(::testing::HasSubstr("of 'battery' is not believed (1 times so far for battery)"),
                          ::testing::HasSubstr("planner.measured: the time of an observation lies"),
                          ::testing::HasSubstr("'image' has 18446744073709551615 bytes"),
                          ::testing::HasSubstr("planner.measured: the time of a step lies")));
}

// Wants to be stepped again 5 ms after each step began; the first one ends after that.
class LateEngine final : public engine::SteppedEngine {
 public:
  explicit LateEngine(std::atomic<int>& steps) : steps_(steps) {}
  StepOutput step(const StepInputs& inputs) override {
    const auto begun = services::clock::wall_now();
    if (steps_ == 0)
      while (services::clock::wall_now() < begun + 20ms) std::this_thread::yield();
    ++steps_;
    StepOutput out;
    out.wake = inputs.now + 5ms;
    return out;
  }

 private:
  std::atomic<int>& steps_;
};

TEST(LiveSteppedService, AStepThatLastsBeyondTheNextIsFollowedByIt) {
  std::atomic<int> steps = 0;
  const engine::Table table{
      {"scripted",
       {engine::MakeStepped([&](const engine::Setup&) { return std::make_unique<LateEngine>(steps); }),
        [] { return std::make_unique<ScriptedChecker>(); }}}};
  const auto folder = std::filesystem::temp_directory_path() / ("roci_late_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mission.yaml") << "planner: {engine: scripted}\n";
  services::RunSettings settings;
  settings.mission = folder;
  services::SimRun run{{"nobody"}};
  const auto live = [&](const std::string& name) {
    services::node::NodeOptions options;
    options.name = name;
    options.vendor = "inproc";
    return services::Node(options, run.transport());
  };
  services::Node executive = live("exec_svc"), planner = live("planner_svc");
  const auto service = host_engines(planner, settings, table);
  const auto goals = services::advertise(executive, topics::goal);
  const auto statuses = services::advertise(executive, topics::goal_status);
  v1::Goal goal;
  goal.issuer("ground");
  goal.id("a");
  goals.write(goal);
  v1::GoalStatus status;
  status.executive("exec_svc");
  status.issuer("ground");
  status.id("a");
  statuses.write(status);
  for (int i = 0; i < 5000 && steps < 3; ++i) {
    executive.spin_once(1ms);
    planner.spin_once(1ms);
  }
  EXPECT_GE(steps, 3) << "nothing else calls for one";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace roci::planner
