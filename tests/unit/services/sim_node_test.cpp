// Nodes under the simulated clock, all on their own threads: what the pure parts (clock_master_test,
// hold_back_queue_test) promise, joined up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "services/publisher.hpp"
#include "services/transport/qos.hpp"
#include "services/transport/scope.hpp"
#include "services/transport/type_support.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

v1::Event event(const std::string& text) {
  v1::Event e;
  e.text(text);
  return e;
}

v1::Observation observation(const std::string& timeline, double number) {
  v1::Observation o;
  o.timeline(timeline);
  o.observed().number(number);
  return o;
}

std::string at(const Node& node, const std::string& what) {
  return std::to_string(node.now() / 1ms) + " " + what;
}

// What a service sees of events and of its peers, with the mission time in milliseconds.
std::shared_ptr<std::vector<std::string>> record(Node& node) {
  auto log = std::make_shared<std::vector<std::string>>();
  subscribe(node, topics::event, [&node, log](const v1::Event& e) { log->push_back(at(node, e.text())); });
  node.on_peer_change([&node, log](const health::PeerChange& change) {
    log->push_back(at(node, change.service + "#" + std::to_string(change.incarnation) +
                                (change.alive ? " alive" : " dead: " + change.cause)));
  });
  return log;
}

TEST(SimNode, PeersAreKnownBeforeAnythingElse) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& b = run.add("b");
  const auto seen = record(b);
  advertise(a, topics::event).write(event("from the constructor"));
  a.at(10ms, [&a] { a.stop(); });
  run.run();
  EXPECT_THAT(*seen, ElementsAre("0 a#1 alive", "0 from the constructor"));
}

TEST(SimNode, TimersFireInOrderOfTimeThenCreation) {
  SimRun run({"a"});
  Node& a = run.add("a");
  std::vector<std::string> fired;
  const auto note = [&](const char* what) { return [&fired, &a, what] { fired.push_back(at(a, what)); }; };
  a.at(20ms, note("second"));
  a.at(20ms, note("third"));
  a.at(10ms, note("first"));
  const auto never = a.at(15ms, note("never"));
  a.at(10ms, [&] {
    a.cancel(never);
    a.at(5ms, note("overdue"));
    a.at(20ms, note("fourth"));
  });
  a.at(30ms, [&a] { a.stop(); });
  run.run();
  EXPECT_THAT(fired, ElementsAre("10 first", "10 overdue", "20 second", "20 third", "20 fourth"));
}

TEST(SimNode, AWorkersResultHasItsPlaceInMissionTime) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& b = run.add("b");
  const auto seen = record(b);
  const auto events = advertise(a, topics::event);
  std::promise<void> second_done;
  std::thread first;
  std::thread second;
  a.at(10ms, [&] {
    const auto one = a.begin_work();
    const auto two = a.begin_work();
    second = std::thread([&a, &events, &second_done, two] {
      a.post_work_result(two, [&events] { events.write(event("second work")); });
      second_done.set_value();
    });
    first = std::thread([&a, &events, &second_done, one] {
      second_done.get_future().wait();  // the later work ends first
      a.post_work_result(one, [&events] { events.write(event("first work")); });
    });
  });
  a.at(11ms, [&] { events.write(event("later")); });
  a.at(20ms, [&a] { a.stop(); });
  run.run();
  first.join();
  second.join();
  EXPECT_THAT(*seen, ElementsAre("0 a#1 alive", "10 first work", "10 second work", "11 later"));
}

TEST(SimNode, ADeathInTheMiddleOfAMicroStepIsSeenByAllAtOnePlace) {
  SimRun run({"a", "b", "c"});
  Node& a = run.add("a");
  Node& b = run.add("b");
  const auto seen_by_a = record(a);
  const auto seen_by_c = record(run.add("c"));
  b.at(10ms, [&b] {
    advertise(b, topics::event).write(event("unfinished"));
    throw Crash{};
  });
  a.at(10ms, [&a] { advertise(a, topics::event).write(event("finished")); });
  a.at(20ms, [&a] { a.stop(); });
  run.run();
  EXPECT_THAT(*seen_by_c, ElementsAre("0 a#1 alive", "0 b#1 alive", "10 b#1 dead: killed", "10 finished"));
  EXPECT_THAT(*seen_by_a, ElementsAre("0 b#1 alive", "0 c#1 alive", "10 b#1 dead: killed", "10 finished"));
  EXPECT_FALSE(run.node("c").peer_alive("b"));
}

