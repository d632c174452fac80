#include "arm_svc/arm_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/mission/entry.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::arm {
namespace {

using namespace std::chrono_literals;
using services::CallResult;
using services::rpc::CallStatus;
using testing::ElementsAre;
using testing::HasSubstr;
namespace topics = services::topics;

const std::filesystem::path kMission = ROCI_SOURCE_DIR "/missions/planetary";

services::RunSettings settings_for(const std::filesystem::path& mission) {
  services::RunSettings settings;
  settings.mission = mission;
  return settings;
}

v1::PlanObject pose(const std::string& name, const std::vector<std::string>& joints = {}) {
  v1::PlanObject object;
  object.name(name);
  object.object_type("pose");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    v1::Property property;
    property.name("q" + std::to_string(i));
    property.value(joints[i]);
    object.properties().push_back(property);
  }
  return object;
}

v1::FunctionBatch batch(const std::string& function, std::uint32_t arity, std::vector<std::uint32_t> tuples) {
  v1::FunctionBatch batch;
  batch.function(function);
  batch.arity(arity);
  batch.tuples(std::move(tuples));
  return batch;
}

v1::ArmMotionRequest motion(const std::string& from, const std::string& to, std::vector<double> joints = {}) {
  v1::ArmMotionRequest request;
  request.from_pose(from);
  request.from_positions(std::move(joints));
  request.to_pose(to);
  return request;
}

// The service with a master that asks it things and keeps what it hears.
class ArmService : public testing::Test {
 protected:
  void SetUp() override {
    services::subscribe(master_, topics::function_offer,
                        [this](const v1::FunctionOffer& offer) { offers_.push_back(offer); });
    services::subscribe(master_, topics::event, [this](const v1::Event& event) {
      events_.push_back(event.code() + " " + event.text());
    });
  }

  void run(temporal::Duration end) {
    master_.after(end, [this] { master_.stop(); });
    run_.run();
  }

  void ask_for_values(const v1::FunctionRequest& request, const std::string& owner) {
    master_.after(1s, [this, request, owner] {
      functions_.call(request, owner, 1s, [this](const CallResult<v1::FunctionReply>& result) {
        function_results_.push_back(result);
      });
    });
  }

  void ask_for_motion(temporal::Duration when, const v1::ArmMotionRequest& request) {
    master_.after(when, [this, request] {
      motions_.call(request, "arm_svc", 1s, [this](const CallResult<v1::ArmMotionReply>& result) {
        ASSERT_EQ(result.status, CallStatus::ok) << result.reason;
        motion_replies_.push_back(result.reply);
      });
    });
  }

  services::SimRun run_{{"master", "arm_svc"}};
  services::Node& master_ = run_.add("master");
  std::unique_ptr<services::Service> service_ = make_service(run_.add("arm_svc"), settings_for(kMission));
  services::Client<v1::FunctionRequest, v1::FunctionReply> functions_{master_, topics::function_call};
  services::Client<v1::ArmMotionRequest, v1::ArmMotionReply> motions_{master_, topics::arm_motion};
  std::vector<v1::FunctionOffer> offers_;
  std::vector<std::string> events_;
  std::vector<CallResult<v1::FunctionReply>> function_results_;
  std::vector<v1::ArmMotionReply> motion_replies_;
};

TEST_F(ArmService, OffersItsFunctions) {
  run(1s);
  ASSERT_EQ(offers_.size(), 1U);
  EXPECT_EQ(offers_[0].module_name(), "arm");
  EXPECT_EQ(offers_[0].owner(), "arm_svc");
  EXPECT_NE(offers_[0].model_version(), 0U);
  ASSERT_EQ(offers_[0].functions().size(), 2U);
  EXPECT_EQ(offers_[0].functions()[0].name(), "arm_move_time");
  EXPECT_EQ(offers_[0].functions()[1].name(), "arm_move_energy");
  EXPECT_TRUE(events_.empty());
}

