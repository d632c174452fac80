#include "sim_svc/sim_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/mission/entry.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "sim_svc/world/image_store.hpp"
#include "sim_svc/world_file_service.hpp"
#include "tests/unit/core/durable/sync_record.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
namespace topics = services::topics;

// The simulator on a flat mission of its own, with planners that answer straight lines, and an executive's
// seat.
class SimService : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_sim_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
    write("mission.yaml",
          "site: site.yaml\narm: {poses: poses.yaml}\nsimulation:\n  robots:\n    - name: rover\n"
          "      power: {}\n      components: [{name: nav, type: drive}, {name: arm, type: arm}]\n");
    write("poses.yaml", "poses:\n  stow: {joints: [0, 1]}\n  sampling: {position: [1, 0, 0]}\n");
    write("site.yaml",
          "image: rocks.pgm\nresolution: 100\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
          "free_thresh: 0.2\n");
    write("rocks.pgm", "P2\n2 2\n255\n255 255\n255 255\n");
    scenario("stimuli: []\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  void scenario(const std::string& rest) {
    write("scenarios/nominal.yaml",
          "duration_s: 2000\nstart: {x: 20, y: 20, arm: stow, battery: 500000}\n" + rest);
  }

  struct Heard {
    std::vector<v1::CommandAck> acks;
    std::vector<v1::Goal> goals;
    std::vector<v1::Hazard> hazards;
    std::vector<v1::DataProduct> products;
    std::vector<std::string> observations;  // "us timeline = value"
    temporal::Time end{};
  };

  // Flies with these commands, each at its time; `outcome_at`: when the executive says that the mission is
  // over.
  Heard fly(const std::map<temporal::Duration, v1::Command>& commands, temporal::Duration outcome_at = 0s,
            std::uint64_t seed = 1) {
    services::SimRun run({"sim_svc", "exec_svc", "pathplan_svc", "arm_svc", "planner_svc"});
    services::RunSettings settings;
    settings.mission = folder_;
    settings.run_folder = folder_;
    settings.seed = seed;
    services::Node& simulator = run.add("sim_svc");
    const auto service = make_service(simulator, settings);
    services::Node& executive = run.add("exec_svc");
    serve_planners(run.add("pathplan_svc"), run.add("arm_svc"));
    Heard heard;
    listen(executive, heard);
    const auto sender = services::advertise(executive, topics::command);
    for (const auto& [at, command] : commands) {
      executive.at(at, [&sender, &command] { sender.write(command); });
    }
    const auto missions = services::advertise(executive, topics::mission_status);
    services::Node& planner = run.add("planner_svc");
    const auto schedules = services::advertise(planner, topics::downlink_schedule);
    if (schedule_) planner.at(1s, [&] { schedules.write(*schedule_); });
    v1::MissionStatus over;
    over.mission("m");
    over.outcome("achieved");
    if (outcome_at > 0s) executive.at(outcome_at, [&] { missions.write(over); });
    run.run();
    heard.end = simulator.now();
    return heard;
  }

  static void serve_planners(services::Node& paths, services::Node& arms) {
    services::serve(paths, topics::path_request, [](const v1::PathRequest& request, auto responder) {
      v1::PathReply reply;
      const bool reachable = request.goal_pose().x_m() < 150;
      reply.outcome(reachable ? v1::MOTION_FOUND : v1::MOTION_UNREACHABLE);
      reply.reason(reachable ? "" : "too far for this test");
      reply.waypoints({request.origin(), request.goal_pose()});
      responder.reply(reply);
    });
    services::serve(arms, topics::arm_motion, [](const v1::ArmMotionRequest& request, auto responder) {
      v1::ArmMotionReply reply;
      reply.outcome(v1::MOTION_FOUND);
      v1::JointState from;
      from.positions(request.from_positions());
      v1::JointState to;
      to.time_s(4);
      to.positions({1, 0});
      reply.trajectory({from, to});
      responder.reply(reply);
    });
  }

  static void listen(services::Node& node, Heard& heard) {
    services::subscribe(node, topics::command_ack,
                        [&](const v1::CommandAck& ack) { heard.acks.push_back(ack); });
    services::subscribe(node, topics::goal, [&](const v1::Goal& goal) { heard.goals.push_back(goal); });
    services::subscribe(node, topics::hazard, [&](const v1::Hazard& rock) { heard.hazards.push_back(rock); });
    services::subscribe(node, topics::data_product,
                        [&](const v1::DataProduct& product) { heard.products.push_back(product); });
    services::subscribe(node, topics::observation, [&](const v1::Observation& seen) {
      EXPECT_EQ(seen.sampled_us(), node.now().count()) << "said when it happens, not later";
      const v1::TimelineValue& value = seen.observed();
      std::string text = std::to_string(seen.sampled_us()) + " " + seen.timeline() + " = " + value.state();
      for (const std::string& argument : value.arguments()) text += " " + argument;
      if (value.kind() == v1::VALUE_NUMBER) text += std::to_string(value.number());
      heard.observations.push_back(text);
    });
  }

  static v1::Command command(const std::string& activity, const std::string& component,
                             const std::string& name,
                             const std::vector<std::pair<std::string, std::string>>& arguments) {
    v1::Command out;
    out.activity(activity);
    out.attempt(1);
    out.owner("sim_svc");
    out.subsystem(component);
    out.command_name(name);
    out.epoch(1);
    out.sender_epoch(1);
    out.latest_end_us(-1);
    for (const auto& [key, value] : arguments) {
      v1::Property property;
      property.name(key);
      property.value(value);
      out.arguments().push_back(property);
    }
    return out;
  }
  static v1::Command drive(const std::string& activity, const std::string& x) {
    return command(activity, "nav", "drive", {{"to", "there"}, {"x", x}, {"y", "20"}});
  }
  static std::vector<v1::CommandStage> stages(const Heard& heard, const std::string& activity) {
    std::vector<v1::CommandStage> out;
    for (const v1::CommandAck& ack : heard.acks) {
      if (ack.activity() == activity) out.push_back(ack.stage());
    }
    return out;
  }

  std::filesystem::path folder_;
  std::optional<v1::DownlinkSchedule> schedule_;  // told at 1 s
};

