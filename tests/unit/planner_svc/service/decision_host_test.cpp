// Decisions that a running plan leaves to its engine (R131): answered once what they need is observed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <stdexcept>

#include "planner_svc/engine_host_service.hpp"
#include "services/publisher.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::planner {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Goes where the timeline `way` says, and binds the state of the timeline `which`; "fault" makes it throw.
class ByTheWay final : public engine::DecisionResolver {
 public:
  std::optional<engine::Resolution> resolve(const engine::OpenDecision& open) const override {
    const auto seen = open.request.state.find(open.decision.bindings.empty() ? "way" : "which");
    if (seen == open.request.state.end()) return {};
    const std::string word = std::get<temporal::State>(seen->second).name;
    if (word == "fault") throw std::runtime_error("out of ideas");
    if (!open.decision.bindings.empty()) return engine::Resolution{"", word};
    return engine::Resolution{word, ""};
  }
};

// Says how often a resolver was asked, and lets it go on only once the test says so, or it is to stop.
struct Gate {
  void pass(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    ++asked;
    opened.wait(lock, stop, [this] { return open; });
  }
  void let_go() {
    const std::lock_guard lock(mutex);
    open = true;
    opened.notify_all();
  }
  int count() {
    const std::lock_guard lock(mutex);
    return asked;
  }

  std::mutex mutex;
  std::condition_variable_any opened;
  bool open = false;
  int asked = 0;
};

class Gated final : public engine::DecisionResolver {
 public:
  explicit Gated(std::shared_ptr<Gate> gate) : gate_(std::move(gate)) {}
  std::optional<engine::Resolution> resolve(const engine::OpenDecision& open) const override {
    gate_->pass(open.stop);
    return ByTheWay().resolve(open);
  }

 private:
  std::shared_ptr<Gate> gate_;
};

class DecisionHostTest : public ::testing::Test {
 protected:
  DecisionHostTest() {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "mission.yaml") << "planner: {engine: guided}\n";
    table_["guided"] = {
        engine::MakeAnswering([]() -> std::unique_ptr<engine::AnsweringEngine> { return nullptr; }),
        []() -> std::unique_ptr<engine::Checker> { return nullptr; },
        [](const engine::Setup&) { return std::make_unique<ByTheWay>(); }};
    settings_.mission = folder_;
  }
  ~DecisionHostTest() override { std::filesystem::remove_all(folder_); }

  static v1::Plan plan() {
    temporal::FlexiblePlan out;
    out.id = "p1";
    out.version = 1;
    out.engine = "guided";
    out.decisions.resize(2);
    out.decisions[0].id = "d";
    out.decisions[0].choices = {{"left"}, {"right"}};
    out.decisions[1].id = "b";
    out.decisions[1].bindings = {{"a", "to"}};
    v1::Plan sample = services::wire::to_wire(out);
    sample.executive("exec");
    return sample;
  }

  static v1::Decision question(const std::string& id, const std::string& resolver = "guided",
                               v1::DecisionState state = v1::DECISION_OPEN) {
    v1::Decision out;
    out.executive("exec");
    out.id(id);
    out.plan_version(1);
    out.resolver(resolver);
    out.answer_before_us(-1);
    out.decision_state(state);
    return out;
  }

  static v1::Observation seen(const std::string& timeline, const std::string& word) {
    v1::Observation out;
    out.timeline(timeline);
    out.observed().kind(v1::VALUE_STATE);
    out.observed().state(word);
    return out;
  }

  // The answers to what is said at these times, as "<s> key decision choice value".
  std::vector<std::string> answers(const std::function<void(services::Node&)>& say) {
    services::SimRun run({"exec", "planner_svc"});
    services::Node& exec = run.add("exec");
    const auto planner = host_engines(run.add("planner_svc"), settings_, table_);
    std::vector<std::string> heard;
    services::subscribe(exec, topics::decision_answer, [&](const v1::DecisionAnswer& answer) {
      heard.push_back(std::to_string(exec.now() / 1s) + " " + answer.issuer() + "/" + answer.id() + " " +
                      answer.decision_id() + " " + answer.choice() + answer.bound_value());
    });
    services::subscribe(exec, topics::event, [&](const v1::Event& event) { heard.push_back(event.text()); });
    say(exec);
    exec.at(100s, [&] { exec.stop(); });
    run.run();
    return heard;
  }

  template <class T>
  static void write_at(services::Node& node, temporal::Time at, const services::topics::Topic<T>& topic,
                       T sample) {
    node.at(at, [writer = services::advertise(node, topic), sample = std::move(sample)] {
      writer.write(sample);
    });
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roci-decision-" + std::to_string(getpid()));
  services::RunSettings settings_;
  engine::Table table_;
};

TEST_F(DecisionHostTest, AnswersWhenTheInformationIsThere) {
  EXPECT_THAT(answers([](services::Node& exec) {
                write_at(exec, 1s, topics::plan, plan());
                write_at(exec, 2s, topics::decision, question("d"));
                write_at(exec, 3s, topics::observation, seen("other", "left"));
                write_at(exec, 5s, topics::observation, seen("way", "right"));
                write_at(exec, 6s, topics::observation, seen("way", "left"));
              }),
              ElementsAre("5 guided/exec/d@1 d right"));
}

