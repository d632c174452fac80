// Nodes with a link between them, on the simulated clock: what the pure model (unit_services_link) says is
// what handlers see.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/clock/wall.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

link::LinkTable between(const std::string& one, const std::string& other, const link::Link& settings) {
  link::Link link = settings;
  link.name = "radio";
  link.ends = {one, other};
  return {{link}, {{"a", ""}, {"b", ""}, {"c", ""}}, 1};
}

v1::Event an_event(const std::string& text) {
  v1::Event out;
  out.text(text);
  return out;
}

v1::Observation an_observation(const std::string& timeline, double number) {
  v1::Observation out;
  out.timeline(timeline);
  out.observed().number(number);
  return out;
}

// a is the clock's master; b hears it over the link, c as ever.
class LinkGate : public testing::Test {
 protected:
  void fly(const link::Link& settings, temporal::Time end, const std::function<void()>& set_up) {
    run.links = between("a", "b", settings);
    for (const char* name : {"a", "b", "c"}) nodes[name] = &run.add(name);
    for (const char* name : {"b", "c"}) {
      Node& node = *nodes[name];
      auto& log = logs[name];
      subscribe(node, topics::event, [&](const v1::Event& e) { log.push_back(at(node, e.text())); });
      subscribe(node, topics::observation, [&](const v1::Observation& o) {
        log.push_back(at(node, o.timeline() + "=" + std::to_string(static_cast<int>(o.observed().number()))));
      });
    }
    events = advertise(*nodes["a"], topics::event);
    observations = advertise(*nodes["a"], topics::observation);
    set_up();
    a().at(end, [this] { a().stop(); });
    run.run();
  }
  Node& a() { return *nodes["a"]; }
  Node& b() { return *nodes["b"]; }
  static std::string at(const Node& node, const std::string& what) {
    return std::to_string(node.now() / 1ms) + " " + what;
  }

  SimRun run{{"a", "b", "c"}};
  std::map<std::string, Node*> nodes;
  std::map<std::string, std::vector<std::string>> logs;
  Publisher<v1::Event> events;
  Publisher<v1::Observation> observations;
};

TEST_F(LinkGate, TheLightTimeDelaysWhatIsHeardOverTheLinkAlone) {
  link::Link link;
  link.light_time = 1500ms;
  fly(link, 5s, [this] {
    a().at(10ms, [this] { events.write(an_event("one")); });
    a().at(20ms, [this] { events.write(an_event("two")); });
  });
  EXPECT_THAT(logs["b"], ElementsAre("1510 one", "1520 two"));
  EXPECT_THAT(logs["c"], ElementsAre("10 one", "20 two"));
}

TEST_F(LinkGate, WhatArrivesLateComesBeforeWhatIsSaidNow) {
  link::Link link;
  link.light_time = 1s;
  fly(link, 5s, [this] {
    a().at(1s, [this] { events.write(an_event("over the link")); });
    auto from_c = advertise(*nodes["c"], topics::event);
    nodes["c"]->at(2s, [from_c] { from_c.write(an_event("beside it")); });
  });
  EXPECT_THAT(logs["b"], ElementsAre("2000 over the link", "2000 beside it"));
}

TEST_F(LinkGate, TheRateTakesItsTimeForEachByte) {
  link::Link link;
  link.rate_bit_s = 8000;
  fly(link, 5s, [this] {
    a().at(0ms, [this] {
      events.write(an_event(std::string(100, 'x')));
      events.write(an_event(std::string(200, 'x')));
    });
  });
  ASSERT_EQ(logs["b"].size(), 2U);
  const int first = std::stoi(logs["b"][0]), second = std::stoi(logs["b"][1]);
  EXPECT_GE(first, 100);
  EXPECT_EQ(second - first, first + 100);  // 100 bytes more
}

TEST_F(LinkGate, AStateTopicDeliversItsNewestValueWhenTheLinkReturns) {
  link::Link link;
  link.open = link::Schedule({{0s, 1s}, {3s, 100s}}, {});
  fly(link, 5s, [this] {
    a().at(500ms, [this] { observations.write(an_observation("x", 1)); });
    a().at(1s, [this] {
      observations.write(an_observation("x", 2));
      observations.write(an_observation("y", 7));
      events.write(an_event("nobody hears this"));
    });
    a().at(2s, [this] { observations.write(an_observation("x", 3)); });
  });
  EXPECT_THAT(logs["b"], ElementsAre("500 x=1", "3000 y=7", "3000 x=3"));
  EXPECT_EQ(logs["c"].size(), 5U);
}