TEST_F(SimService, ADriveGoesByThePathPlannersWay) {
  const Heard heard = fly({{5s, drive("d", "40")}}, 400s);
  EXPECT_THAT(stages(heard, "d"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_COMPLETED));
  EXPECT_THAT(heard.observations, testing::Contains(HasSubstr("rover.nav = going-to there")));
  EXPECT_THAT(heard.observations, testing::Contains(HasSubstr("rover.nav = idle-at there")));
  EXPECT_THAT(heard.observations, testing::Contains(HasSubstr("rover.x = 40.0")));
}

TEST_F(SimService, AnArmMoveTracksTheArmPlannersTrajectory) {
  const Heard heard = fly({{5s, command("m", "arm", "move", {{"from", "stow"}, {"to", "sampling"}})}}, 100s);
  EXPECT_THAT(stages(heard, "m"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_COMPLETED));
  EXPECT_THAT(heard.observations, testing::Contains(HasSubstr("rover.arm = idle-pose sampling")));
}

TEST_F(SimService, AnUnreachablePlaceFailsTheDriveWithThePlannersReason) {
  const Heard heard = fly({{5s, drive("d", "190")}}, 100s);
  EXPECT_THAT(stages(heard, "d"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_FAILED));
  EXPECT_EQ(heard.acks.back().code(), "no-path");
  EXPECT_EQ(heard.acks.back().reason(), "too far for this test");
}

TEST_F(SimService, CommandsOfOtherOwnersAreLeftAlone) {
  v1::Command other = drive("d", "40");
  other.owner("arm_svc");
  EXPECT_TRUE(fly({{5s, other}}, 10s).acks.empty());
}

