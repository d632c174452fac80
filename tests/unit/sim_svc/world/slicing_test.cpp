// What happens, and when, does not depend on how often the world is asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using services::owner::Action;
using services::owner::Request;
using temporal::Duration;
using temporal::seconds;
using temporal::Time;

namespace {

struct Input {
  Time at{};
  Request request;
};

// Drives, images, sends, arm motions, stops and cancels at odd times; some of them get in each other's way.
std::vector<Input> random_inputs(std::uint32_t seed) {
  std::mt19937_64 engine(seed);
  const auto pick = [&](int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); };
  std::vector<Input> inputs;
  Time t = seconds(1);
  for (int i = 0; i < 25; ++i) {
    t += Duration(1 + static_cast<std::int64_t>(engine() % 300000000));
    const std::string id = "a" + std::to_string(i);
    Request request = drive_to(id, "p" + std::to_string(i), 10 + pick(100), 10 + pick(100));
    switch (pick(6)) {
      case 0:
        request = execute(id, "camera", "image", {{"image", "image-" + std::to_string(pick(3))}});
        break;
      case 1:
        request = execute(id, "radio", "send", {{"image", "image-" + std::to_string(pick(3))}});
        break;
      case 2:
        request = execute(id, "nav", "stop");
        break;
      case 3:
        request.key.activity = "a" + std::to_string(pick(25));
        request.action = Action::cancel;
        break;
      case 4:
        request = execute(id, "arm", "move", {{"from", "stow"}, {"to", "stow"}});
        break;
      default:
        break;
    }
    inputs.push_back({t, request});
  }
  return inputs;
}

Outputs obey(World& world, Time now, const Request& request) {
  const TaskKey key{request.key.activity, request.key.attempt};
  if (request.action == Action::cancel) return world.halt(now, key, TaskStage::cancelled, {"cancelled", ""});
  return world.begin(now, {"", request.subsystem, {key, request.command, request.arguments}});
}

// Answers what the world wishes for, at the time of the wish.
void serve(World& world, Time now, Outputs& said, std::size_t from) {
  for (std::size_t i = from; i < said.size(); ++i) {
    if (const auto* path = std::get_if<PathWanted>(&said[i])) {
      const terrain::Point goal{path->x, path->y};
      append(said, world.answer(now, TaskKey(path->key), Way{{{path->x, path->from.y}, goal}}));
    } else if (const auto* motion = std::get_if<MotionWanted>(&said[i])) {
      append(said, world.answer(now, TaskKey(motion->key),
                                Trajectory{{{0, {0, 0, 0, 0, 0}}, {8, {0, 0, 0, 0, 0}}}}));
    }
  }
}

enum class Asking { at_inputs_only, at_random_times, at_wishes };

Outputs fly(Asking asking, std::uint32_t seed) {
  World world(flat_setup().build(), seed);
  std::mt19937_64 engine(seed + 99);
  Outputs said = world.advance(Time{});
  Time now{};
  const auto go_to = [&](Time until) {
    while (asking == Asking::at_random_times && now < until) {
      now = std::min(until, now + Duration(static_cast<std::int64_t>(engine() % 20000000)));
      append(said, world.advance(now));
    }
    for (auto wish = world.next_change(); asking == Asking::at_wishes && *wish <= until;
         wish = world.next_change()) {
      append(said, world.advance(*wish));
    }
    append(said, world.advance(until));
    now = until;
  };
  for (const Input& input : random_inputs(seed)) {
    go_to(input.at);
    const std::size_t from = said.size();
    append(said, obey(world, now, input.request));
    serve(world, now, said, from);
  }
  go_to(seconds(9000));
  return said;
}

TEST(Slicing, DoesNotChangeWhatHappensAndWhen) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Outputs once = fly(Asking::at_inputs_only, seed);
    EXPECT_GT(once.size(), 300u);
    EXPECT_TRUE(once == fly(Asking::at_random_times, seed)) << "seed " << seed;
    EXPECT_TRUE(once == fly(Asking::at_wishes, seed)) << "seed " << seed;
  }
}

TEST(Slicing, NothingHappensBeforeTheAnnouncedChange) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    World world(flat_setup().build(), seed);
    world.advance(Time{});
    for (const Input& input : random_inputs(seed)) {
      for (auto wish = world.next_change(); *wish < input.at; wish = world.next_change()) {
        EXPECT_TRUE(world.advance(*wish - Duration(1)).empty());
        world.advance(*wish);
      }
      Outputs said = obey(world, input.at, input.request);
      serve(world, input.at, said, 0);
    }
  }
}

TEST(Slicing, AnotherSeedIsAnotherRun) {
  const auto arrival = [](std::uint64_t seed) {
    Flight run(flat_setup(), seed);
    run.drive(seconds(1), "d", "there", 60, 20);
    run.advance(seconds(900));
    return run.time_of("d");
  };
  EXPECT_EQ(arrival(5), arrival(5));
  EXPECT_NE(arrival(5), arrival(6));
}

}  // namespace
}  // namespace roci::sim::world
