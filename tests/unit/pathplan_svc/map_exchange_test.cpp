// Path planners of two robots under one clock: each with a map of its own, and what they tell each other of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/mission/entry.hpp"
#include "pathplan_svc/pathplan_service.hpp"
#include "services/link/link_table.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::pathplan {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace topics = services::topics;

class MapExchange : public testing::Test {
 protected:
  MapExchange() {
    std::filesystem::create_directories(folder_);
    std::string rocks = "P2\n40 40\n255\n";
    for (int i = 0; i < 40 * 40; ++i) rocks += "255 ";
    std::ofstream(folder_ / "rocks.pgm") << rocks;
    std::ofstream(folder_ / "site.yaml") << "image: rocks.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: "
                                            "0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    std::ofstream(folder_ / "mission.yaml")
        << "format: 1\nname: two\nrobots: [primary, scout]\nsite: site.yaml\nservices:\n"
           "  - {name: world, program: sim_svc, clock: master}\n"
           "  - {name: primary.path, program: pathplan_svc, robot: primary, settings: primary.yaml}\n"
           "  - {name: scout.path, program: pathplan_svc, robot: scout, settings: scout.yaml}\n";
    std::ofstream(folder_ / "primary.yaml")
        << "format: 1\nname: two\nbase: mission.yaml\nrover: {radius_m: 0.8}\nmap: {tell: on_request}\n";
    std::ofstream(folder_ / "scout.yaml")
        << "format: 1\nname: two\nbase: mission.yaml\nrover: {radius_m: 0.4}\nmap: {tell: at_once}\n";
    run_.robots = {{"primary.path", "primary"}, {"scout.path", "scout"}, {"stranger", "scout"}};
    services::subscribe(world_, topics::event, [this](const v1::Event& event) {
      events_.push_back(event.header().sender() + " " + event.code());
      texts_.push_back(event.text());
    });
    services::subscribe(world_, topics::map_patch,
                        [this](const v1::MapPatch& patch) { patches_.push_back(patch); });
    services::subscribe(world_, topics::command_ack,
                        [this](const v1::CommandAck& ack) { acks_.push_back(ack); });
    services::subscribe(world_, topics::known_map,
                        [this](const v1::KnownMap& map) { known_[map.planner()] = map; });
    services::subscribe(world_, topics::function_offer, [this](const v1::FunctionOffer& offer) {
      versions_[offer.owner()] = offer.model_version();
    });
  }
  ~MapExchange() override { std::filesystem::remove_all(folder_); }

  void start(const std::vector<std::string>& who = {"primary.path", "scout.path"}) {
    for (const std::string& name : who) {
      services::RunSettings settings;
      settings.mission = folder_;
      settings.settings = folder_ / (name.substr(0, name.find('.')) + ".yaml");
      settings.run_folder = folder_;
      services_.push_back(make_service(run_.add(name), settings));
    }
  }
  void run(temporal::Duration end) {
    world_.after(end, [this] { world_.stop(); });
    run_.run();
  }

