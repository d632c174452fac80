#include "pathplan_svc/pathplan_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/mission/entry.hpp"
#include "pathplan_svc/limits.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::pathplan {
namespace {

using namespace std::chrono_literals;
using services::CallResult;
using services::rpc::CallStatus;
using testing::ElementsAre;
namespace topics = services::topics;

services::RunSettings planetary(const std::filesystem::path& run_folder = {}) {
  services::RunSettings settings;
  settings.run_folder = run_folder;
  settings.mission = std::string(ROCI_SOURCE_DIR) + "/missions/planetary";
  return settings;
}

v1::PlanObject place(const std::string& name,
                     const std::vector<std::pair<std::string, std::string>>& properties) {
  v1::PlanObject object;
  object.name(name);
  object.object_type("location");
  for (const auto& [key, value] : properties) {
    v1::Property property;
    property.name(key);
    property.value(value);
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

v1::PathRequest path_request(double from_x, double from_y, double to_x, double to_y) {
  v1::PathRequest request;
  request.origin().x_m(from_x);
  request.origin().y_m(from_y);
  request.goal_pose().x_m(to_x);
  request.goal_pose().y_m(to_y);
  return request;
}

v1::Hazard hazard(const std::string& id, double x, double y, double radius, bool cleared = false) {
  v1::Hazard hazard;
  hazard.id(id);
  hazard.x_m(x);
  hazard.y_m(y);
  hazard.radius_m(radius);
  hazard.cleared(cleared);
  return hazard;
}

// The service with a master that asks it things and keeps what it hears.
class PathplanService : public testing::Test {
 protected:
  void SetUp() override {
    services::subscribe(master_, topics::function_offer,
                        [this](const v1::FunctionOffer& offer) { offers_.push_back(offer); });
    services::subscribe(master_, topics::event,
                        [this](const v1::Event& event) { events_.push_back(event.code()); });
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Runs until `end` of mission time.
  void run(temporal::Duration end) {
    master_.after(end, [this] { master_.stop(); });
    run_.run();
  }

  void ask_for_path(temporal::Duration when, const v1::PathRequest& request) {
    master_.after(when, [this, request] {
      paths_.call(request, "pathplan_svc", 1s, [this](const CallResult<v1::PathReply>& result) {
        ASSERT_EQ(result.status, CallStatus::ok) << result.reason;
        path_replies_.push_back(result.reply);
      });
    });
  }

  void ask_for_values(const v1::FunctionRequest& request, const std::string& owner) {
    master_.after(1s, [this, request, owner] {
      functions_.call(request, owner, 1s, [this](const CallResult<v1::FunctionReply>& result) {
        function_results_.push_back(result);
      });
    });
  }

  std::filesystem::path made_folder() const {
    const auto folder =
        std::filesystem::temp_directory_path() / ("roci_pathplan_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    return folder;
  }

  const std::filesystem::path folder_ = made_folder();
  services::SimRun run_{{"master", "pathplan_svc"}};
  services::Node& master_ = run_.add("master");
  std::unique_ptr<services::Service> service_ = make_service(run_.add("pathplan_svc"), planetary(folder_));
  services::Client<v1::PathRequest, v1::PathReply> paths_{master_, topics::path_request};
  services::Client<v1::FunctionRequest, v1::FunctionReply> functions_{master_, topics::function_call};
  services::Publisher<v1::Hazard> hazards_ = services::advertise(master_, topics::hazard);
  std::vector<v1::FunctionOffer> offers_;
  std::vector<std::string> events_;
  std::vector<v1::PathReply> path_replies_;
  std::vector<CallResult<v1::FunctionReply>> function_results_;
};

// Who looks at the run when it is over finds the obstacles that were there at its end.
TEST_F(PathplanService, KeepsTheHazardsThatItKnowsInTheRunFolder) {
  master_.after(1s, [this] {
    hazards_.write(hazard("rock-1", 50, 50, 2));
    hazards_.write(hazard("rock-2", 60, 50, 1));
  });
  master_.after(2s, [this] { hazards_.write(hazard("rock-1", 50, 50, 2, true)); });
  run(3s);
  std::ostringstream text;
  text << std::ifstream(folder_ / "pathplan_svc.hazards").rdbuf();
  EXPECT_THAT(text.str(), testing::HasSubstr("rock-2"));
  EXPECT_THAT(text.str(), testing::Not(testing::HasSubstr("rock-1")));
}

TEST_F(PathplanService, OffersItsFunctions) {
  run(1s);
  ASSERT_EQ(offers_.size(), 1U);
  EXPECT_EQ(offers_[0].module_name(), "pathplan");
  EXPECT_EQ(offers_[0].owner(), "pathplan_svc");
  EXPECT_EQ(offers_[0].model_version(), 1U);
  ASSERT_EQ(offers_[0].functions().size(), 2U);
  EXPECT_EQ(offers_[0].functions()[0].name(), "traverse_time");
  EXPECT_EQ(offers_[0].functions()[1].name(), "traverse_energy");
  for (const v1::FunctionSignature& function : offers_[0].functions()) {
    EXPECT_THAT(function.accuracies(), ElementsAre(v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND));
    EXPECT_TRUE(function.depends_on().empty());
  }
}

// Its worker has not built one of these maps when the last one comes.
TEST_F(PathplanService, MoreHazardsThanItCanTakeAreRefusedByOneEvent) {
  master_.after(500ms, [this] {
    for (std::size_t i = 0; i < kMapChanges + 9; ++i)
      hazards_.write(hazard("rock-" + std::to_string(i), 1, 1, 0.1));
  });
  run(1s);
  EXPECT_THAT(events_, testing::Contains("hazard.refused").Times(1));
  EXPECT_FALSE(offers_.empty());
}

TEST_F(PathplanService, EveryTupleHasItsOwnOutcome) {
  v1::FunctionRequest request;
  request.module_name("pathplan");
  request.objects({place("home", {{"x", "40"}, {"y", "40"}}), place("ridge", {{"x", "110"}, {"y", "60.0"}}),
                   place("crater", {{"x", "190"}, {"y", "60"}}), place("rocks", {{"x", "60"}, {"y", "220"}}),
                   place("far", {{"x", "1e6"}, {"y", "0"}}), place("nowhere", {{"x", "12"}}),
                   place("garbled", {{"x", "12"}, {"y", "3 m"}}), place("nan", {{"x", "nan"}, {"y", "3"}})});
  request.batches({batch("traverse_time", 2, {0, 1, 1, 0, 0, 0, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0, 7, 0, 99}),
                   batch("traverse_energy", 2, {0, 1}), batch("traverse_colour", 2, {0, 1}),
                   batch("traverse_time", 1, {0, 1}), batch("traverse_time", 2, {0, 1, 0})});
  ask_for_values(request, "pathplan_svc");
  ask_for_values(request, "pathplan_svc");
  run(2s);

  ASSERT_EQ(function_results_.size(), 2U);
  ASSERT_EQ(function_results_[0].status, CallStatus::ok) << function_results_[0].reason;
  const v1::FunctionReply& reply = function_results_[0].reply;
  EXPECT_EQ(reply.owner(), "pathplan_svc");
  EXPECT_EQ(reply.model_version(), 1U);
  EXPECT_EQ(reply.computed_us(), 1'000'000);
  ASSERT_EQ(reply.results().size(), 5U);
  EXPECT_THAT(
      reply.results()[0].outcomes(),
      ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_VALUE, v1::FUNCTION_VALUE, v1::FUNCTION_UNREACHABLE,
                  v1::FUNCTION_UNREACHABLE, v1::FUNCTION_UNREACHABLE, v1::FUNCTION_UNKNOWN_OBJECT,
                  v1::FUNCTION_UNKNOWN_OBJECT, v1::FUNCTION_UNKNOWN_OBJECT, v1::FUNCTION_UNKNOWN_OBJECT));
  ASSERT_EQ(reply.results()[0].numbers().size(), 10U);
  const double metres = std::hypot(70, 20);
  EXPECT_GT(reply.results()[0].numbers()[0], metres / 0.1);
  EXPECT_LT(reply.results()[0].numbers()[0], 1.3 * metres / 0.1);
  EXPECT_EQ(reply.results()[0].numbers()[2], 0);
  EXPECT_THAT(reply.results()[1].outcomes(), ElementsAre(v1::FUNCTION_VALUE));
  EXPECT_GT(reply.results()[1].numbers()[0], 28 * metres / 0.1);
  EXPECT_THAT(reply.results()[2].outcomes(), ElementsAre(v1::FUNCTION_UNKNOWN_FUNCTION));
  EXPECT_THAT(reply.results()[3].outcomes(), ElementsAre(v1::FUNCTION_WRONG_ARITY, v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(reply.results()[4].outcomes(), ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(events_, ElementsAre("place.unusable", "place.unusable")) << "each of the two once";
}

TEST_F(PathplanService, AnswersWithTheAccuracyThatIsAskedFor) {
  v1::FunctionRequest request;
  request.module_name("pathplan");
  request.objects({place("home", {{"x", "40"}, {"y", "40"}}), place("ridge", {{"x", "110"}, {"y", "60"}}),
                   place("crater", {{"x", "190"}, {"y", "60"}})});
  for (const char* function : {"traverse_time", "traverse_energy"}) {
    for (const v1::FunctionAccuracy accuracy : {v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND}) {
      request.batches().push_back(batch(function, 2, {0, 1, 0, 0, 0, 2}));
      request.batches().back().accuracy(accuracy);
    }
  }
  ask_for_values(request, "pathplan_svc");
  run(2s);
  ASSERT_EQ(function_results_.size(), 1U);
  const auto& results = function_results_[0].reply.results();
  ASSERT_EQ(results.size(), 4U);
  for (std::size_t i = 0; i < 4; i += 2) {
    EXPECT_EQ(results[i].accuracy(), v1::ACCURACY_EXACT);
    EXPECT_EQ(results[i + 1].accuracy(), v1::ACCURACY_LOWER_BOUND);
    EXPECT_EQ(results[i].outcomes(), results[i + 1].outcomes());
    EXPECT_THAT(results[i].outcomes(),
                ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_VALUE, v1::FUNCTION_UNREACHABLE));
    EXPECT_LT(results[i + 1].numbers()[0], results[i].numbers()[0]);
    EXPECT_GT(results[i + 1].numbers()[0], 0.3 * results[i].numbers()[0]);
    EXPECT_EQ(results[i + 1].numbers()[1], 0);
  }
}

TEST_F(PathplanService, LeavesOtherModulesToTheirOwners) {
  v1::FunctionRequest request;
  request.module_name("arm");
  ask_for_values(request, "");
  run(3s);
  ASSERT_EQ(function_results_.size(), 1U);
  EXPECT_EQ(function_results_[0].status, CallStatus::timeout);
}

TEST_F(PathplanService, PathsHaveWaypointsAFollowerCanUse) {
  ask_for_path(1s, path_request(40, 40, 110, 60));
  ask_for_path(2s, path_request(40, 40, 190, 60));
  ask_for_path(3s, path_request(40, 40, 60, 220));
  ask_for_path(4s, path_request(40, 40, -5, 0));
  run(5s);
  ASSERT_EQ(path_replies_.size(), 4U);
  const auto& way = path_replies_[0].waypoints();
  EXPECT_EQ(path_replies_[0].outcome(), v1::MOTION_FOUND);
  ASSERT_GT(way.size(), 18U);
  EXPECT_EQ(way.front().x_m(), 40);
  EXPECT_EQ(way.back().y_m(), 60);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double east = way[i].x_m() - way[i - 1].x_m();
    const double north = way[i].y_m() - way[i - 1].y_m();
    EXPECT_LE(std::hypot(east, north), 4.0);
    EXPECT_NEAR(way[i - 1].heading_rad(), std::atan2(north, east), 1e-9);
  }
  EXPECT_EQ(path_replies_[1].outcome(), v1::MOTION_UNREACHABLE);
  EXPECT_THAT(path_replies_[1].reason(), testing::HasSubstr("no free ground"));
  EXPECT_EQ(path_replies_[2].outcome(), v1::MOTION_INVALID);
  EXPECT_THAT(path_replies_[2].reason(), testing::HasSubstr("(margin)"));
  EXPECT_EQ(path_replies_[3].outcome(), v1::MOTION_INVALID);
  EXPECT_THAT(path_replies_[3].reason(), testing::HasSubstr("outside the map"));
}

TEST_F(PathplanService, HazardsChangeTheMapUntilTheyAreCleared) {
  const v1::PathRequest request = path_request(40, 40, 110, 60);
  ask_for_path(1s, request);
  master_.after(2s, [this] { hazards_.write(hazard("rock-1", 75, 50, 6)); });
  ask_for_path(3s, request);
  master_.after(4s, [this] { hazards_.write(hazard("rock-1", 75, 50, 6)); });
  master_.after(5s, [this] { hazards_.write(hazard("bad", std::nan(""), 50, 6)); });
  master_.after(6s, [this] { hazards_.write(hazard("rock-1", 0, 0, 0, true)); });
  ask_for_path(7s, request);
  run(8s);
  ASSERT_EQ(path_replies_.size(), 3U);
  EXPECT_EQ(path_replies_[0].map_version(), 1U);
  EXPECT_EQ(path_replies_[1].map_version(), 2U);
  EXPECT_EQ(path_replies_[2].map_version(), 3U);
  EXPECT_GT(path_replies_[1].expected_s(), path_replies_[0].expected_s());
  EXPECT_EQ(path_replies_[2].expected_s(), path_replies_[0].expected_s());
  for (const auto& p : path_replies_[1].waypoints()) EXPECT_GT(std::hypot(p.x_m() - 75, p.y_m() - 50), 6.8);
  EXPECT_THAT(events_, ElementsAre("map.changed", "hazard.refused", "map.changed"));
  ASSERT_EQ(offers_.size(), 3U);
  EXPECT_EQ(offers_[2].model_version(), 3U);
}

TEST(PathplanServiceStart, AMissionWithoutASiteIsRefused) {
  services::SimRun run({"pathplan_svc"});
  services::RunSettings settings;
  settings.mission = "/nowhere";
  EXPECT_THROW(make_service(run.add("pathplan_svc"), settings), mission::FileError);
}

// A mission whose map has a strip of unknown ground from north to south.
class PathplanServiceOnAMapWithHoles : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::string rocks = "P2\n40 20\n255\n";
    for (int i = 0; i < 40 * 20; ++i) rocks += i % 40 == 20 ? "128 " : "255 ";
    std::ofstream(folder_ / "rocks.pgm") << rocks;
    std::ofstream(folder_ / "site.yaml") << "image: rocks.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: "
                                            "0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    std::ofstream(folder_ / "mission.yaml")
        << "format: 1\nname: holes\nrobots: [rover]\nsite: site.yaml\nrover: {radius_m: 0.8}\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roci_holes_" + std::to_string(::getpid()));
};

TEST_F(PathplanServiceOnAMapWithHoles, SaysOnceWhatTheMapDoesNotKnowAndProvesNothingFromIt) {
  services::SimRun run{{"master", "pathplan_svc"}};
  services::Node& master = run.add("master");
  std::vector<v1::Event> events;
  services::subscribe(master, topics::event, [&](const v1::Event& event) { events.push_back(event); });
  services::RunSettings settings;
  settings.mission = folder_;
  const auto service = make_service(run.add("pathplan_svc"), settings);
  services::Client<v1::PathRequest, v1::PathReply> paths(master, topics::path_request);
  services::Client<v1::FunctionRequest, v1::FunctionReply> functions(master, topics::function_call);
  std::vector<v1::PathReply> path_replies;
  std::vector<v1::FunctionReply> function_replies;
  v1::FunctionRequest request;
  request.module_name("pathplan");
  request.objects({place("west", {{"x", "5"}, {"y", "10"}}), place("east", {{"x", "35"}, {"y", "10"}})});
  request.batches({batch("traverse_time", 2, {0, 1})});
  master.after(1s, [&] {
    paths.call(path_request(5, 10, 35, 10), "pathplan_svc", 1s,
               [&](const CallResult<v1::PathReply>& result) { path_replies.push_back(result.reply); });
    functions.call(request, "pathplan_svc", 1s, [&](const CallResult<v1::FunctionReply>& result) {
      function_replies.push_back(result.reply);
    });
  });
  master.after(2s, [&] { master.stop(); });
  run.run();

  ASSERT_EQ(path_replies.size(), 1U);
  EXPECT_EQ(path_replies[0].outcome(), v1::MOTION_UNKNOWN);
  EXPECT_THAT(path_replies[0].reason(), testing::HasSubstr("unknown ground is not driven over"));
  ASSERT_EQ(function_replies.size(), 1U);
  EXPECT_THAT(function_replies[0].results().at(0).outcomes(), ElementsAre(v1::FUNCTION_UNKNOWN));
  const auto told =
      std::ranges::count_if(events, [](const v1::Event& event) { return event.code() == "map.unknown"; });
  EXPECT_EQ(told, 1);
  EXPECT_THAT(events.front().text(), testing::HasSubstr("20 of its 800 cells"));
}

}  // namespace
}  // namespace roci::pathplan