TEST_F(DecisionHostTest, BindsAValueAndHearsThePlanAfterTheQuestion) {
  EXPECT_THAT(answers([](services::Node& exec) {
                write_at(exec, 1s, topics::observation, seen("which", "w7"));
                write_at(exec, 2s, topics::decision, question("b"));
                write_at(exec, 4s, topics::plan, plan());
              }),
              ElementsAre("4 guided/exec/b@1 b w7"));
}

TEST_F(DecisionHostTest, AQuestionThatIsAskedAgainGetsTheSameKey) {
  EXPECT_THAT(answers([](services::Node& exec) {
                write_at(exec, 1s, topics::plan, plan());
                write_at(exec, 1s, topics::observation, seen("way", "left"));
                write_at(exec, 2s, topics::decision, question("d"));
                write_at(exec, 9s, topics::decision, question("d"));
              }),
              ElementsAre("2 guided/exec/d@1 d left", "9 guided/exec/d@1 d left"));
}

TEST_F(DecisionHostTest, LeavesWhatIsOfOthersOrClosedAlone) {
  EXPECT_THAT(answers([](services::Node& exec) {
                write_at(exec, 1s, topics::plan, plan());
                write_at(exec, 2s, topics::decision, question("d", "ground"));
                write_at(exec, 3s, topics::decision, question("d"));
                write_at(exec, 4s, topics::decision, question("d", "guided", v1::DECISION_MISSED));
                write_at(exec, 5s, topics::observation, seen("way", "left"));
              }),
              IsEmpty());
}

TEST_F(DecisionHostTest, AFailureIsToldAndTheNextObservationDecides) {
  EXPECT_THAT(answers([](services::Node& exec) {
                write_at(exec, 1s, topics::plan, plan());
                write_at(exec, 2s, topics::observation, seen("way", "fault"));
                write_at(exec, 3s, topics::decision, question("d"));
                write_at(exec, 4s, topics::observation, seen("way", "left"));
              }),
              ElementsAre("decision d: out of ideas", "4 guided/exec/d@1 d left"));
}

// Two nodes on the live clock, in turns, with a resolver that waits at a gate.
class LiveDecisionHostTest : public DecisionHostTest {
 protected:
  LiveDecisionHostTest() {
    table_["guided"].make_resolver = [this](const engine::Setup&) { return std::make_unique<Gated>(gate_); };
    host_ = host_engines(planner_, settings_, table_);
    services::subscribe(exec_, topics::decision_answer,
                        [this](const v1::DecisionAnswer& answer) { answers_.push_back(answer.choice()); });
    services::subscribe(planner_, topics::observation, [this](const v1::Observation&) { ++heard_; });
  }

  services::Node node(const std::string& name) {
    services::node::NodeOptions options;
    options.name = name;
    options.vendor = "inproc";
    return services::Node(options, run_.transport());
  }

  template <class Done>
  void spin_until(Done done) {
    while (!done()) {
      exec_.spin_once(1ms);
      planner_.spin_once(1ms);
    }
  }

  void say(const std::string& timeline, const std::string& word) {
    const int before = heard_;
    observations_.write(seen(timeline, word));
    spin_until([&] { return heard_ > before; });
    planner_.spin_once(0ms);
  }

  // The worker is at the gate.
  void ask() {
    plans_.write(plan());
    questions_.write(question("d"));
    spin_until([&] { return gate_->count() == 1; });
  }

  services::SimRun run_{{"nobody"}};
  std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  services::Node exec_ = node("exec"), planner_ = node("planner_svc");
  services::Publisher<v1::Plan> plans_ = services::advertise(exec_, topics::plan);
  services::Publisher<v1::Decision> questions_ = services::advertise(exec_, topics::decision);
  services::Publisher<v1::Observation> observations_ = services::advertise(exec_, topics::observation);
  std::vector<std::string> answers_;
  int heard_ = 0;
  std::unique_ptr<services::Service> host_;
};

TEST_F(LiveDecisionHostTest, WhatIsHeardWhileItLooksIsLookedAtOnceInTheEnd) {
  ask();
  for (int i = 0; i < 50; ++i) say("other", "left");
  say("way", "right");
  EXPECT_EQ(gate_->count(), 1);
  gate_->let_go();
  spin_until([&] { return !answers_.empty(); });
  EXPECT_THAT(answers_, ElementsAre("right"));
  EXPECT_EQ(gate_->count(), 2) << "each of what was heard waited for the one before";
}

// A later version of the plan asks anew: what was found out for the one before is no answer.
TEST_F(LiveDecisionHostTest, WhatWasFoundOutForAnotherVersionIsNoAnswer) {
  say("way", "left");
  ask();
  v1::Decision later = question("d");
  later.plan_version(2);
  questions_.write(later);
  say("way", "right");
  gate_->let_go();
  spin_until([&] { return !answers_.empty(); });
  EXPECT_THAT(answers_, ElementsAre("right"));
  EXPECT_EQ(gate_->count(), 2);
}

TEST_F(LiveDecisionHostTest, ItsEndStopsTheLook) {
  ask();
  host_.reset();
  EXPECT_EQ(gate_->count(), 1);
}

}  // namespace
}  // namespace roci::planner