  void find(temporal::Duration when, const std::string& robot, const std::string& id, double x, double y,
            double radius = 2, bool cleared = false) {
    world_.after(when, [=, this] {
      v1::TerrainFinding out;
      out.robot(robot);
      out.id(id);
      out.obstacle_kind(v1::OBSTACLE_SOIL);
      out.x_m(x);
      out.y_m(y);
      out.radius_m(radius);
      out.cleared(cleared);
      out.found_us(when.count());
      findings_.write(out);
    });
  }
  void command(temporal::Duration when, const std::string& owner, const std::string& subsystem,
               const std::string& name, const std::string& activity,
               const std::map<std::string, std::string>& arguments = {},
               v1::CommandAction action = v1::COMMAND_EXECUTE, std::int64_t latest_end_us = -1) {
    world_.after(when, [=, this] {
      v1::Command out;
      out.action(action);
      out.commander("exec");
      out.epoch(1);
      out.sender_epoch(1);
      out.activity(activity);
      out.attempt(1);
      out.owner(owner);
      out.subsystem(subsystem);
      out.command_name(name);
      out.latest_end_us(latest_end_us);
      for (const auto& [key, value] : arguments) {
        v1::Property one;
        one.name(key);
        one.value(value);
        out.arguments().push_back(one);
      }
      commands_.write(out);
    });
  }
  void merge(temporal::Duration when, const std::string& activity,
             std::map<std::string, std::string> arguments, std::int64_t latest_end_us = -1) {
    arguments.emplace("author", "scout.path");
    command(when, "primary.path", "map", "merge", activity, arguments, v1::COMMAND_EXECUTE, latest_end_us);
  }
  // The radio between the robots, over which a patch takes so long.
  void set_light_time(temporal::Duration time) {
    services::link::Link radio;
    radio.name = "radio";
    radio.ends = {"primary", "scout"};
    radio.light_time = time;
    run_.links =
        services::link::LinkTable({radio}, {{"primary.path", "primary"}, {"scout.path", "scout"}}, 1);
  }
  // "<s> <activity> <stage> <code>" of each word on a command.
  std::vector<std::string> words() const {
    static const std::vector<std::string> stages{"accepted",  "rejected",      "completed", "failed",
                                                 "cancelled", "cancel-failed", "unknown"};
    std::vector<std::string> out;
    for (const v1::CommandAck& ack : acks_) {
      std::ostringstream line;
      line << static_cast<double>(ack.header().stamp_us()) / 1e6 << " " << ack.activity() << " "
           << stages.at(ack.stage()) << (ack.code().empty() ? "" : " ") << ack.code();
      out.push_back(line.str());
    }
    return out;
  }
  double result(const std::string& activity, const std::string& name) const {
    for (const v1::CommandAck& ack : acks_)
      for (const v1::NamedValue& one : ack.outcome().measured())
        if (ack.activity() == activity && one.name() == name) return one.held().number();
    return std::nan("");
  }