TEST_F(SimService, ARobotThatIsDataAloneFliesWithoutSiteAndArm) {
  write("mission.yaml",
        "simulation:\n  robots:\n    - name: station\n      components:\n"
        "        - {name: door, type: task, state: shut, commands: {open: {duration_s: 20, during: moving, "
        "then: open}}}\n");
  write("scenarios/nominal.yaml", "duration_s: 2000\n");
  const Heard heard = fly({{5s, command("o", "door", "open", {})}, {6s, drive("d", "40")}}, 100s);
  EXPECT_THAT(stages(heard, "o"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_COMPLETED));
  EXPECT_THAT(stages(heard, "d"), ElementsAre(v1::STAGE_REJECTED));
  EXPECT_THAT(heard.observations, ElementsAre("0 station.door = shut", "5000000 station.door = moving",
                                              "25000000 station.door = open"));
}

TEST_F(SimService, TwoRobotsAreToldApartByTheCommandsRobot) {
  write("mission.yaml",
        "simulation:\n  robots:\n"
        "    - {name: one, components: [{name: door, type: task, commands: {open: {duration_s: 20, power_w: "
        "5}}}]}\n"
        "    - {name: two, components: [{name: door, type: task, commands: {open: {duration_s: 30, power_w: "
        "5}}}]}\n");
  write("scenarios/nominal.yaml", "duration_s: 2000\n");
  v1::Command first = command("a", "door", "open", {});
  first.robot("one");
  v1::Command second = command("b", "door", "open", {});
  second.robot("two");
  const Heard heard = fly({{5s, first}, {6s, second}, {7s, command("c", "door", "open", {})}}, 100s);
  EXPECT_THAT(heard.observations,
              ElementsAre("0 one.door = idle", "0 two.door = idle", "5000000 one.door = open",
                          "6000000 two.door = open", "25000000 one.door = idle", "36000000 two.door = idle"));
  EXPECT_THAT(stages(heard, "c"), ElementsAre(v1::STAGE_REJECTED));
  const v1::CommandAck& last = heard.acks.back();
  EXPECT_EQ(last.activity(), "b");
  EXPECT_EQ(last.outcome().duration_us(), 30'000'000);
  EXPECT_NEAR(last.outcome().energy_j(), 150, 1e-6);
}

