// What comes from the wire beyond a bound is refused, counted and told; what is within goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "services/bounds/limits.hpp"
#include "services/bounds/tally.hpp"
#include "services/clock/clock_master.hpp"
#include "services/clock/hold_back_queue.hpp"
#include "services/health/failure_detector.hpp"
#include "services/launch/progress.hpp"
#include "services/node/node_impl.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/transport/payload_limit.hpp"
#include "services/transport/scope.hpp"
#include "services/transport/type_support.hpp"
#include "services/vendors/instance_table.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;
using node::SampleRejection;
using testing::ElementsAre;
using testing::SizeIs;

TEST(Tally, IsWorthTellingEachTimeThatItHasGrownTenfold) {
  bounds::Tally tally;
  std::vector<std::uint64_t> told;
  for (int i = 0; i < 20'000; ++i)
    if (const std::uint64_t count = tally.note("roci/goal malformed")) told.push_back(count);
  EXPECT_THAT(told, ElementsAre(1, 10, 100, 1000, 10'000));
  EXPECT_EQ(tally.count("roci/goal malformed"), 20'000U);
}

TEST(Tally, ManyNamesShareOne) {
  bounds::Tally tally;
  std::size_t told = 0;
  for (int i = 0; i < 10'000; ++i) told += tally.note("name " + std::to_string(i)) != 0 ? 1 : 0;
  EXPECT_LT(told, bounds::Tally::kNames + 10);
}

// A guard that has refused what the test says.
struct ScriptedGuard : transport::RefusesDatagrams {
  std::vector<transport::RefusedDatagrams> refused_datagrams() const override { return refused; }
  std::vector<transport::RefusedDatagrams> refused{};
};

TEST(DatagramWatch, TellsEachReasonTheFirstTimeAndWheneverItHasGrownTenfold) {
  ScriptedGuard guard;
  node::DatagramWatch watch("arm_svc", &guard);
  clock::WallTime now{};
  const auto told_at = [&](std::uint64_t count) {
    guard.refused = {{"stranger", count, "10.77.0.2:7411"}, {"cut", 1, ""}};
    now += clock::wall_seconds(node::DatagramWatch::kPeriodS);
    return watch.turn(now);
  };
  EXPECT_THAT(watch.turn(now), SizeIs(0));
  const auto first = told_at(3);
  ASSERT_THAT(first, SizeIs(2));
  EXPECT_EQ(first[0].code(), "datagram.refused");
  EXPECT_EQ(first[0].properties()[1].value(), "stranger");
  EXPECT_EQ(first[0].properties()[2].value(), "3");
  EXPECT_EQ(first[0].properties()[3].value(), "10.77.0.2:7411");
  EXPECT_EQ(first[1].properties()[3].value(), "unknown");
  EXPECT_THAT(told_at(9), SizeIs(0));
  EXPECT_THAT(told_at(10), SizeIs(1));
  EXPECT_THAT(told_at(99), SizeIs(0));
  EXPECT_THAT(told_at(123'456), SizeIs(1)) << "at once, however much it has grown";
  EXPECT_THAT(told_at(200'000), SizeIs(0));
  guard.refused[0].count = 1'000'000;
  EXPECT_THAT(watch.turn(now), SizeIs(0)) << "it asks once a second";
}

// A live node that reads, and somebody who writes bytes on its topics.
class Flood : public testing::Test {
 protected:
  static node::NodeOptions options(const std::string& name) {
    node::NodeOptions options;
    options.name = name;
    options.run = "sol-12";
    options.vendor = "inproc";
    return options;
  }

  template <class T>
  transport::Writer& writer(const topics::Topic<T>& topic) {
    writers_.push_back(
        intruder_->create_writer({topic.name, transport::describe_type<T>(topic.type_name),
                                  transport::writer_qos(topic.qos, topic.clocking, clock::ClockMode::live),
                                  transport::partitions_of(topic.scope, "")},
                                 {}));
    return *writers_.back();
  }

  // What the node tells of its refusals.
  std::vector<v1::Event> told() {
    std::vector<v1::Event> events;
    node_.impl().rejected.turn(clock::wall_now());
    Node listener(options("listener"), run_.transport());
    subscribe(listener, topics::event, [&](const v1::Event& event) { events.push_back(event); });
    listener.spin_once(0ms);
    node_.impl().rejected.turn(clock::wall_now() + clock::wall_seconds(2));
    for (int i = 0; i < 100 && events.empty(); ++i) listener.spin_once(20ms);
    return events;
  }

  static v1::Heartbeat beat(const std::string& service) {
    v1::Heartbeat beat;
    beat.run("sol-12");
    beat.service(service);
    beat.incarnation(1);
    return beat;
  }

  template <class Done>
  void spin_until(Node& node, Done done) {
    for (int i = 0; i < 500 && !done(); ++i) node.spin_once(10ms);
    EXPECT_TRUE(done());
  }

  SimRun run_{{"nobody"}};
  Node node_{options("arm_svc"), run_.transport()};
  std::unique_ptr<transport::Transport> intruder_ = run_.transport();
  std::vector<std::unique_ptr<transport::Writer>> writers_;
};

TEST_F(Flood, ASampleThatIsNoneIsToldByOneEventHoweverManyCome) {
  int heard = 0;
  subscribe(node_, topics::event, [&](const v1::Event& event) { heard += event.code() == "good" ? 1 : 0; });
  v1::Event event;
  event.header().run("sol-12");
  event.code("good");
  transport::Writer& events_of_intruder = writer(topics::event);
  events_of_intruder.write(transport::serialize(event));
  spin_until(node_, [&] { return heard == 1; });
  event.severity_level(static_cast<v1::Severity>(77));
  for (int i = 0; i < 9; ++i) events_of_intruder.write(transport::serialize(event));
  spin_until(node_, [&] {
    return node_.impl().rejected.count(topics::event.name, SampleRejection::malformed) == 9;
  });
  EXPECT_EQ(heard, 1);
  const auto events = told();
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events[0].code(), "sample.refused");
  EXPECT_EQ(events[0].properties()[1].value(), topics::event.name);
  EXPECT_EQ(events[0].properties()[2].value(), "malformed");
}

TEST_F(Flood, ALargerSampleThanItsTopicAllowsIsRefusedOnBothSides) {
  subscribe(node_, topics::heartbeat, [](const v1::Heartbeat&) {});
  const std::size_t limit = transport::bytes(topics::heartbeat.limit);
  const v1::Heartbeat large = beat(std::string(limit, 'x'));
  EXPECT_FALSE(advertise(node_, topics::heartbeat).write(large));
  writer(topics::heartbeat).write(transport::serialize(large));
  spin_until(node_, [&] {
    return node_.impl().rejected.count(topics::heartbeat.name, SampleRejection::too_large) == 1;
  });
}

TEST_F(Flood, TheInboxHasABoundForEachTopic) {
  int heartbeats = 0, goals = 0;
  subscribe(node_, topics::time_probe, [&](const v1::TimeProbe&) { ++heartbeats; });
  subscribe(node_, topics::goal, [&](const v1::Goal&) { ++goals; });
  transport::Writer& flood = writer(topics::time_probe);
  v1::TimeProbe probe;
  probe.run("sol-12");
  const transport::Payload payload = transport::serialize(probe);
  // Past the vendor's own queue: what its thread hands to the node.
  node::TopicReader& reader = *node_.impl().endpoints.find_in(topics::time_probe.name);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < bounds::kInboxSamples + 10; ++i)
    taken += node_.impl().inbox.push({&reader, {transport::SampleKind::data, payload, flood.guid()}},
                                     bounds::kInboxBytes)
                 ? 1
                 : 0;
  EXPECT_EQ(taken, bounds::kInboxSamples);
  v1::Goal goal;
  goal.header().run("sol-12");
  writer(topics::goal).write(transport::serialize(goal));
  spin_until(node_, [&] { return goals == 1; });
  EXPECT_EQ(heartbeats, static_cast<int>(bounds::kInboxSamples));
  EXPECT_TRUE(node_.impl().inbox.push({&reader, {transport::SampleKind::data, payload, flood.guid()}},
                                      bounds::kInboxBytes))
      << "room again";
  EXPECT_FALSE(node_.impl().inbox.push({&reader, {transport::SampleKind::data, payload, flood.guid()}},
                                       payload.size()))
      << "bytes count, too";
}

TEST_F(Flood, ServicesBeyondTheBoundAreNotKnown) {
  node_.spin_once(0ms);
  transport::Writer& beats = writer(topics::heartbeat);
  for (std::size_t i = 0; i < bounds::kPeers + 20; ++i)
    beats.write(transport::serialize(beat("service-" + std::to_string(i))));
  spin_until(node_, [&] {
    return node_.impl().rejected.count(topics::heartbeat.name, SampleRejection::no_room) >= 20;
  });
  EXPECT_TRUE(node_.peer_alive("service-7"));
}

TEST_F(Flood, RequestsThatNobodyAnswersAreRefusedBeyondTheBound) {
  std::vector<Responder<v1::PathReply>> open;
  serve(node_, topics::path_request,
        [&](const v1::PathRequest&, Responder<v1::PathReply> responder) { open.push_back(responder); });
  Node client_node(options("sim_svc"), run_.transport());
  const auto client = make_client(client_node, topics::path_request);
  std::vector<rpc::CallStatus> ends;
  std::string reason;
  for (std::size_t i = 0; i < bounds::kOpenRequests + 5; ++i)
    client.call({}, "", 100s, [&](const CallResult<v1::PathReply>& result) {
      ends.push_back(result.status);
      reason = result.reason;
    });
  for (int i = 0; i < 500 && ends.size() < 5; ++i) {
    client_node.spin_once(5ms);
    node_.spin_once(5ms);
  }
  EXPECT_EQ(open.size(), bounds::kOpenRequests);
  EXPECT_THAT(ends, ElementsAre(rpc::CallStatus::remote_error, rpc::CallStatus::remote_error,
                                rpc::CallStatus::remote_error, rpc::CallStatus::remote_error,
                                rpc::CallStatus::remote_error));
  EXPECT_THAT(reason, testing::HasSubstr("not answered yet"));
}

TEST_F(Flood, TheLaunchersLineShowsABoundedNumberOfExecutives) {
  testing::internal::CaptureStderr();
  node::NodeOptions observing = options("launcher");
  observing.clock = clock::ClockMode::observer;
  Node observer(observing, run_.transport());
  launch::Progress progress(observer, true);
  int heard = 0;
  subscribe(observer, topics::mission_status, [&](const v1::MissionStatus&) { ++heard; });
  transport::Writer& statuses = writer(topics::mission_status);
  constexpr int kSent = 300;
  for (int i = 0; i < kSent; ++i) {
    v1::MissionStatus status;
    status.header().run("sol-12");
    status.executive("exec-" + std::to_string(i));
    statuses.write(transport::serialize(status));
  }
  spin_until(observer, [&] { return heard == kSent; });
  progress.show();
  const std::string line = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(line, '/'), 2 * 255) << "between 256 phases, and as many plans";
}

TEST(HoldBackQueueBounds, StreamsAndTheirSamplesAreBounded) {
  clock::HoldBackQueue queue;
  queue.subscribe("roci/goal", clock::Durability::volatile_, {});
  v1::SampleHeader header;
  header.sender("a");
  header.incarnation(1);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < bounds::kHeldBackSamples + 10; ++i) {
    header.seq(i + 1);
    taken += queue.add("roci/goal", header, nullptr) ? 1 : 0;
  }
  EXPECT_EQ(taken, bounds::kHeldBackSamples);
  taken = 0;
  header.seq(1);
  for (std::uint32_t i = 0; i < bounds::kHeldBackStreams + 10; ++i) {
    header.incarnation(i + 2);
    taken += queue.add("roci/goal", header, nullptr) ? 1 : 0;
  }
  EXPECT_EQ(taken, bounds::kHeldBackStreams - 1);
}

TEST(ClockMasterBounds, ServicesAreBounded) {
  clock::ClockMaster master("sim_svc", {"sim_svc"});
  v1::ClockReady ready;
  ready.incarnation(1);
  std::size_t admitted = 0;
  for (std::size_t i = 0; i < bounds::kPeers + 10; ++i) {
    ready.service(i == 0 ? "sim_svc" : "service-" + std::to_string(i));
    admitted += master.ready(ready) ? 1 : 0;
  }
  EXPECT_EQ(admitted, bounds::kPeers);
}

TEST(ClockMasterBounds, StreamsAreBounded) {
  clock::ClockMaster master("sim_svc", {"sim_svc"});
  v1::ClockReady ready;
  ready.service("sim_svc");
  ready.incarnation(1);
  EXPECT_TRUE(master.ready(ready));
  master.issue(temporal::Time(0));
  v1::ClockDone done;
  done.service("sim_svc");
  done.incarnation(1);
  v1::StreamCount count;
  count.total(1);
  for (std::size_t i = 0; i < bounds::kCountedStreams; ++i) {
    count.topic("t" + std::to_string(i));
    done.sent().push_back(count);
  }
  EXPECT_TRUE(master.done(done));
  count.topic("one more");
  done.sent({count});
  EXPECT_FALSE(master.done(done));
}

TEST(ClockMasterBounds, DeathsAreBounded) {
  clock::ClockMaster master("sim_svc", {"sim_svc"});
  v1::ClockReady ready;
  ready.service("sim_svc");
  ready.incarnation(1);
  EXPECT_TRUE(master.ready(ready));
  ready.service("service-1");
  EXPECT_TRUE(master.ready(ready));
  master.issue(temporal::Time(0));
  std::size_t deaths = 0;
  for (ready.incarnation(2); master.ready(ready) && deaths < 2 * bounds::kRosterLosses; ++deaths) {
    master.issue(temporal::Time(0));
    ready.incarnation(ready.incarnation() + 1);
  }
  EXPECT_EQ(deaths, bounds::kRosterLosses);
}

TEST(InstanceTableBounds, InstancesAndTheirWritersAreBounded) {
  vendors::InstanceTable table;
  const transport::Guid writer{1};
  for (std::size_t i = 0; i < vendors::InstanceTable::kInstances + 10; ++i) {
    const std::string key = std::to_string(i);
    if (!table.wrote(key, writer)) table.introduce(key, writer, {0});
  }
  EXPECT_THAT(table.writer_left(writer), SizeIs(vendors::InstanceTable::kInstances));
}

}  // namespace
}  // namespace roci::services