  void ask(temporal::Duration when, const std::string& whom) {
    world_.after(when, [=, this] {
      v1::PathRequest request;
      request.origin().x_m(5);
      request.origin().y_m(20);
      request.goal_pose().x_m(35);
      request.goal_pose().y_m(20);
      paths_.call(request, whom, 1s, [this, whom](const services::CallResult<v1::PathReply>& result) {
        ASSERT_EQ(result.status, services::rpc::CallStatus::ok) << result.reason;
        replies_[whom].push_back(result.reply);
      });
    });
  }
  // How near a path comes to a point.
  static double gap(const v1::PathReply& path, double x, double y) {
    double least = INFINITY;
    for (const auto& p : path.waypoints()) least = std::min(least, std::hypot(p.x_m() - x, p.y_m() - y));
    return least;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roci_exchange_" + std::to_string(::getpid()));
  services::SimRun run_{{"world", "primary.path", "scout.path"}};
  services::Node& world_ = run_.add("world");
  services::Publisher<v1::TerrainFinding> findings_ = services::advertise(world_, topics::terrain_finding);
  services::Publisher<v1::MapPatch> forged_ = services::advertise(world_, topics::map_patch);
  services::Publisher<v1::Command> commands_ = services::advertise(world_, topics::command);
  services::Client<v1::PathRequest, v1::PathReply> paths_{world_, topics::path_request};
  std::vector<std::unique_ptr<services::Service>> services_;
  std::vector<std::string> events_, texts_;
  std::vector<v1::MapPatch> patches_;
  std::vector<v1::CommandAck> acks_;
  std::map<std::string, v1::KnownMap> known_;
  std::map<std::string, std::uint64_t> versions_;
  std::map<std::string, std::vector<v1::PathReply>> replies_;
};

TEST_F(MapExchange, AFindingIsOnTheFindersMapAndByItsPatchOnTheOthers) {
  start();
  ask(1s, "primary.path");
  find(2s, "scout", "scout-soil-1", 20, 20);
  ask(3s, "primary.path");
  ask(3s, "scout.path");
  run(4s);
  ASSERT_EQ(replies_["primary.path"].size(), 2U);
  EXPECT_EQ(replies_["primary.path"][0].map_version(), 1U);
  EXPECT_LT(gap(replies_["primary.path"][0], 20, 20), 2);
  EXPECT_EQ(replies_["primary.path"][1].map_version(), 2U);
  EXPECT_GE(gap(replies_["primary.path"][1], 20, 20), 2.8) << "its own radius counts";
  EXPECT_GE(gap(replies_["scout.path"][0], 20, 20), 2.4);
  ASSERT_EQ(patches_.size(), 1U);
  EXPECT_EQ(patches_[0].author(), "scout.path");
  EXPECT_EQ(patches_[0].map_version(), 2U);
  ASSERT_EQ(patches_[0].obstacles().size(), 1U);
  EXPECT_EQ(patches_[0].obstacles()[0].found_by(), "scout");
  EXPECT_THAT(events_, testing::IsSupersetOf({"scout.path map.told", "primary.path map.patch_taken",
                                              "primary.path map.changed", "scout.path map.changed"}));
}

TEST_F(MapExchange, WhoTellsOnRequestKeepsItToItselfUntilThen) {
  start();
  find(1s, "primary", "primary-soil-1", 20, 20);
  ask(2s, "scout.path");
  command(3s, "primary.path", "map", "tell", "a1");
  ask(4s, "scout.path");
  run(5s);
  ASSERT_EQ(replies_["scout.path"].size(), 2U);
  EXPECT_LT(gap(replies_["scout.path"][0], 20, 20), 2) << "the scout does not know of it";
  EXPECT_GE(gap(replies_["scout.path"][1], 20, 20), 2.4);
  ASSERT_FALSE(acks_.empty());
  const v1::CommandAck& last = acks_.back();
  EXPECT_EQ(last.stage(), v1::STAGE_COMPLETED);
  ASSERT_EQ(last.outcome().measured().size(), 2U);
  EXPECT_EQ(last.outcome().measured()[0].name(), "map_version");
  EXPECT_EQ(last.outcome().measured()[0].held().number(), 2);
  EXPECT_EQ(last.outcome().measured()[1].held().number(), 1);
}

TEST_F(MapExchange, AMergeEndsWhenThePatchIsInTheMap) {
  set_light_time(5s);
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  merge(2s, "a1", {{"version", "2"}});
  merge(10s, "a2", {{"version", "2"}});
  merge(11s, "a3", {});
  ask(12s, "primary.path");
  run(13s);
  EXPECT_THAT(words(), ElementsAre("2 a1 accepted", "6 a1 completed", "10 a2 accepted", "10 a2 completed",
                                   "11 a3 accepted", "11 a3 completed"));
  EXPECT_EQ(result("a1", "map_version"), 2);
  EXPECT_EQ(result("a1", "obstacles"), 1);
  EXPECT_EQ(result("a1", "author_version"), 2);
  EXPECT_EQ(result("a1", "told_s"), 1);
  EXPECT_EQ(result("a1", "age_s"), 5);
  EXPECT_EQ(result("a3", "age_s"), 10);
  EXPECT_GE(gap(replies_["primary.path"].at(0), 20, 20), 2.8);
}

TEST_F(MapExchange, AMergeWaitsForTheVersionThatItNames) {
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  merge(2s, "a1", {{"version", "3"}});
  find(7s, "scout", "scout-soil-2", 10, 10);
  run(9s);
  EXPECT_THAT(words(), ElementsAre("2 a1 accepted", "7 a1 completed"));
  EXPECT_EQ(result("a1", "map_version"), 3);
}

// A smaller robot's map may lose no cell by what holds off a larger one: the merge waits for that all the same.
TEST_F(MapExchange, AMergeWaitsForAFindingThatChangesNoCellOfItsAuthorsMap) {
  set_light_time(5s);
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  find(10s, "scout", "scout-soil-2", 20, 20.2, 1.75);
  command(11s, "scout.path", "map", "tell", "a1");
  merge(12s, "a2", {{"version", "3"}});
  run(30s);
  EXPECT_EQ(versions_["scout.path"], 2U) << "no cell of the scout's map is another one";
  EXPECT_THAT(words(), ElementsAre("11 a1 accepted", "11 a1 completed", "12 a2 accepted", "15 a2 completed"));
  EXPECT_EQ(result("a1", "map_version"), 3);
  EXPECT_EQ(result("a2", "author_version"), 3);
  EXPECT_EQ(result("a2", "obstacles"), 2);
  EXPECT_EQ(known_["scout.path"].map_version(), 3U);
  EXPECT_EQ(known_["scout.path"].told_version(), 3U);
}

// A path planner that starts again gets all findings of its robot at once, each of them once.
TEST_F(MapExchange, NoFindingOfTheRobotIsLostWhereMoreComeThanChangesMayWait) {
  start();
  for (int i = 0; i < 400; ++i)
    find(1s, "scout", "scout-soil-" + std::to_string(1000 + i), i / 20 * 2 + 0.5, i % 20 * 2 + 0.5, 0.3);
  ask(2s, "scout.path");
  run(3s);
  EXPECT_THAT(events_, Not(Contains("scout.path map.finding_refused")));
  EXPECT_EQ(known_["scout.path"].obstacles().size(), 400U);
  ASSERT_FALSE(patches_.empty());
  EXPECT_EQ(patches_.back().obstacles().size(), 400U);
  EXPECT_LE(patches_.size(), 3U) << "the team is told of a burst, and not of each of it";
  EXPECT_GE(gap(replies_["scout.path"].at(0), 32.5, 20.5), 0.7) << "the last ones are in the map, too";
}

TEST_F(MapExchange, AMergeThatWaitsInVainFailsAtItsLatestEndOrAtItsOwnTime) {
  start();
  merge(1s, "a1", {{"version", "2"}}, 5'000'000);
  merge(2s, "a2", {{"version", "2"}, {"within_s", "4"}}, 9'000'000);
  merge(3s, "a3", {{"version", "2"}}, 1'000'000);
  find(20s, "scout", "scout-soil-1", 20, 20);
  merge(21s, "a4", {{"version", "3"}});
  run(700s);
  EXPECT_THAT(words(),
              ElementsAre("1 a1 accepted", "2 a2 accepted", "3 a3 accepted", "3 a3 failed patch-missing",
                          "5 a1 failed patch-missing", "6 a2 failed patch-missing", "21 a4 accepted",
                          "621 a4 failed patch-missing"));
  EXPECT_THAT(acks_[4].reason(), HasSubstr("no patch of scout.path with version 2 came; it has told none"));
  EXPECT_THAT(acks_.back().reason(), HasSubstr("version 3 came; the newest that was taken has version 2"));
}

TEST_F(MapExchange, AMergeOfNobodysMapIsRejectedAtOnce) {
  start();
  merge(1s, "a1", {{"author", "stranger"}});
  merge(2s, "a2", {{"author", "world"}});
  merge(3s, "a3", {{"author", "primary.path"}});
  merge(4s, "a4", {{"author", "scout.pth"}});
  merge(5s, "a5", {{"version", "new"}});
  merge(6s, "a6", {{"version", "1.5"}});
  merge(7s, "a7", {{"within_s", "0"}});
  run(8s);
  EXPECT_THAT(words(), ElementsAre("1 a1 rejected unknown-author", "2 a2 rejected unknown-author",
                                   "3 a3 rejected unknown-author", "4 a4 rejected unknown-author",
                                   "5 a5 rejected bad-arguments", "6 a6 rejected bad-arguments",
                                   "7 a7 rejected bad-arguments"));
  EXPECT_THAT(acks_[3].reason(), HasSubstr("did you mean 'scout.path'?"));
}

TEST_F(MapExchange, AMergeThatWaitsIsCancelledOrStopped) {
  start();
  merge(1s, "a1", {{"version", "2"}});
  merge(1s, "a2", {{"version", "2"}});
  command(2s, "primary.path", "map", "merge", "a1", {}, v1::COMMAND_CANCEL);
  command(3s, "primary.path", "map", "stop", "a3");
  find(4s, "scout", "scout-soil-1", 20, 20);
  run(5s);
  EXPECT_THAT(words(), ElementsAre("1 a1 accepted", "1 a2 accepted", "2 a1 cancelled cancelled",
                                   "3 a2 cancelled stopped", "3 a3 completed done"));
}

TEST_F(MapExchange, NoMoreMergesWaitThanTheBound) {
  start();
  for (int i = 0; i < 65; ++i) merge(1s, "a" + std::to_string(i), {{"version", "2"}});
  run(2s);
  EXPECT_THAT(words(), Contains(HasSubstr("rejected busy")).Times(1));
}

// What one life of the author told is not taken for what another one told.
TEST_F(MapExchange, AnAuthorThatWasStartedAgainCountsItsVersionsOn) {
  services::RunSettings settings;
  settings.mission = folder_;
  settings.settings = folder_ / "scout.yaml";
  start({"primary.path"});
  services_.push_back(make_service(run_.add("scout.path", 2), settings));
  find(1s, "scout", "scout-soil-1", 20, 20);
  merge(2s, "a1", {{"version", "2"}});
  run(3s);
  EXPECT_EQ(patches_.at(0).map_version(), 1'000'002U);
  EXPECT_EQ(result("a1", "author_version"), 1'000'002);
}

TEST_F(MapExchange, OtherCommandsAreRejectedWithTheRemedy) {
  start();
  command(1s, "primary.path", "wheels", "drive", "a1");
  run(2s);
  ASSERT_EQ(acks_.size(), 1U);
  EXPECT_EQ(acks_[0].stage(), v1::STAGE_REJECTED);
  EXPECT_EQ(acks_[0].code(), "unknown-command");
  EXPECT_THAT(acks_[0].reason(), HasSubstr("has 'map' with the commands tell and merge"));
}

// The merged map of one robot is what it tells: also what a third has found.
TEST_F(MapExchange, AMapIsToldWithWhatOthersHaveFound) {
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  find(2s, "primary", "primary-soil-1", 10, 10, 1);
  command(3s, "primary.path", "map", "tell", "a1");
  run(4s);
  ASSERT_EQ(patches_.size(), 2U);
  ASSERT_EQ(patches_[1].obstacles().size(), 2U);
  EXPECT_EQ(patches_[1].obstacles()[0].found_by(), "primary");
  EXPECT_EQ(patches_[1].obstacles()[1].found_by(), "scout");
  EXPECT_EQ(versions_["scout.path"], 3U) << "its own finding and the primary's: two changes of cells";
}

TEST_F(MapExchange, WhatHasGoneGoesFromAllMaps) {
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  find(2s, "scout", "scout-soil-1", 20, 20, 2, true);
  ask(3s, "primary.path");
  run(4s);
  EXPECT_LT(gap(replies_["primary.path"][0], 20, 20), 2);
  EXPECT_EQ(replies_["primary.path"][0].map_version(), 3U);
}

TEST_F(MapExchange, APatchOfNobodyOffTheMapOrNotFiniteIsRefusedAndNamedAndTheMissionGoesOn) {
  start();
  const auto forge = [this](temporal::Duration when, const std::string& author, double x) {
    world_.after(when, [=, this] {
      v1::MapPatch out;
      out.author(author);
      v1::MapObstacle one;
      one.found_by("scout");
      one.id("a");
      one.x_m(x);
      one.y_m(20);
      one.radius_m(2);
      out.obstacles({one});
      forged_.write(out);
    });
  };
  forge(1s, "nobody", 20);
  forge(2s, "scout.path", 20);  // not sent by that one
  forge(3s, "world", 20);       // of no robot
  find(4s, "scout", "off", 99, 20);
  find(5s, "scout", "nan", std::nan(""), 20);
  ask(6s, "primary.path");
  ask(6s, "scout.path");
  run(7s);
  EXPECT_THAT(events_, Contains("primary.path map.patch_refused").Times(3)) << "once for each author";
  EXPECT_THAT(events_, Contains("scout.path map.patch_refused"));
  EXPECT_THAT(events_, Contains("scout.path map.finding_refused"));
  EXPECT_THAT(events_, Not(Contains("primary.path map.finding_refused"))) << "whom it does not concern";
  EXPECT_EQ(replies_["primary.path"].at(0).map_version(), 1U);
  EXPECT_EQ(replies_["scout.path"].at(0).map_version(), 1U);
}

// Who watches sees what each robot's map has, when it was told and what was taken; also before anything was found.
TEST_F(MapExchange, EachShowsWhatItsMapHasAndWhatItToldAndTook) {
  start();
  world_.after(500ms, [this] {
    ASSERT_TRUE(known_.contains("primary.path"));
    EXPECT_EQ(known_["primary.path"].map_version(), 1U);
    EXPECT_EQ(known_["primary.path"].told_us(), -1);
    EXPECT_TRUE(known_["primary.path"].obstacles().empty());
  });
  find(1s, "scout", "scout-soil-1", 20, 20);
  find(2s, "primary", "primary-soil-1", 10, 10, 1);
  find(3s, "scout", "scout-soil-1", 20, 20);  // nothing new
  run(4s);
  const v1::KnownMap &primary = known_["primary.path"], &scout = known_["scout.path"];
  EXPECT_EQ(primary.header().robot(), "primary");
  EXPECT_EQ(primary.map_version(), 3U);
  EXPECT_EQ(primary.obstacles().size(), 2U);
  EXPECT_EQ(primary.told_us(), -1) << "it tells on request";
  ASSERT_EQ(primary.taken().size(), 1U);
  EXPECT_EQ(primary.taken()[0].author(), "scout.path");
  EXPECT_EQ(primary.taken()[0].map_version(), 2U);
  EXPECT_EQ(primary.taken()[0].taken_us(), 1'000'000);
  EXPECT_EQ(scout.map_version(), 2U);
  ASSERT_EQ(scout.obstacles().size(), 1U) << "the primary has not told of its own";
  EXPECT_EQ(scout.told_version(), 2U);
  EXPECT_EQ(scout.told_us(), 1'000'000);
  EXPECT_TRUE(scout.taken().empty());
}

TEST_F(MapExchange, WhatItKnowsStandsInTheRunFolder) {
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  run(2s);
  for (const std::string name : {"primary.path", "scout.path"}) {
    std::ostringstream text;
    text << std::ifstream(folder_ / (name + ".hazards")).rdbuf();
    EXPECT_THAT(text.str(), HasSubstr("scout-soil-1")) << name;
    EXPECT_THAT(text.str(), HasSubstr("\"kind\": \"soil\"")) << name;
  }
}

// The radio between the rovers: a patch comes late, and a lost one is repeated until it arrives.
TEST_F(MapExchange, APatchPassesTheLinkBetweenTheRobots) {
  services::link::Link radio;
  radio.name = "radio";
  radio.ends = {"primary", "scout"};
  radio.light_time = 2s;
  radio.loss = 0.5;
  run_.links = services::link::LinkTable({radio}, {{"primary.path", "primary"}, {"scout.path", "scout"}}, 1);
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  ask(2500ms, "primary.path");
  ask(60s, "primary.path");
  run(61s);
  ASSERT_EQ(replies_["primary.path"].size(), 2U);
  EXPECT_EQ(replies_["primary.path"][0].map_version(), 1U) << "it is under way";
  EXPECT_EQ(replies_["primary.path"][1].map_version(), 2U);
}

// What is told while the radio is away is one patch afterwards, and nothing of the others is missing in it.
TEST_F(MapExchange, AfterACutTheNewestPatchHoldsAll) {
  services::link::Link radio;
  radio.name = "radio";
  radio.ends = {"primary", "scout"};
  radio.open = services::link::Schedule({}, {{500ms, 200s}});
  run_.links = services::link::LinkTable({radio}, {{"primary.path", "primary"}, {"scout.path", "scout"}}, 1);
  start();
  find(1s, "scout", "scout-soil-1", 20, 20);
  find(100s, "scout", "scout-soil-2", 26, 12);
  ask(199s, "primary.path");
  ask(201s, "primary.path");
  run(202s);
  ASSERT_EQ(replies_["primary.path"].size(), 2U);
  EXPECT_EQ(replies_["primary.path"][0].map_version(), 1U) << "the radio is away";
  EXPECT_EQ(replies_["primary.path"][1].map_version(), 2U);
  std::ostringstream known;
  known << std::ifstream(folder_ / "primary.path.hazards").rdbuf();
  EXPECT_THAT(known.str(), HasSubstr("scout-soil-1"));
  EXPECT_THAT(known.str(), HasSubstr("scout-soil-2"));
}

TEST_F(MapExchange, OnlyThePlannerOfARobotMayTell) {
  run_.robots.clear();
  try {
    start({"scout.path"});
    FAIL();
  } catch (const mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scout.yaml:"));
    EXPECT_THAT(error.what(), HasSubstr("only the path planner of a robot tells of its map"));
  }
}

}  // namespace
}  // namespace roci::pathplan