// A lander with a camera and a radio, in contact all the time.
TEST_F(SimService, DataGoAsTheDownlinkScheduleSaysAndTheirFatesAreTold) {
  write(
      "mission.yaml",
      "windows: [{timeline: earth.window, open: [[0, 9000]]}]\n"
      "simulation:\n  robots:\n    - name: lander\n      data: {}\n      components:\n"
      "        - {name: radio, type: direct_radio, rate_byte_s: 100, light_time_s: 300}\n"
      "        - {name: camera, type: survey_camera, duration_noise: 0, panorama: {duration_s: 10}, "
      "products: {panorama: "
      "{early: {tier: decisional, bytes: 1000, utility: [0, 0.5]}, late: {tier: residual, bytes: 500}}}}\n");
  write("scenarios/nominal.yaml", "duration_s: 2000\n");
  schedule_.emplace();
  schedule_->limited(true);
  schedule_->downlinks().resize(1);
  schedule_->downlinks()[0].activity("d");
  schedule_->downlinks()[0].products().resize(1);
  schedule_->downlinks()[0].products()[0].id("late");
  const Heard heard =
      fly({{5s, command("p", "camera", "panorama", {})}, {50s, command("d", "radio", "send", {})}}, 100s);
  EXPECT_THAT(stages(heard, "d"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_COMPLETED));
  ASSERT_EQ(heard.products.size(), 4u);
  EXPECT_EQ(heard.products[0].id(), "early");
  EXPECT_EQ(heard.products[0].product_kind(), "early");
  EXPECT_EQ(heard.products[0].source(), "p");
  EXPECT_EQ(heard.products[0].tier(), v1::TIER_DECISIONAL);
  EXPECT_EQ(heard.products[0].created_us(), 15'000'000);
  EXPECT_EQ(heard.products[0].utility(), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(heard.products[2].id(), "late");
  EXPECT_EQ(heard.products[2].fate(), v1::PRODUCT_SENT);
  EXPECT_EQ(heard.products[3].id(), "late");
  EXPECT_EQ(heard.products[3].fate(), v1::PRODUCT_RECEIVED);
  EXPECT_EQ(heard.end.count(), heard.products[3].header().stamp_us() + 1'000'000)
      << "the run lasts until what was sent is received";
  std::ifstream in(folder_ / "products.jsonl");
  std::vector<std::string> fates;
  for (std::string line; std::getline(in, line);) {
    const auto told = nlohmann::json::parse(line);
    fates.push_back(told.value("id", "") + " " + told.value("tier", "") + " " + told.value("fate", ""));
  }
  EXPECT_THAT(fates, ElementsAre("early decisional stored", "late residual stored", "late residual sent",
                                 "late residual received"));
}

// The timelines of images that the robot has forgotten leave the wire, too: who joins late hears of the newest of them.
TEST_F(SimService, ALateJoinerHearsOfTheImagesThatTheRobotRemembers) {
  constexpr int kCameras = 130, kRounds = 16, kEndedKept = 64;
  static_assert(kCameras * kRounds > world::ImageStore::kSent + kEndedKept);
  std::string components;
  for (int i = 0; i < kCameras; ++i) {
    const std::string number = std::to_string(i);
    components += "        - {name: camera" + number + ", type: camera, duration_s: 1, duration_noise: 0, " +
                  "width_px: 8, height_px: 8}\n        - {name: radio" + number +
                  ", type: radio, rate_bit_s: 1e9}\n";
  }
  write("mission.yaml",
        "site: site.yaml\nwindows: [{timeline: comm.window, open: [[0, 9000]]}]\n"
        "simulation:\n  robots:\n    - name: rover\n      power: {}\n      components:\n" +
            components);
  write("scenarios/nominal.yaml", "duration_s: 2000\nstart: {x: 20, y: 20, battery: 500000}\n");
  services::SimRun run({"sim_svc", "exec_svc", "arm_svc"});
  run.master.restart_hold_s = 1000;  // mission time waits for the service that was killed
  services::Node& simulator = run.add("sim_svc");
  services::RunSettings settings;
  settings.mission = folder_;
  const auto service = make_service(simulator, settings);
  services::Node& executive = run.add("exec_svc");
  const auto sender = services::advertise(executive, topics::command);
  const auto command_all = [&sender](const std::string& component, const std::string& name, int round) {
    for (int i = 0; i < kCameras; ++i) {
      const std::string image = "i" + std::to_string(round * kCameras + i);
      sender.write(command(name + "-" + image, component + std::to_string(i), name, {{"image", image}}));
    }
  };
  for (int round = 0; round < kRounds; ++round) {
    executive.at(round * 10s + 1s, [&command_all, round] { command_all("camera", "image", round); });
    executive.at(round * 10s + 5s, [&command_all, round] { command_all("radio", "send", round); });
  }
  run.add("arm_svc").at(500s, [] { throw services::Crash{}; });
  simulator.at(600s, [&simulator] { simulator.stop(); });
  run.start();
  run.wait_for_crash("arm_svc");
  std::set<std::string> heard;
  services::subscribe(run.add("arm_svc", 2), topics::observation, [&](const v1::Observation& seen) {
    if (seen.timeline().starts_with("rover.image.")) heard.insert(seen.timeline());
  });
  run.run();
  EXPECT_EQ(heard.size(), world::ImageStore::kSent + kEndedKept);
  for (int i = kCameras; i < kCameras * kRounds; ++i)  // of the first round some are forgotten
    EXPECT_TRUE(heard.contains("rover.image.i" + std::to_string(i))) << i;
}

TEST_F(SimService, UploadsAndRecallsTheScenariosGoals) {
  scenario(
      "stimuli:\n"
      "  - {at_s: 10, goal: {id: g, kind: photo, importance: hard, closes_s: 50, arguments: {x: 1, y: 2}}}\n"
      "  - {at_s: 20, recall: {id: g}}\n");
  const Heard heard = fly({}, 30s);
  ASSERT_EQ(heard.goals.size(), 2u);
  EXPECT_EQ(heard.goals[0].issuer(), "ground");
  EXPECT_EQ(heard.goals[0].importance(), v1::GOAL_HARD);
  EXPECT_EQ(heard.goals[0].closes_us(), 50'000'000);
  EXPECT_EQ(heard.goals[0].arguments().size(), 2u);
  EXPECT_FALSE(heard.goals[0].recalled());
  EXPECT_TRUE(heard.goals[1].recalled());
  EXPECT_EQ(heard.goals[1].goal_kind(), "photo");
}

TEST_F(SimService, AHiddenRockOnTheWayIsAHazard) {
  scenario("world: {rocks: [{x: 35, y: 20, radius: 1}]}\n");
  const Heard heard = fly({{5s, drive("d", "60")}}, 300s);
  EXPECT_THAT(stages(heard, "d"), ElementsAre(v1::STAGE_ACCEPTED, v1::STAGE_FAILED));
  ASSERT_EQ(heard.hazards.size(), 1u);
  EXPECT_EQ(heard.hazards[0].x_m(), 35);
  EXPECT_EQ(heard.hazards[0].radius_m(), 1);
}

TEST_F(SimService, EndsOnceTheMissionIsOverAndNoStimulusIsLeft) {
  EXPECT_EQ(fly({}, 100s).end, 101s);
  scenario("stimuli: [{at_s: 500, battery_loss_j: 1}]\n");
  EXPECT_EQ(fly({}, 100s).end, 501s);
}

TEST_F(SimService, ReportsWhetherTheEventsCameAsExpected) {
  const auto report = [&](const std::string& expect) {
    scenario("world: {rocks: [{x: 35, y: 20, radius: 1}]}\nexpect: " + expect + "\n");
    fly({{5s, drive("d", "60")}}, 300s);
    std::ifstream in(folder_ / services::kExpectedFile);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_THAT(report("[hazard.seen, scenario.over]"), HasSubstr("\"met\": true"));
  EXPECT_THAT(report("[scenario.over, hazard.seen]"),
              HasSubstr("after 0 of 2 events, scenario.over was expected, but there was hazard.seen"));
}

// Orders are the console's in a secure run; a mission may give its world the same right.
TEST_F(SimService, InASecureRunAScenarioSetsValuesOnlyWithTheConsolesRight) {
  scenario("stimuli:\n  - {at_s: 10, set: {id: go, timeline: rover.go, value: true}}\n");
  services::SimRun run({"sim_svc"});
  services::Node& node = run.add("sim_svc");
  services::RunSettings settings;
  settings.mission = folder_;
  EXPECT_NO_THROW(make_service(node, settings));
  settings.secure = true;
  try {
    make_service(node, settings);
    ADD_FAILURE() << "it was made";
  } catch (const mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nominal.yaml:4:"));
    EXPECT_THAT(error.what(), HasSubstr("roci order"));
  }
  std::ofstream(folder_ / "mission.yaml", std::ios::app)
      << "format: 1\nname: m\nservices: [{name: sim_svc, clock: master, rights: [world, console]}]\n";
  EXPECT_NO_THROW(make_service(node, settings));
}

TEST_F(SimService, EndsAtTheLatestWhenTheTimeIsUp) { EXPECT_EQ(fly({}).end, 2000s); }

TEST_F(SimService, TheSameSeedIsTheSameRun) {
  const std::map<temporal::Duration, v1::Command> commands{{5s, drive("d", "40")}};
  const Heard first = fly(commands, 400s, 3);
  EXPECT_EQ(first.observations, fly(commands, 400s, 3).observations);
  EXPECT_NE(first.observations, fly(commands, 400s, 4).observations);
}

TEST_F(SimService, BadFilesAreRefusedByPlaceAndRemedy) {
  services::SimRun run({"sim_svc"});
  services::Node& node = run.add("sim_svc");
  services::RunSettings settings;
  settings.mission = folder_;
  const auto error = [&]() -> std::string {
    try {
      make_service(node, settings);
    } catch (const mission::FileError& fault) {
      return fault.what();
    }
    return "no error";
  };
  scenario("stimuli: [{at_s: 5000, battery_loss_j: 1}]\n");
  EXPECT_THAT(error(), HasSubstr("nominal.yaml:3:18: lies after the end of the run"));
  write("scenarios/nominal.yaml", "duration_s: 9\nstart: {x: 20, y: 20, arm: sampling, battery: 5}\n");
  EXPECT_THAT(error(), HasSubstr("nominal.yaml:2:28: no pose 'sampling' with joints"));
  write("scenarios/nominal.yaml", "duration_s: 9\nstart: {x: 900, y: 20, arm: stow, battery: 5}\n");
  EXPECT_THAT(error(), HasSubstr("nominal.yaml:2:8: the rover would start outside the map"));
  write("rocks.pgm", "P2\nhello\n");
  scenario("");
  EXPECT_THAT(error(), HasSubstr("rocks.pgm"));
  settings.scenario = "nominl";
  EXPECT_THAT(error(), HasSubstr("choose one of: nominal"));
}

TEST(WorldFile, IsWaitedForOnceASecondAndWrittenEachTime) {
  const auto file = std::filesystem::path(testing::TempDir()) / "roci_synced_world";
  WorldFile world(file);
  durable::synced().clear();
  const services::clock::WallTime begin{};
  const std::pair<int, std::size_t> syncs[] = {{0, 2}, {400, 2}, {999, 2}, {1000, 4}, {1500, 4}, {2100, 6}};
  for (const auto& [ms, count] : syncs) {
    world.keep({temporal::seconds(ms), {}, {}}, begin + std::chrono::milliseconds(ms));
    EXPECT_EQ(durable::synced().size(), count) << "file and folder, after " << ms << " ms";
    EXPECT_EQ(WorldFile(file).read()->at, temporal::seconds(ms));
  }
  std::filesystem::remove(file);
}

TEST(WorldFile, ComesBackAsItWas) {
  world::WorldMemory memory{temporal::seconds(7.5), {}, {{"soil", "there"}, {"rock", ""}}};
  world::RobotMemory& rover = memory.robots["rover"];
  rover.pose = world::Pose{1.25, -2, 0.5};
  rover.energy_j = 1234.5;
  rover.images["one"] = {"one",     "rover",      "p1.2-image", 1400000, true, temporal::seconds(3),
                         {1, 2, 3}, {0, 128, 255}};
  rover.components["drill"] = {{"state", temporal::state("in", {"hole"})}, {"number:depth", 20.5}};
  memory.robots["lander"] = {};
  world::RobotMemory& digger = memory.robots["digger"];
  digger.temperatures_k = {{"arm", 151.25}, {"dish", 90}};
  digger.data.products = {{"quakes-2",
                           "quakes",
                           "digger",
                           "park#3",
                           6000000,
                           world::Tier::decisional,
                           world::Fate::sent,
                           temporal::seconds(4),
                           {0, 0.5}}};
  digger.data.made = {{"quakes", 2}};
  const auto file = std::filesystem::path(testing::TempDir()) / "roci_world_file";
  std::filesystem::remove(file);
  EXPECT_FALSE(WorldFile(file).read().has_value());
  WorldFile(file).keep(memory, {});
  const auto back = WorldFile(file).read();
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(to_text(*back), to_text(memory));
  EXPECT_EQ(back->robots.at("rover").images, rover.images);
  EXPECT_EQ(back->robots.at("rover").components, rover.components);
  EXPECT_EQ(back->robots.at("digger").temperatures_k, digger.temperatures_k);
  EXPECT_EQ(back->robots.at("digger").data.products, digger.data.products);
  EXPECT_EQ(back->robots.at("digger").data.made, digger.data.made);
  EXPECT_FALSE(back->robots.at("lander").pose.has_value());
  for (const char* damaged :
       {"", "{", "[]", "{\"at_us\":1}", "{\"at_us\":1,\"samples\":{},\"robots\":{\"rover\":{}}}",
        "{\"at_us\":1,\"samples\":{},\"robots\":{\"r\":{\"images\":{},\"components\":{},\"data\":{\"made\":{}"
        ",\"products\":[{}]}}}}"})
    EXPECT_FALSE(world_memory_from(damaged).has_value()) << damaged;
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace roci::sim
