// An engine that plans all the time and the executive, on every transport: goals, steps and receipts go to
// the engine, versions of its plan come back, what it has committed is done, also across a death of exec_svc.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/temporal/plan_delta.hpp"
#include "services/process/domain_claim.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/exec_svc/service/exec_seat.hpp"

namespace roci::exec {
namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;
using namespace std::chrono_literals;
using temporal::CommitState;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::ExecSeat;
using ::testing::Not;
using ::testing::Pair;
using testing::photo_goal;

struct Vendors {
  const char* name;
  std::string executive;
  std::string others;
};

// The planetary mission with plans that an engine sends on its own account.
fs::path continuous_mission(int domain) {
  const fs::path folder = fs::temp_directory_path() /
                          ("roci_continuous_" + std::to_string(::getpid()) + "_" + std::to_string(domain));
  fs::remove_all(folder);
  fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder, fs::copy_options::recursive);
  std::ostringstream text;
  text << std::ifstream(folder / "mission.yaml").rdbuf();
  const std::string engine =
      std::regex_replace(text.str(), std::regex("engine: temporal_pddl"), "engine: scripted");
  std::ofstream(folder / "mission.yaml")
      << std::regex_replace(engine, std::regex("\nexecutive:\n"), "\nexecutive:\n  replanning: continuous\n");
  return folder;
}

// Plans an image of every goal that it hears of, at `starts` seconds, and commits each 20 s before its start;
// drops from its plan what has ended. One version for each thing that happens.
class ContinuousEngine {
 public:
  explicit ContinuousEngine(services::Node& node)
      : node_(node), deltas_(services::advertise(node, topics::plan_delta)) {
    plan_.engine = "scripted";
    services::subscribe(node, topics::goal, [this](const v1::Goal& goal) { add(goal.id()); });
    services::subscribe(node, topics::step_status, [this](const v1::StepStatus& step) {
      if (step.state() == v1::ACTIVITY_SUCCEEDED) ended_.push_back(step.activity());
    });
    services::subscribe(node, topics::plan_receipt, [this](const v1::PlanReceipt& receipt) {
      const bool was_open = std::exchange(open_, receipt.open());
      versions.push_back(receipt.version());
      if (receipt.refused() != 0) refusals.push_back(receipt.reason());
      if (receipt.version() == 0 || receipt.refused() != 0) told_ = {};
      if (open_ && (!was_open || receipt.refused() != 0)) send();
    });
  }

  // Sends a version with 40 other activities in the place of those that the one before foresaw for later.
  void change_its_mind() {
    std::erase_if(plan_.activities, [](const auto& activity) { return activity.name == "later"; });
    std::erase_if(plan_.constraints, [](const auto& constraint) { return constraint.upper == kLatest; });
    for (int i = 0; i < 40; ++i) foresee("later-" + std::to_string(plan_.point_count));
    send();
  }

  std::vector<std::uint32_t> versions;
  std::vector<std::string> refusals;

 private:
  static constexpr temporal::Time kLatest{600s};

  void foresee(const std::string& id) {
    temporal::PlanActivity later;
    later.id = id;
    later.name = "later";
    later.start_point = plan_.point_count++;
    later.end_point = plan_.point_count++;
    later.duration_lower = later.duration_upper = temporal::seconds(1);
    plan_.constraints.push_back({temporal::origin_point, later.start_point, temporal::ConstraintKind::window,
                                 temporal::seconds(500), kLatest});
    plan_.activities.push_back(later);
  }

  void add(const std::string& goal) {
    temporal::PlanActivity image;
    image.id = image.name = "take-" + goal;
    image.owner = "sim_svc";
    image.subsystem = "camera";
    image.command_name = "image";
    image.arguments = {{"image", "image-" + goal}};
    image.goals_served = {"ground/" + goal};
    image.start_point = plan_.point_count++;
    image.end_point = plan_.point_count++;
    image.duration_lower = image.duration_upper = temporal::seconds(40);
    const auto start = temporal::seconds(100.0 * static_cast<double>(++goals_));
    plan_.constraints.push_back({temporal::origin_point, image.start_point, temporal::ConstraintKind::window,
                                 start, start + temporal::seconds(30)});
    plan_.activities.push_back(image);
    node_.at(start - 20s, [this, id = image.id] {
      for (temporal::PlanActivity& activity : plan_.activities)
        if (activity.id == id) activity.commit = CommitState::committed;
      send();
    });
    send();
  }

