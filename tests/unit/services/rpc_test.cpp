#include "services/rpc.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/publisher.hpp"
#include "services/rpc/reply_cache.hpp"
#include "tests/unit/services/faulty_transport.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

using Result = CallResult<v1::ArmMotionReply>;

v1::ArmMotionRequest to_pose(const std::string& pose) {
  v1::ArmMotionRequest request;
  request.to_pose(pose);
  return request;
}

v1::ArmMotionReply because(const std::string& reason) {
  v1::ArmMotionReply reply;
  reply.reason(reason);
  return reply;
}

// caller is the clock's master; owner serves; both under the simulated clock.
class SimCall : public testing::Test {
 protected:
  void call(const std::string& target, temporal::Duration deadline, const std::string& pose = "stow") {
    newest = client.call(to_pose(pose), target, deadline, [this](const Result& result) {
      const auto ms = std::to_string(caller.now() / 1ms);
      results.push_back(ms + " " + to_string(result.status) + " " + result.reply.reason());
      message = result.reason;
    });
  }
  void run_until(temporal::Time end) {
    caller.at(end, [this] { caller.stop(); });
    run.run();
  }

  SimRun run{{"caller", "owner"}};
  Node& caller = run.add("caller");
  Node& owner = run.add("owner");
  Client<v1::ArmMotionRequest, v1::ArmMotionReply> client = make_client(caller, topics::arm_motion);
  rpc::CallId newest = 0;
  std::vector<std::string> results;
  std::string message;
};

TEST_F(SimCall, IsAnsweredAtOnce) {
  serve(owner, topics::arm_motion, [](const v1::ArmMotionRequest& request, auto responder) {
    responder.reply(because("to " + request.to_pose()));
  });
  caller.at(5ms, [this] { call("owner", 1s); });
  run_until(10ms);
  EXPECT_THAT(results, ElementsAre("5 ok to stow"));
}

TEST_F(SimCall, IsAnsweredLaterOnce) {
  serve(owner, topics::arm_motion, [this](const v1::ArmMotionRequest&, auto responder) {
    owner.after(30ms, [responder] {
      responder.reply(because("first"));
      responder.reply(because("second"));
      responder.fail(v1::REMOTE_EX_UNSUPPORTED, "third");
    });
  });
  caller.at(5ms, [this] { call("", 1s); });
  run_until(50ms);
  EXPECT_THAT(results, ElementsAre("35 ok first"));
}

TEST_F(SimCall, TimesOutAtItsDeadlineAndDropsTheLateReply) {
  serve(owner, topics::arm_motion, [this](const v1::ArmMotionRequest&, auto responder) {
    owner.after(30ms, [responder] { responder.reply(because("late")); });
  });
  caller.at(5ms, [this] { call("owner", 20ms); });
  run_until(50ms);
  EXPECT_THAT(results, ElementsAre("25 timeout "));
  EXPECT_EQ(client.statistics().late, 1U);
}

TEST_F(SimCall, KnowsThatTheOwnerIsNotThere) {
  call("stranger", 1s);  // before the run: the first roster tells
  caller.at(5ms, [this] { call("stranger", 1s); });
  run_until(10ms);
  EXPECT_THAT(results, ElementsAre("0 no_owner ", "5 no_owner "));
  EXPECT_THAT(message, HasSubstr("stranger is not there to answer roci/arm/request"));
}

TEST_F(SimCall, EndsWithTheOwner) {
  serve(owner, topics::arm_motion,
        [this](const v1::ArmMotionRequest&, auto) { owner.after(1ms, [] { throw Crash{}; }); });
  caller.at(5ms, [this] {
    call("owner", 1s);
    call("", 100ms, "anybody's");
  });
  run_until(200ms);
  EXPECT_THAT(results, ElementsAre("6 owner_lost ", "105 timeout "));
}

TEST_F(SimCall, BringsTheRemoteError) {
  serve(owner, topics::arm_motion, [](const v1::ArmMotionRequest&, auto responder) {
    responder.fail(v1::REMOTE_EX_INVALID_ARGUMENT, "no such pose");
  });
  caller.at(5ms, [this] { call("owner", 1s); });
  run_until(10ms);
  EXPECT_THAT(results, ElementsAre("5 remote_error "));
  EXPECT_EQ(message, "no such pose");
}

