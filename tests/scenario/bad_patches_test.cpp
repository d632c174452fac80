// Map patches that nobody may believe, over each transport: from nobody, off the map, not finite, older than what is
// known. The path planner of missions/faster's primary refuses them, names them, and plans on with the map as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "pathplan_svc/pathplan_service.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::scenario {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
namespace topics = services::topics;

constexpr char kMission[] = ROCI_SOURCE_DIR "/missions/faster";

v1::MapPatch patch(const std::string& author, const std::string& id, double x, double y,
                   std::uint64_t version = 2) {
  v1::MapPatch out;
  out.author(author);
  out.map_version(version);
  v1::MapObstacle one;
  one.found_by("scout");
  one.id(id);
  one.obstacle_kind(v1::OBSTACLE_SOIL);
  one.x_m(x);
  one.y_m(y);
  one.radius_m(1);
  out.obstacles({one});
  return out;
}

// The vendors are those of the primary's path planner, and of all that tell it something.
class BadPatches : public testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  BadPatches()
      : folder_(std::filesystem::temp_directory_path() / ("roci_patches_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    run_.robots = {{"primary.path", "primary"}, {"scout.path", "scout"}};
    services::RunSettings settings;
    settings.mission = kMission;
    settings.settings = std::filesystem::path(kMission) / "primary.yaml";
    settings.run_folder = folder_;
    services::subscribe(world_, topics::event, [this](const v1::Event& event) {
      if (event.code().starts_with("map.")) events_.push_back(event.code() + " " + event.text());
    });
    planner_ = pathplan::make_service(run_.add("primary.path", 1, GetParam().first), settings);
  }
  ~BadPatches() override {
    planner_.reset();
    std::filesystem::remove_all(folder_);
  }

  services::Node& add_world() {
    run_.master.restart_hold_s = 1000;
    return run_.add("sim_svc", 1, GetParam().second);
  }
  void send(services::Node& node, temporal::Duration when, v1::MapPatch what) {
    const auto patches =
        std::make_shared<services::Publisher<v1::MapPatch>>(services::advertise(node, topics::map_patch));
    node.at(when, [patches, what = std::move(what)] { patches->write(what); });
  }
  void ask_at(temporal::Duration when) {
    world_.at(when, [this] {
      v1::PathRequest request;
      request.origin().x_m(5);
      request.origin().y_m(15);
      request.goal_pose().x_m(20);
      request.goal_pose().y_m(15);
      paths_.call(request, "primary.path", 1s, [this](const services::CallResult<v1::PathReply>& result) {
        ASSERT_EQ(result.status, services::rpc::CallStatus::ok) << result.reason;
        versions_.push_back(result.reply.map_version());
      });
    });
  }

  const std::filesystem::path folder_;
  services::process::DomainClaim domain_;
  services::SimRun run_{{"sim_svc", "primary.path", "scout.path"}, domain_.id()};
  services::Node& world_ = add_world();
  services::Client<v1::PathRequest, v1::PathReply> paths_{world_, topics::path_request};
  std::unique_ptr<services::Service> planner_;
  std::vector<std::string> events_;
  std::vector<std::uint64_t> versions_;
};

TEST_P(BadPatches, AreRefusedAndNamedAndTheMapStaysAsItWas) {
  services::Node& scout = run_.add("scout.path", 2, GetParam().second);
  send(world_, 1s, patch("scout.path", "a", 12, 15));
  send(world_, 2s, patch("nobody", "a", 12, 15));
  send(world_, 3s, patch("sim_svc", "a", 12, 15));
  send(scout, 4s, patch("scout.path", "a", 12, 99));
  send(scout, 5s, patch("primary.path", "a", 12, 15));
  ask_at(6s);
  send(scout, 7s, patch("scout.path", "a", 12, 15));
  ask_at(8s);
  world_.at(9s, [this] { world_.stop(); });
  run_.run();
  EXPECT_THAT(events_,
              ElementsAre(HasSubstr("map.patch_refused patch 1 of scout.path: it comes from 'sim_svc'"),
                          HasSubstr("of nobody: it comes from 'sim_svc'"),
                          HasSubstr("of sim_svc: its author is no service of the team's robots"),
                          HasSubstr("'a': it lies off the map"),
                          HasSubstr("of primary.path: it comes from 'scout.path'"),
                          HasSubstr("map.patch_taken"), HasSubstr("map.changed")));
  EXPECT_THAT(versions_, ElementsAre(1U, 2U));
}

TEST_P(BadPatches, ThatAreNotFiniteAreRefused) {
  services::Node& scout = run_.add("scout.path", 1, GetParam().second);
  send(scout, 1s, patch("scout.path", "a", std::nan(""), 15));
  ask_at(2s);
  world_.at(3s, [this] { world_.stop(); });
  run_.run();
  EXPECT_THAT(events_,
              ElementsAre(HasSubstr("patch 1 of scout.path: 'a': it has no finite place and radius")));
  EXPECT_THAT(versions_, ElementsAre(1U));
}

TEST_P(BadPatches, OfAnEarlierLifeOfTheirAuthorAreRefused) {
  services::Node& scout = run_.add("scout.path", 2, GetParam().second);
  send(scout, 1s, patch("scout.path", "a", 12, 15));
  scout.at(2s, [] { throw services::Crash{}; });
  world_.at(2s, [] {});
  ask_at(6s);
  world_.at(7s, [this] { world_.stop(); });
  run_.start();
  run_.wait_for_crash("scout.path");
  services::Node& before = run_.add("scout.path", 1, GetParam().second);
  send(before, 4s, patch("scout.path", "b", 12, 10, 1));
  run_.run();
  EXPECT_THAT(events_,
              ElementsAre(HasSubstr("map.patch_taken"), HasSubstr("map.changed"),
                          HasSubstr("patch 1 of scout.path: a newer one of the same author is known")));
  EXPECT_THAT(versions_, ElementsAre(2U));
}

#ifdef ROCI_ALL_TRANSPORTS
const std::vector<std::pair<const char*, const char*>> kTransports{{"fastdds", "fastdds"},
                                                                   {"cyclonedds", "cyclonedds"},
                                                                   {"fastdds", "cyclonedds"},
                                                                   {"cyclonedds", "fastdds"}};
#else
const std::vector<std::pair<const char*, const char*>> kTransports{{"inproc", "inproc"},
                                                                   {"cyclonedds", "cyclonedds"}};
#endif

INSTANTIATE_TEST_SUITE_P(Transports, BadPatches, testing::ValuesIn(kTransports), [](const auto& one) {
  return std::string(one.param.first) + "_" + one.param.second;
});

}  // namespace
}  // namespace roci::scenario