TEST(SimNode, ARestartedServiceGetsTheNewestStateAndNoOldRequest) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& first = run.add("b");
  const auto seen_by_a = record(a);
  const auto observations = advertise(a, topics::observation);
  const auto commands = advertise(a, topics::command);
  a.at(5ms, [&] {
    observations.write(observation("x", 1));
    observations.write(observation("y", 2));
    observations.write(observation("x", 3));
    commands.write({});
    first.stop();
  });
  std::vector<std::string> seen_by_b;
  a.on_peer_change([&](const health::PeerChange& change) {
    if (change.alive && change.incarnation == 2) a.after(1ms, [&a] { a.stop(); });
    if (change.alive) return;
    Node& second = run.add("b", 2);
    subscribe(second, topics::observation, [&](const v1::Observation& o) {
      seen_by_b.push_back(o.timeline() + " " + std::to_string(static_cast<int>(o.observed().number())));
    });
    subscribe(second, topics::command,
              [&](const v1::Command&) { seen_by_b.emplace_back("a command of the past"); });
    run.start();
  });
  run.run();
  EXPECT_THAT(seen_by_b, ElementsAre("y 2", "x 3"));
  EXPECT_THAT(*seen_by_a, ElementsAre("0 b#1 alive", "5 b#1 dead: left", "5 b#2 alive"));
}

TEST(SimNode, TimeWaitsForAKilledServiceToReturn) {
  SimRun run({"a", "b"});
  run.master.restart_hold_s = 1000;
  Node& a = run.add("a");
  Node& b = run.add("b");
  const auto seen = record(a);
  b.at(10ms, [] { throw Crash{}; });
  a.at(10ms, [] {});
  a.at(500ms, [&a] { a.stop(); });
  run.start();
  run.wait_for_crash("b");
  run.add("b", 2);
  run.run();
  // The master may hear the successor before the end of the dead one.
  EXPECT_THAT(*seen, ElementsAre("0 b#1 alive", AnyOf("10 b#1 dead: killed", "10 b#1 dead: restarted"),
                                 "10 b#2 alive"));
}

TEST(SimNode, InputOfObserversWakesAnIdleReceiver) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& b = run.add("b");
  std::vector<std::string> goals;
  subscribe(b, topics::goal, [&](const v1::Goal& goal) {
    goals.push_back(at(b, goal.id()));
    advertise(b, topics::event).write(event("goal taken"));
  });
  subscribe(a, topics::event, [&](const v1::Event&) { a.stop(); });

  node::NodeOptions options;
  options.name = "console";
  options.clock = clock::ClockMode::observer;
  Node console(options, run.transport());
  std::vector<std::string> answers;
  subscribe(console, topics::event, [&](const v1::Event& e) { answers.push_back(e.text()); });
  // Only once the run stands still, with no wish of anybody, does the goal come in.
  bool standing = false;
  subscribe(console, topics::clock_step, [&](const v1::ClockStep&) { standing = true; });
  run.start();
  while (!standing) console.spin_once(10ms);
  v1::Goal goal;
  goal.issuer("ground");
  goal.id("photo");
  advertise(console, topics::goal).write(goal);
  while (answers.empty()) console.spin_once(10ms);
  run.join();
  EXPECT_THAT(goals, ElementsAre("0 photo"));
  EXPECT_THAT(answers, ElementsAre("goal taken"));
}

TEST(SimNode, ALivelockEndsTheRunWithAnError) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& b = run.add("b");
  const auto echo = [](Node& node) {
    subscribe(node, topics::event,
              [events = advertise(node, topics::event)](const v1::Event& e) { events.write(e); });
  };
  subscribe(b, topics::observation,
            [&b](const v1::Observation&) { advertise(b, topics::event).write(event("ping")); });
  echo(a);
  advertise(a, topics::observation).write(observation("x", 1));
  try {
    run.run();
    FAIL() << "the run ended without an error";
  } catch (const clock::ClockError& error) {
    EXPECT_THAT(error.what(), HasSubstr("livelock"));
  }
}

TEST(SimNode, TooManySamplesOfOneInstanceAreRefused) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  const auto events = advertise(a, topics::event);
  const auto observations = advertise(a, topics::observation);
  std::vector<std::string> seen;
  subscribe(run.add("b"), topics::event, [&](const v1::Event& e) { seen.push_back(e.text()); });
  a.at(1ms, [&] {
    for (int i = 0; i < transport::kMicroStepLimit; ++i) {
      EXPECT_TRUE(events.write(event(std::to_string(i))));
      EXPECT_TRUE(observations.write(observation("t" + std::to_string(i), i)))
          << "each is an instance of its own";
    }
    EXPECT_FALSE(events.write(event("too many")));
  });
  a.at(2ms, [&] { EXPECT_TRUE(events.write(event("next micro-step"))); });
  a.at(3ms, [&a] { a.stop(); });
  run.run();
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(transport::kMicroStepLimit) + 1);
  EXPECT_EQ(seen.back(), "next micro-step");
}