// The topic of the answers holds sixteen in a micro-step (transport/micro_step.hpp).
TEST_F(SimCall, ManyAtOnceAreAllAnswered) {
  constexpr int kCalls = 60;
  serve(owner, topics::arm_motion, [](const v1::ArmMotionRequest& request, auto responder) {
    responder.reply(because(request.to_pose()));
  });
  caller.at(5ms, [this] {
    for (int i = 0; i < kCalls; ++i) call("owner", 1s, std::to_string(i));
  });
  run_until(2s);
  ASSERT_EQ(results.size(), static_cast<std::size_t>(kCalls));
  for (int i = 0; i < kCalls; ++i)
    EXPECT_EQ(results[static_cast<std::size_t>(i)], "5 ok " + std::to_string(i));
}

TEST_F(SimCall, RefusesMoreThanTheTableHolds) {
  caller.at(5ms, [this] {
    for (std::size_t i = 0; i <= rpc::kMaxPendingCalls; ++i) call("owner", 20ms, std::to_string(i));
    EXPECT_TRUE(results.empty()) << "never inside call()";
  });
  run_until(50ms);
  ASSERT_EQ(results.size(), rpc::kMaxPendingCalls + 1);
  EXPECT_EQ(results.front(), "5 overloaded ");
  EXPECT_EQ(results.back(), "25 timeout ");
}

TEST_F(SimCall, ThatIsCancelledEndsWithWhatItsServerAnswersThen) {
  serve(owner, topics::arm_motion, [this](const v1::ArmMotionRequest&, auto responder) {
    const auto work = owner.after(1s, [responder] { responder.reply(because("done")); });
    responder.on_cancel([this, work, responder] {
      owner.cancel(work);
      responder.reply(because("given up"));
    });
  });
  caller.at(5ms, [this] { call("owner", 10s); });
  caller.at(30ms, [this] { client.cancel(newest); });
  caller.at(40ms, [this] { client.cancel(newest); });
  caller.at(50ms, [this] { call("owner", 10s); });
  run_until(2s);
  EXPECT_THAT(results, ElementsAre("30 ok given up", "1050 ok done"));
}

TEST_F(SimCall, ThatIsCancelledInTheTurnInWhichItIsMadeEndsEarly) {
  serve(owner, topics::arm_motion, [](const v1::ArmMotionRequest&, auto responder) {
    responder.on_cancel([responder] { responder.reply(because("given up")); });
  });
  caller.at(5ms, [this] {
    call("owner", 10s);
    client.cancel(newest);
  });
  run_until(20ms);
  EXPECT_THAT(results, ElementsAre("5 ok given up"));
}

TEST_F(SimCall, ThatIsCancelledIsAnsweredByAServerThatKnowsNoCancel) {
  serve(owner, topics::arm_motion, [this](const v1::ArmMotionRequest&, auto responder) {
    owner.after(30ms, [responder] { responder.reply(because("done")); });
  });
  caller.at(5ms, [this] { call("owner", 10s); });
  caller.at(10ms, [this] { client.cancel(newest); });
  run_until(50ms);
  EXPECT_THAT(results, ElementsAre("35 ok done"));
}

TEST_F(SimCall, DropsRepliesToOthers) {
  const auto other = make_client(owner, topics::arm_motion);
  serve(caller, topics::arm_motion,
        [](const v1::ArmMotionRequest&, auto responder) { responder.reply(because("from the caller")); });
  serve(owner, topics::arm_motion,
        [](const v1::ArmMotionRequest&, auto responder) { responder.reply(because("from the owner")); });
  std::vector<std::string> others;
  owner.at(5ms, [&] {
    other.call(to_pose("a"), "caller", 1s,
               [&](const Result& result) { others.push_back(result.reply.reason()); });
  });
  caller.at(5ms, [this] { call("owner", 1s); });
  run_until(10ms);
  EXPECT_THAT(results, ElementsAre("5 ok from the owner"));
  EXPECT_THAT(others, ElementsAre("from the caller")) << "each request names its owner";
  EXPECT_EQ(client.statistics().foreign, 1U);
  EXPECT_EQ(other.statistics().foreign, 1U);
}