TEST_F(LinkGate, ChanceLosesEventsAndDelaysStates) {
  link::Link link;
  link.loss = 0.3;
  fly(link, 100s, [this] {
    for (int i = 0; i < 100; ++i) {
      a().at(std::chrono::milliseconds(10 * i), [this, i] { events.write(an_event(std::to_string(i))); });
      a().at(2s, [this, i] { observations.write(an_observation("t" + std::to_string(i), i)); });
    }
  });
  const auto counts = b().link_counts().at("radio");
  EXPECT_EQ(counts.offered, 200U);
  EXPECT_GT(counts.lost, 15U);
  EXPECT_LT(counts.lost, 45U);
  EXPECT_EQ(counts.arrived, 200U - counts.lost);
  EXPECT_EQ(logs["b"].size(), counts.arrived);
  EXPECT_EQ(logs["c"].size(), 200U);
  for (int i = 0; i < 100; ++i)
    EXPECT_THAT(logs["b"], Contains(testing::EndsWith("t" + std::to_string(i) + "=" + std::to_string(i))));
}

TEST_F(LinkGate, ALinkWithoutSettingsChangesNothing) {
  fly({}, 5s, [this] {
    for (int i = 0; i < 20; ++i) {
      a().at(1s, [this, i] { observations.write(an_observation("x", i)); });
      a().at(1s, [this, i] { events.write(an_event(std::to_string(i))); });
    }
  });
  EXPECT_EQ(logs["b"], logs["c"]);
  EXPECT_EQ(logs["b"].size(), 40U);
  EXPECT_EQ(b().link_counts().at("radio").arrived, 40U);
  EXPECT_THAT(nodes["c"]->link_counts(), IsEmpty());
}

TEST_F(LinkGate, ACallOverABadLinkIsRepeatedAndItsDeadlineIsLaterByTheLightTime) {
  std::vector<std::string> results;
  int handled = 0;
  link::Link link;
  link.loss = 0.5;
  link.light_time = 2s;
  fly(link, 100s, [&] {
    serve(b(), topics::arm_motion, [&](const v1::ArmMotionRequest&, auto responder) {
      ++handled;
      v1::ArmMotionReply reply;
      responder.reply(reply);
    });
    const auto client = make_client(a(), topics::arm_motion);
    const auto note = [&](const CallResult<v1::ArmMotionReply>& result) {
      results.push_back(rpc::to_string(result.status));
    };
    for (int i = 0; i < 20; ++i) a().at(1s, [client, note] { client.call({}, "b", 60s, note); });
    a().at(80s, [this, client, &results] {
      client.call({}, "b", 1s, [this, &results](const CallResult<v1::ArmMotionReply>& result) {
        results.push_back(at(a(), to_string(result.status)));
      });
    });
  });
  ASSERT_EQ(results.size(), 21U);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(results[i], "ok");
  EXPECT_GE(std::stoi(results[20]), 84000);
  EXPECT_LE(std::stoi(results[20]), 85000);
  EXPECT_GE(handled, 20);
  EXPECT_LE(handled, 21);
  EXPECT_GT(b().link_counts().at("radio").lost, 0U);
}

TEST_F(LinkGate, WhatAConsoleSendsComesOverTheLinkOfTheGround) {
  link::Link link;
  link.light_time = 3s;
  std::vector<std::string> goals;
  run.links = between("ground", "b", link);
  Node& master = run.add("a");
  Node& receiver = run.add("b");
  run.add("c");
  subscribe(receiver, topics::goal, [&](const v1::Goal& goal) {
    goals.push_back(goal.id());
    master.stop();
  });
  node::NodeOptions console;
  console.name = "console";
  console.clock = clock::ClockMode::observer;
  Node observer(console, run.transport());
  const auto out = advertise(observer, topics::goal);
  v1::Goal goal;
  goal.id("photo");
  out.write(goal);
  run.run();
  EXPECT_THAT(goals, ElementsAre("photo"));
  EXPECT_GE(receiver.now(), 3s);
}

// What a mission begins with was given to the robot before it left.
TEST(LinkGateOfRobots, AGoalThatARobotIssuesItselfIsOnBoard) {
  link::Link uplink{"uplink", {"ground", "rover"}};
  uplink.light_time = 30s;
  const std::map<std::string, std::string> robots{{"r", "rover"}, {"world", ""}};
  SimRun run({"world", "r"});
  run.robots = robots;
  run.links = link::LinkTable({uplink}, robots, 1);
  Node& world = run.add("world");
  Node& rover = run.add("r");
  std::vector<std::string> heard;
  subscribe(rover, topics::goal, [&](const v1::Goal& goal) {
    heard.push_back(std::to_string(rover.now() / 1s) + " " + goal.id());
  });
  const auto out = advertise(world, topics::goal);
  world.at(1s, [&] {
    for (const char* issuer : {"ground", "rover", "scout"}) {
      v1::Goal goal;
      goal.issuer(issuer);
      goal.id(std::string("of ") + issuer);
      out.write(goal);
    }
  });
  world.at(60s, [&] { world.stop(); });
  run.run();
  EXPECT_THAT(heard, ElementsAre("1 of rover", "31 of ground", "31 of scout"));
}