TEST(SimNode, AFloodOfItsOwnSamplesIsALogLineForEachTenfoldCount) {
  SimRun run({"a"});
  Node& a = run.add("a");
  const auto events = advertise(a, topics::event);
  constexpr int kRefused = 150;
  a.at(1ms, [&] {
    for (int i = 0; i < transport::kMicroStepLimit + kRefused; ++i) events.write(event("again"));
  });
  a.at(2ms, [&a] { a.stop(); });
  testing::internal::CaptureStderr();
  run.run();
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, AllOf(HasSubstr("(1 so far)"), HasSubstr("(10 so far)"), HasSubstr("(100 so far)")));
  EXPECT_EQ(std::ranges::count(log, '\n'), 3) << log;
}

v1::CommandAck last_word(int number) {
  v1::CommandAck ack;
  ack.activity("a" + std::to_string(number));
  ack.stage(v1::STAGE_COMPLETED);
  return ack;
}

// A writer that runs for a month keeps the newest of what is finished, and nothing of what nobody asks for again; and
// who joins then still gets the newest sample, for which the clock makes it wait.
TEST(SimNode, WhatIsFinishedIsKeptForTheNewestAlone) {
  constexpr int kFinished = 200;
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  Node& first = run.add("b");
  subscribe(first, topics::command_ack, [](const v1::CommandAck&) {});
  subscribe(first, topics::command, [](const v1::Command&) {});
  const auto acks = advertise(a, topics::command_ack);
  const auto commands = advertise(a, topics::command);
  for (int i = 1; i <= kFinished; ++i) {
    a.at(i * 1ms, [&, i] {
      acks.write(last_word(i));
      acks.dispose(last_word(i));
      v1::Command command;
      command.activity("a" + std::to_string(i));
      commands.write(command);
    });
  }
  a.at(1000ms, [&] { first.stop(); });
  std::vector<std::string> of_the_past;
  std::atomic<int> commands_kept = 0;
  std::unique_ptr<transport::Transport> outside;
  std::unique_ptr<transport::Reader> looks;
  bool restarted = false;
  int turns = 0;  // of at most a quarter of a second
  a.on_turn([&] {
    if (restarted && (commands_kept > 0 || ++turns > 40)) a.stop();
  });
  a.on_peer_change([&](const health::PeerChange& change) {
    restarted = restarted || (change.alive && change.incarnation == 2);
    if (change.alive) return;
    Node& second = run.add("b", 2);
    subscribe(second, topics::command_ack,
              [&](const v1::CommandAck& ack) { of_the_past.push_back(ack.activity()); });
    run.start();
    outside = run.transport();
    looks = outside->create_reader(
        {topics::command.name, transport::describe_type<v1::Command>(topics::command.type_name),
         transport::reader_qos(transport::Qos::request, transport::Clocking::clocked,
                               clock::ClockMode::simulated),
         transport::partitions_of(topics::command.scope, "")},
        {[&](transport::Sample&& sample) { commands_kept += sample.kind == transport::SampleKind::data; },
         {}});
  });
  run.run();
  looks.reset();
  ASSERT_FALSE(of_the_past.empty());
  EXPECT_LE(of_the_past.size(), 70U) << "of " << kFinished;
  EXPECT_EQ(of_the_past.back(), "a" + std::to_string(kFinished));
  EXPECT_LE(commands_kept, 3) << "of " << kFinished << ": a request is over when it was heard";
  EXPECT_GT(commands_kept, 0);
}

TEST(SimNode, LateSubscriptionsAreRefused) {
  SimRun run({"a"});
  Node& a = run.add("a");
  a.at(1ms, [&a] {
    EXPECT_THROW(subscribe(a, topics::goal, [](const v1::Goal&) {}), std::logic_error);
    a.stop();
  });
  run.run();
}

TEST(SimNode, AnExceptionOfTheMasterEndsTheOthersToo) {
  SimRun run({"a", "b"});
  Node& a = run.add("a");
  run.add("b");
  a.at(1ms, [] { throw Crash{}; });
  EXPECT_THROW(run.run(), clock::ClockGone);
}

}  // namespace
}  // namespace roci::services