TEST(ReplyCache, RepeatsTheFirstAnswerToADuplicate) {
  rpc::ReplyCache server;
  const rpc::ReplyCache::Id id{{1}, 7};
  int sent = 0;
  EXPECT_TRUE(server.accept(id));
  EXPECT_FALSE(server.accept(id)) << "still being answered";
  server.answered(id, [&sent] { ++sent; });
  EXPECT_EQ(sent, 0);
  EXPECT_FALSE(server.accept(id));
  EXPECT_EQ(sent, 1);
  EXPECT_TRUE(server.accept({{2}, 7})) << "another client";
}

TEST(ReplyCache, RemembersABoundedNumber) {
  rpc::ReplyCache server;
  for (std::int64_t i = 0; i <= static_cast<std::int64_t>(rpc::kCachedReplies); ++i)
    EXPECT_TRUE(server.accept({{1}, i}));
  EXPECT_FALSE(server.accept({{1}, 1}));
  EXPECT_TRUE(server.accept({{1}, 0})) << "the oldest is forgotten";
}

TEST(ReplyCache, TellsOfACancelOnceWhetherItCameBeforeTheRequestOrAfter) {
  rpc::ReplyCache server;
  int told = 0;
  const auto count = [&told] { ++told; };
  const rpc::ReplyCache::Id late{{1}, 1}, early{{1}, 2}, answered{{1}, 3};
  server.accept(late);
  server.on_cancel(late, count);
  EXPECT_EQ(told, 0);
  server.cancel(late);
  server.cancel(late);
  EXPECT_EQ(told, 1);
  server.cancel(early);
  EXPECT_TRUE(server.accept(early)) << "it is to be answered all the same";
  server.on_cancel(early, count);
  EXPECT_EQ(told, 2);
  server.accept(answered);
  server.on_cancel(answered, count);
  server.answered(answered, [] {});
  server.cancel(answered);
  EXPECT_EQ(told, 2);
}

// Live nodes turned by the test itself; mission time runs 100 times as fast as the wall.
class LiveCall : public testing::Test {
 protected:
  std::unique_ptr<Node> make(const std::string& name, Deliveries deliveries = nullptr) {
    node::NodeOptions options;
    options.name = name;
    options.live_scale = 100;
    transport::TransportOptions transport;
    transport.domain = domain_;
    auto network = transport::open_transport("inproc", transport);
    if (deliveries) network = std::make_unique<FaultyTransport>(std::move(network), std::move(deliveries));
    return std::make_unique<Node>(options, std::move(network));
  }
  // Serves the call, and counts what it handles.
  void serve_and_count() {
    serve(*owner, topics::arm_motion, [this](const v1::ArmMotionRequest&, auto responder) {
      ++handled;
      responder.reply(because("done"));
    });
  }
  void turn_until(const std::function<bool()>& done) {
    while (!done()) {
      for (const auto& node : {caller.get(), owner.get()}) {
        if (node != nullptr) node->spin_once(1ms);
      }
    }
  }
  void call(const std::string& target, temporal::Duration deadline) {
    make_client(*caller, topics::arm_motion)
        .call(to_pose("stow"), target, deadline, [this](const Result& result) {
          results.emplace_back(to_string(result.status));
          message = result.reason;
        });
  }

  int domain_ = next_domain();
  std::unique_ptr<Node> caller = make("caller");
  std::unique_ptr<Node> owner;
  std::vector<std::string> results;
  std::string message;
  int handled = 0;
};

// Drops the first `lost` samples of the topic.
Deliveries losing(const std::string& topic, int lost) {
  return [topic, lost](const std::string& on, int number) { return on == topic && number <= lost ? 0 : 1; };
}

// Each sample of the topic comes three times.
Deliveries thrice(const std::string& topic) {
  return [topic](const std::string& on, int) { return on == topic ? 3 : 1; };
}