// The world tells each robot of itself; another robot hears that over the radio alone, and it is no word of the ground.
TEST(LinkGateOfRobots, WhatTheWorldSaysOfARobotComesOverItsRadio) {
  link::Link radio{"radio", {"scout", "primary"}};
  radio.light_time = 2s;
  link::Link uplink{"uplink", {"ground", "primary"}};
  uplink.light_time = 30s;
  const std::map<std::string, std::string> robots{
      {"p", "primary"}, {"s", "scout"}, {"team", ""}, {"world", ""}};
  SimRun run({"world", "p", "s", "team"});
  run.robots = robots;
  run.links = link::LinkTable({radio, uplink}, robots, 1);
  Node& world = run.add("world");
  std::map<std::string, std::vector<std::string>> heard;
  for (const char* name : {"p", "s", "team"}) {
    Node& node = run.add(name);
    subscribe(node, topics::observation, [&node, &log = heard[name]](const v1::Observation& seen) {
      log.push_back(std::to_string(node.now() / 1s) + " " + seen.timeline());
    });
  }
  const auto out = advertise(world, topics::observation);
  world.at(1s, [&] {
    for (const char* timeline : {"primary.battery", "scout.battery", "ground.window"})
      out.write(an_observation(timeline, 1));
  });
  world.at(60s, [&] { world.stop(); });
  run.run();
  EXPECT_THAT(heard["p"], ElementsAre("1 primary.battery", "1 ground.window", "3 scout.battery"));
  EXPECT_THAT(heard["s"], ElementsAre("1 scout.battery", "1 ground.window", "3 primary.battery"));
  EXPECT_THAT(heard["team"], ElementsAre("1 primary.battery", "1 scout.battery", "1 ground.window"));
}

// Commands and requests of a robot are read by all of its services,
// and those for another one take no room on the radio.
TEST_F(LinkGate, WhatIsForAnotherServiceDoesNotPassTheLink) {
  link::Link link;
  link.loss = 1;
  int heard = 0;
  fly(link, 5s, [&] {
    subscribe(b(), topics::command, [&](const v1::Command&) { ++heard; });
    const auto commands = advertise(a(), topics::command);
    a().at(1s, [commands] {
      for (const char* owner : {"b", "c"}) {
        v1::Command command;
        command.owner(owner);
        command.commander("a");
        command.activity("to " + std::string(owner));
        commands.write(command);
      }
    });
  });
  EXPECT_EQ(heard, 1);
  const auto& lost = b().lost_samples();
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().key, "a 0 to b 0");
}

TEST_F(LinkGate, WhatIsLostIsNamed) {
  link::Link link;
  link.open = link::Schedule({}, {{1s, 3s}});
  fly(link, 5s, [this] {
    a().at(1500ms, [this] {
      observations.write(an_observation("x", 1));
      events.write(an_event("nobody hears this"));
    });
    a().at(2s, [this] { observations.write(an_observation("x", 2)); });
  });
  const std::vector<link::LostSample> expected{
      {1500ms, "radio", "roci/event", "", "a", 1, 1, 1, link::Fate::lost},
      {2s, "radio", "roci/observation", "x", "a", 1, 1, 1, link::Fate::superseded}};
  EXPECT_EQ(b().lost_samples(), expected);
  EXPECT_THAT(nodes["c"]->lost_samples(), IsEmpty());
}

// Thirty seconds of light in a tenth of a second of wall time; nobody waits longer than that.
TEST(LiveLinkGate, AppliesTheModelOnTheLiveClock) {
  link::Link link;
  link.light_time = 30s;
  node::NodeOptions options;
  options.live_scale = 300;
  options.epoch_unix_us = clock::unix_us();
  options.links = between("a", "b", link);
  const int domain = next_domain();
  options.name = "a";
  Node a(options, transport::open_transport("inproc", {.domain = domain}));
  options.name = "b";
  Node b(options, transport::open_transport("inproc", {.domain = domain}));
  std::vector<temporal::Duration> delays;
  subscribe(b, topics::observation, [&](const v1::Observation& heard) {
    delays.push_back(b.now() - temporal::Time(heard.header().stamp_us()));
  });
  const auto out = advertise(a, topics::observation);
  out.write(an_observation("x", 1));
  const auto end = clock::wall_now() + clock::wall_seconds(60);
  while (delays.empty() && clock::wall_now() < end) b.spin_once(5ms);
  ASSERT_EQ(delays.size(), 1U);
  EXPECT_GE(delays.front(), 30s);
  EXPECT_EQ(b.link_counts().at("radio").arrived, 1U);
}

}  // namespace
}  // namespace roci::services