TEST_F(ArmService, EveryTupleHasItsOwnOutcome) {
  v1::FunctionRequest request;
  request.module_name("arm");
  request.objects({pose("stow"), pose("sampling"), pose("deposit"), pose("nowhere"),
                   pose("arm-here", {"0.1", "-1.2", "1.5", "0.6", "0"}),
                   pose("bent", {"0", "5", "0", "0", "0"}), pose("short", {"0", "0"}),
                   pose("garbled", {"0", "x", "0", "0", "0"}), pose("long", {"0", "0", "0", "0", "0", "0"}),
                   pose("nan", {"nan", "0", "0", "0", "0"})});
  request.batches({batch("arm_move_time", 2, {0, 1, 1, 2, 0, 0, 4, 1, 1, 4}),
                   batch("arm_move_energy", 2, {0, 1}),
                   batch("arm_move_time", 2, {0, 3, 5, 0, 0, 6, 0, 7, 0, 8, 0, 9, 0, 99}),
                   batch("arm_move_colour", 2, {0, 1}), batch("arm_move_time", 1, {0}),
                   batch("arm_move_time", 2, {0, 1, 0})});
  ask_for_values(request, "arm_svc");
  ask_for_values(request, "arm_svc");
  run(2s);

  ASSERT_EQ(function_results_.size(), 2U);
  ASSERT_EQ(function_results_[0].status, CallStatus::ok) << function_results_[0].reason;
  const v1::FunctionReply& reply = function_results_[0].reply;
  EXPECT_EQ(reply.owner(), "arm_svc");
  EXPECT_EQ(reply.model_version(), offers_.at(0).model_version());
  EXPECT_EQ(reply.computed_us(), 1'000'000);
  ASSERT_EQ(reply.results().size(), 6U);
  EXPECT_THAT(reply.results()[0].outcomes(), testing::Each(v1::FUNCTION_VALUE));
  ASSERT_EQ(reply.results()[0].numbers().size(), 5U);
  EXPECT_GT(reply.results()[0].numbers()[0], 5.0);
  EXPECT_EQ(reply.results()[0].numbers()[2], 0.0);
  EXPECT_GT(reply.results()[1].numbers().at(0), 30.0);
  const auto unknown = v1::FUNCTION_UNKNOWN_OBJECT;
  EXPECT_THAT(reply.results()[2].outcomes(),
              ElementsAre(unknown, v1::FUNCTION_UNREACHABLE, unknown, unknown, unknown, unknown, unknown));
  EXPECT_THAT(reply.results()[2].numbers(), testing::Each(0.0));
  EXPECT_THAT(reply.results()[3].outcomes(), ElementsAre(v1::FUNCTION_UNKNOWN_FUNCTION));
  EXPECT_THAT(reply.results()[4].outcomes(), ElementsAre(v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(reply.results()[5].outcomes(), ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(events_,
              testing::UnorderedElementsAre(HasSubstr("motion.refused stow to nowhere: no pose 'nowhere'"),
                                            HasSubstr("bent to stow: the joint values of 'bent'"),
                                            HasSubstr("not 5 finite numbers")))
      << "each once";
}

TEST_F(ArmService, LeavesOtherModulesToTheirOwners) {
  v1::FunctionRequest request;
  request.module_name("pathplan");
  ask_for_values(request, "");
  run(3s);
  ASSERT_EQ(function_results_.size(), 1U);
  EXPECT_EQ(function_results_[0].status, CallStatus::timeout);
}

TEST_F(ArmService, MotionsHaveATrajectoryAFollowerCanUse) {
  const std::vector<double> here = {0.1, -1.2, 1.5, 0.6, 0};
  ask_for_motion(1s, motion("stow", "sampling"));
  ask_for_motion(2s, motion("arm-here", "stow", here));
  ask_for_motion(3s, motion("stow", "stow"));
  ask_for_motion(4s, motion("stow", "nowhere"));
  ask_for_motion(5s, motion("arm-here", "stow", std::vector<double>(40, 0.0)));
  ask_for_motion(6s, motion("arm-here", "stow", {9, 0, 0, 0, 0}));
  run(7s);
  ASSERT_EQ(motion_replies_.size(), 6U);
  for (int i : {0, 1}) {
    const v1::ArmMotionReply& reply = motion_replies_[static_cast<std::size_t>(i)];
    EXPECT_EQ(reply.outcome(), v1::MOTION_FOUND) << reply.reason();
    EXPECT_EQ(reply.trajectory().front().time_s(), 0.0);
    EXPECT_DOUBLE_EQ(reply.trajectory().back().time_s(), reply.expected_s());
    EXPECT_GT(reply.expected_j(), 0.0);
    for (std::size_t k = 1; k < reply.trajectory().size(); ++k) {
      const double step = reply.trajectory()[k].time_s() - reply.trajectory()[k - 1].time_s();
      EXPECT_GT(step, 0.0);
      EXPECT_LE(step, 0.1 + 1e-9);
      EXPECT_EQ(reply.trajectory()[k].positions().size(), 5U);
    }
  }
  EXPECT_EQ(motion_replies_[1].trajectory().front().positions(), here);
  EXPECT_EQ(motion_replies_[2].trajectory().size(), 1U) << "already there";
  EXPECT_EQ(motion_replies_[3].outcome(), v1::MOTION_INVALID);
  EXPECT_THAT(motion_replies_[3].reason(), HasSubstr("no pose 'nowhere'"));
  EXPECT_EQ(motion_replies_[4].outcome(), v1::MOTION_UNREACHABLE);
  EXPECT_EQ(motion_replies_[5].outcome(), v1::MOTION_UNREACHABLE);
  EXPECT_THAT(events_, testing::SizeIs(3));
}

// A mission in a folder of its own, with the planetary arm and other poses.
class ArmMission : public testing::Test {
 protected:
  ArmMission() { std::filesystem::create_directories(folder_); }
  ~ArmMission() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  const std::filesystem::path folder_ = testing::TempDir() + "arm_mission_" + std::to_string(::getpid());
};

TEST_F(ArmMission, PosesThatCannotBeReachedAreReportedAtTheStart) {
  write("mission.yaml", "arm: {model: " + (kMission / "arm/arm.urdf").string() + ", poses: poses.yaml}\n");
  write("poses.yaml", "tip: scoop_tip\nposes:\n  far: {position: [9, 0, 0]}\n");
  services::SimRun run{{"master", "arm_svc"}};
  services::Node& master = run.add("master");
  std::vector<std::string> events;
  services::subscribe(master, topics::event, [&](const v1::Event& event) { events.push_back(event.text()); });
  const auto service = make_service(run.add("arm_svc"), settings_for(folder_));
  master.after(1s, [&] { master.stop(); });
  run.run();
  EXPECT_THAT(events, ElementsAre(HasSubstr("pose 'far' is out of the arm's reach")));
}

// Names, arities, types, loads: all of it is the mission's.
class DeclaredFunctions : public ArmMission {
 protected:
  void fly() {
    const std::filesystem::path arm = ROCI_SOURCE_DIR "/tests/unit/arm_svc/rail";
    write("mission.yaml", "arm:\n  model: " + (arm / "arm.urdf").string() +
                              "\n  poses: " + (arm / "poses.yaml").string() + R"(
  module: shifting
  functions:
    reach_for: {parameters: [slot], gives: duration, from: home, to: "?1"}
    shift: {parameters: [thing, slot, slot], gives: energy, from: "?2", to: "?3",
            payload: {mass_kg: "?1.mass_kg", size_m: ["?1.edge_m", "?1.edge_m", "?1.edge_m"]}}
)");
    services::SimRun run{{"master", "arm_svc"}};
    services::Node& master = run.add("master");
    services::subscribe(master, topics::function_offer, [&](const v1::FunctionOffer& said) { offer = said; });
    services::subscribe(master, topics::event,
                        [&](const v1::Event& event) { events.push_back(event.text()); });
    const auto service = make_service(run.add("arm_svc"), settings_for(folder_));
    services::Client<v1::FunctionRequest, v1::FunctionReply> functions{master, topics::function_call};
    services::Client<v1::ArmMotionRequest, v1::ArmMotionReply> client{master, topics::arm_motion};
    master.after(1s, [&] {
      functions.call(request, "arm_svc", 1s, [&](const CallResult<v1::FunctionReply>& result) {
        ASSERT_EQ(result.status, CallStatus::ok) << result.reason;
        reply = result.reply;
      });
      for (const v1::ArmMotionRequest& asked : motions) {
        client.call(asked, "arm_svc", 1s, [&](const CallResult<v1::ArmMotionReply>& result) {
          ASSERT_EQ(result.status, CallStatus::ok) << result.reason;
          motion_replies.push_back(result.reply);
        });
      }
    });
    master.after(2s, [&] { master.stop(); });
    run.run();
  }

  static v1::PlanObject thing(const std::string& name, const std::string& mass, const std::string& edge) {
    v1::PlanObject object = pose(name);
    for (const auto& [key, value] : {std::pair{"mass_kg", mass}, std::pair{"edge_m", edge}}) {
      v1::Property property;
      property.name(key);
      property.value(value);
      object.properties().push_back(property);
    }
    return object;
  }

  v1::FunctionRequest request;
  std::vector<v1::ArmMotionRequest> motions;
  v1::FunctionOffer offer;
  v1::FunctionReply reply;
  std::vector<v1::ArmMotionReply> motion_replies;
  std::vector<std::string> events;
};

TEST_F(DeclaredFunctions, AreOfferedAndAnsweredAsDeclared) {
  request.module_name("shifting");
  request.objects({pose("s0"), pose("s1"), thing("light", "10", "0.3"), thing("heavy", "2000", "0.3"),
                   thing("odd", "nan", "0.3"), thing("flat", "10", "0"), thing("anti", "-3", "0.3"),
                   pose("bare")});
  auto bound = batch("shift", 3, {2, 0, 1, 3, 0, 1});
  bound.accuracy(v1::ACCURACY_LOWER_BOUND);
  request.batches({batch("reach_for", 1, {0, 1}), batch("shift", 3, {2, 0, 1, 3, 0, 1}), bound,
                   batch("shift", 3, {4, 0, 1, 6, 0, 1, 7, 0, 1, 2, 0, 7}), batch("shift", 2, {0, 1}),
                   batch("arm_move_time", 2, {0, 1})});
  fly();
  EXPECT_EQ(offer.module_name(), "shifting");
  ASSERT_EQ(offer.functions().size(), 2U);
  EXPECT_EQ(offer.functions()[1].name(), "shift");
  EXPECT_EQ(offer.functions()[1].unit(), "J");
  EXPECT_THAT(offer.functions()[1].parameter_types(), ElementsAre("thing", "slot", "slot"));
  EXPECT_THAT(offer.functions()[1].accuracies(), ElementsAre(v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND));

  const auto& results = reply.results();
  ASSERT_EQ(results.size(), 6U);
  for (const std::size_t i : {0U, 1U, 2U})
    EXPECT_THAT(results[i].outcomes(), testing::Each(v1::FUNCTION_VALUE));
  EXPECT_GT(results[0].numbers().at(0), 1.0);
  EXPECT_GT(results[1].numbers().at(1), 1.5 * results[1].numbers().at(0)) << "more mass, more energy";
  EXPECT_EQ(results[2].accuracy(), v1::ACCURACY_LOWER_BOUND);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_GT(results[2].numbers().at(i), 0.0);
    EXPECT_LE(results[2].numbers().at(i), results[1].numbers().at(i));
  }
  EXPECT_THAT(results[3].outcomes(), testing::Each(v1::FUNCTION_UNKNOWN_OBJECT));
  EXPECT_THAT(results[4].outcomes(), ElementsAre(v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(results[5].outcomes(), testing::Each(v1::FUNCTION_UNKNOWN_FUNCTION));
  EXPECT_THAT(events, testing::UnorderedElementsAre(
                          HasSubstr("'odd' has no property mass_kg that is a finite number"),
                          HasSubstr("'anti' has a property mass_kg below 0"),
                          HasSubstr("'bare' has no property mass_kg that is a finite number"),
                          HasSubstr("s0 to bare: no pose 'bare'")));
  EXPECT_THAT(reply.reply().remote_message(), HasSubstr("odd: it has no property mass_kg"));
}

TEST_F(DeclaredFunctions, MotionsCarryLoads) {
  motions = {motion("s0", "s1"), motion("s0", "s1"), motion("s0", "s1"), motion("s0", "s1")};
  motions[1].payload_kg(2000);
  motions[1].payload_size_m({0.3, 0.3, 0.3});
  motions[2].payload_kg(-1);
  motions[3].payload_size_m({0.3, 0.3});
  fly();
  ASSERT_EQ(motion_replies.size(), 4U);
  ASSERT_EQ(motion_replies[0].outcome(), v1::MOTION_FOUND) << motion_replies[0].reason();
  ASSERT_EQ(motion_replies[1].outcome(), v1::MOTION_FOUND) << motion_replies[1].reason();
  EXPECT_GT(motion_replies[1].expected_s(), motion_replies[0].expected_s());
  EXPECT_GT(motion_replies[1].expected_j(), motion_replies[0].expected_j());
  EXPECT_EQ(motion_replies[2].outcome(), v1::MOTION_INVALID);
  EXPECT_THAT(motion_replies[2].reason(), HasSubstr("mass"));
  EXPECT_EQ(motion_replies[3].outcome(), v1::MOTION_INVALID);
  EXPECT_THAT(motion_replies[3].reason(), HasSubstr("size"));
}

// What was not found is UNKNOWN, what is proved UNREACHABLE, for values and for motions.
TEST_F(DeclaredFunctions, NoWayIsProvedOrNotSaid) {
  request.module_name("shifting");
  v1::PlanObject far = pose("far"), buried = pose("buried");
  for (auto& [object, place] :
       {std::pair<v1::PlanObject&, std::vector<std::string>>{far, {"0", "9", "0"}},
        std::pair<v1::PlanObject&, std::vector<std::string>>{buried, {"1", "0.5", "-0.1"}}}) {
    for (std::size_t i = 0; i < 3; ++i) {
      v1::Property property;
      property.name(std::string(1, "xyz"[i]));
      property.value(place[i]);
      object.properties().push_back(property);
    }
  }
  request.objects({far, buried});
  auto bound = batch("reach_for", 1, {0, 1});
  bound.accuracy(v1::ACCURACY_LOWER_BOUND);
  request.batches({batch("reach_for", 1, {0, 1}), bound});
  fly();
  for (const auto& values : reply.results())
    EXPECT_THAT(values.outcomes(), ElementsAre(v1::FUNCTION_UNREACHABLE, v1::FUNCTION_UNKNOWN));
  EXPECT_THAT(reply.reply().remote_message(), HasSubstr("far: pose 'far' is out of the arm's reach"));
}

TEST_F(ArmMission, AMissionWithoutAnArmNamesThePlace) {
  write("mission.yaml", "name: none\n");
  services::SimRun run{{"master"}};
  try {
    make_service(run.add("master"), settings_for(folder_));
    FAIL() << "no error";
  } catch (const mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mission.yaml:1:1: 'arm' is missing"));
  }
}

}  // namespace
}  // namespace roci::arm