TEST_F(LiveCall, WhoseFirstRepliesAreLostIsAskedAgainAndHandledOnce) {
  caller = make("caller", losing(topics::arm_motion.reply.name, 2));
  owner = make("owner");
  serve_and_count();
  const auto client = make_client(*caller, topics::arm_motion);
  call("owner", 10'000s);
  turn_until([this] { return !results.empty(); });
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
  EXPECT_GE(client.statistics().sent, 3U) << "the request and two repetitions, each of which brought a reply";
}

TEST_F(LiveCall, WhoseReplyComesThriceEndsOnce) {
  caller = make("caller", thrice(topics::arm_motion.reply.name));
  owner = make("owner");
  serve_and_count();
  const auto client = make_client(*caller, topics::arm_motion);
  call("owner", 10'000s);
  turn_until([&] { return client.statistics().late >= 2; });  // a slow machine asks again meanwhile
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
}

TEST_F(LiveCall, WhoseFirstRequestsAreLostIsSentAgain) {
  owner = make("owner", losing(topics::arm_motion.request.name, 2));
  serve_and_count();
  const auto client = make_client(*caller, topics::arm_motion);
  call("owner", 10'000s);
  turn_until([this] { return !results.empty(); });
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
  EXPECT_GE(client.statistics().sent, 3U);
}

TEST_F(LiveCall, WhoseRequestComesThriceIsHandledOnce) {
  owner = make("owner", thrice(topics::arm_motion.request.name));
  serve_and_count();
  const auto client = make_client(*caller, topics::arm_motion);
  call("owner", 10'000s);
  turn_until([&] { return client.statistics().late >= 2; });  // its answer goes out with each of them
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
}

TEST_F(LiveCall, WaitsForAServerThatStartsLater) {
  call("owner", 1000s);
  for (int i = 0; i < 3; ++i) caller->spin_once(0ms);
  owner = make("owner");
  serve(*owner, topics::arm_motion,
        [](const v1::ArmMotionRequest&, auto responder) { responder.reply(because("here")); });
  turn_until([this] { return !results.empty(); });
  EXPECT_THAT(results, ElementsAre("ok"));
}

TEST_F(LiveCall, ThatNobodyHasHeardOfEndsAtItsCancel) {
  const auto client = make_client(*caller, topics::arm_motion);
  client.cancel(client.call(to_pose("stow"), "owner", 100'000s, [this](const Result& result) {
    results.emplace_back(to_string(result.status));
  }));
  EXPECT_TRUE(results.empty()) << "never inside cancel()";
  turn_until([this] { return !results.empty(); });
  EXPECT_THAT(results, ElementsAre("cancelled"));
  EXPECT_EQ(client.statistics().sent, 0U);
}

TEST_F(LiveCall, HandlesARepeatedRequestOnce) {
  owner = make("owner");
  std::vector<Responder<v1::ArmMotionReply>> waiting;
  serve(*owner, topics::arm_motion, [&](const v1::ArmMotionRequest&, auto responder) {
    ++handled;
    waiting.push_back(responder);
  });
  const auto client = make_client(*caller, topics::arm_motion);
  call("owner", 1000s);
  turn_until([&] { return client.statistics().sent >= 3; });
  EXPECT_TRUE(results.empty());
  waiting.at(0).reply(because("at last"));
  turn_until([this] { return !results.empty(); });
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
}

TEST_F(LiveCall, SaysWhetherNobodyServesOrNobodyAnswers) {
  call("", 200ms);
  turn_until([this] { return results.size() == 1; });
  EXPECT_THAT(message, HasSubstr("nobody serves roci/arm/request"));
  owner = make("owner");
  serve(*owner, topics::arm_motion, [](const v1::ArmMotionRequest&, auto) {});
  call("stranger", 2s);
  turn_until([this] { return results.size() == 2; });
  EXPECT_THAT(message, HasSubstr("stranger never appeared"));
  call("owner", 2s);
  turn_until([this] { return results.size() == 3; });
  EXPECT_THAT(results, ElementsAre("no_owner", "no_owner", "timeout"));
}

TEST_F(LiveCall, EndsAtOnceWhenTheOwnerDies) {
  owner = make("owner");
  serve(*owner, topics::arm_motion, [](const v1::ArmMotionRequest&, auto) {});
  turn_until([this] { return caller->peer_alive("owner"); });
  call("owner", 100'000s);
  turn_until([this] { return make_client(*caller, topics::arm_motion).statistics().sent > 0; });
  owner.reset();
  turn_until([this] { return !results.empty(); });
  call("owner", 100'000s);
  turn_until([this] { return results.size() == 2; });
  EXPECT_THAT(results, ElementsAre("owner_lost", "no_owner"));
}

}  // namespace
}  // namespace roci::services