  void send() {
    if (!open_) return;
    if (told_.version == 0) consolidate();
    ++plan_.version;
    deltas_.write(services::wire::to_wire(difference(told_, plan_)));
    told_ = plan_;
  }

  void consolidate() {
    for (const std::string& id : ended_) {
      const auto gone = std::ranges::find(plan_.activities, id, &temporal::PlanActivity::id);
      if (gone == plan_.activities.end()) continue;
      const temporal::TimePoint start = gone->start_point;
      std::erase_if(plan_.constraints, [&](const auto& constraint) { return constraint.to_point == start; });
      plan_.activities.erase(gone);
    }
  }

  services::Node& node_;
  services::Publisher<v1::PlanDelta> deltas_;
  temporal::FlexiblePlan plan_;
  temporal::FlexiblePlan told_;
  std::vector<std::string> ended_;
  int goals_ = 0;
  bool open_ = false;
};

class ContinuousPlanning : public ::testing::TestWithParam<Vendors> {
 protected:
  ~ContinuousPlanning() override { fs::remove_all(mission_); }

  std::vector<std::string> images() const {
    std::vector<std::string> out;
    for (const v1::Command& command : seat_.commands)
      if (command.action() == v1::COMMAND_EXECUTE && command.command_name() == "image")
        out.push_back(command.activity() + " " + std::to_string(command.attempt()));
    return out;
  }

  services::process::DomainClaim domain_;
  fs::path mission_ = continuous_mission(domain_.id());
  ExecSeat seat_{GetParam().executive, GetParam().others, domain_.id(), {}, mission_};
  ContinuousEngine engine_{seat_.robot()};
};

TEST_P(ContinuousPlanning, GoalsArePlannedCommittedAndAchieved) {
  seat_.send(10s, photo_goal("ridge"));
  seat_.send(95s, photo_goal("rim"));  // while the first is taken
  seat_.run_until(400s);
  EXPECT_THAT(images(), ElementsAre("take-ridge 1", "take-rim 1"));
  EXPECT_EQ(seat_.planner_calls, 0);
  EXPECT_EQ(seat_.mission.outcome(), "achieved");
  EXPECT_THAT(engine_.refusals, ElementsAre());
  EXPECT_THAT(engine_.versions, Contains(4U));
  EXPECT_THAT(seat_.events, Not(Contains("plan.broken")));
}

TEST_P(ContinuousPlanning, ADeathOfTheExecutiveCostsNoCommitment) {
  seat_.send(10s, photo_goal("ridge"));
  seat_.send(20s, photo_goal("rim"));
  seat_.kill_executive_at(110s);
  seat_.run_until(600s);
  EXPECT_THAT(seat_.events, Contains("executive.resumed"));
  EXPECT_THAT(images(), ElementsAre("take-ridge 1", "take-rim 1"));
  EXPECT_EQ(seat_.mission.outcome(), "achieved");
}

// What has ended stays in the plan until its block is over, while versions come and go.
TEST_P(ContinuousPlanning, APlannerThatStartsAnewHearsWhatHasEndedOfThePlan) {
  seat_.send(10s, photo_goal("ridge"));
  seat_.send(20s, photo_goal("rim"));
  for (const auto when : {150s, 152s, 154s, 156s, 158s})
    seat_.at(when, [this] { engine_.change_its_mind(); });
  std::map<std::string, v1::ActivityState> steps;
  seat_.kill_planner_at(170s, [&](services::Node& planner) {
    services::subscribe(planner, topics::step_status,
                        [&](const v1::StepStatus& step) { steps[step.activity()] = step.state(); });
  });
  seat_.run_until(190s);
  EXPECT_THAT(engine_.refusals, ElementsAre());
  EXPECT_THAT(steps, Contains(Pair("take-ridge", v1::ACTIVITY_SUCCEEDED)));
  EXPECT_THAT(steps, Contains(Pair("take-rim", v1::ACTIVITY_WAITING)));
}

INSTANTIATE_TEST_SUITE_P(Transports, ContinuousPlanning,
                         ::testing::Values(Vendors{"inproc", "inproc", "inproc"},
                                           Vendors{"fastdds", "fastdds", "fastdds"},
                                           Vendors{"cyclonedds", "cyclonedds", "cyclonedds"},
                                           Vendors{"mixed", "fastdds", "cyclonedds"}),
                         [](const auto& transport) { return transport.param.name; });

}  // namespace
}  // namespace roci::exec
