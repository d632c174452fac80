// The rules of an owner, asked of the drill of example_service: of the SDK's, and of the native ones that were written
// by docs/protocol-commands.md. All three give the same answers, on the live clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

constexpr char kExecutive[] = "exec_svc";
const std::string kGreeting = "greeting-";
constexpr v1::CommandAction kExecute = v1::COMMAND_EXECUTE, kCancel = v1::COMMAND_CANCEL,
                            kQuery = v1::COMMAND_QUERY;

// A process that commands and calls as the executive and the planner do.
class Commander {
 public:
  Commander(const std::string& vendor, int domain, std::int64_t epoch, std::uint32_t incarnation) {
    node::NodeOptions options;
    options.name = kExecutive;
    options.run = "test";
    options.robot = "miner";
    options.sole = false;  // two of them are what this test is about
    options.incarnation = incarnation;
    options.epoch_unix_us = epoch;
    options.vendor = vendor;
    transport::TransportOptions transport;
    transport.domain = domain;
    transport.participant = kExecutive;
    node_.emplace(options, transport::open_transport(vendor, transport));
    commands_ = advertise(*node_, topics::command);
    calls_ = make_client(*node_, topics::function_call);
    subscribe(*node_, topics::command_ack, [this](const v1::CommandAck& ack) { acks_.push_back(ack); });
    subscribe(*node_, topics::function_offer, [this](const v1::FunctionOffer& offer) { offer_ = offer; });
  }

  // The words that come until one is about `activity`, as "activity stage code" and what is told of epochs. A late
  // answer to a greeting is none of them.
  std::vector<std::string> say(v1::CommandAction action, const std::string& activity, std::uint64_t epoch,
                               const std::string& name = "bore") {
    acks_.clear();
    v1::Command command;
    command.commander(kExecutive);
    command.epoch(1);
    command.activity(activity);
    command.sender_epoch(epoch);
    command.action(action);
    command.owner("drill_svc");
    command.robot("miner");
    command.subsystem("drill");
    command.command_name(name);
    command.latest_end_us(-1);
    for (const auto& [key, value] : {std::pair{"place", "here"}, std::pair{"depth", "4"}}) {
      v1::Property argument;
      argument.name(key);
      argument.value(value);
      command.arguments().push_back(argument);
    }
    commands_.write(command);
    spin_until(
        [&] {
          return std::ranges::any_of(acks_, [&](const auto& ack) { return ack.activity() == activity; });
        },
        2s);
    std::vector<std::string> words;
    for (const v1::CommandAck& ack : acks_) {
      if (!ack.activity().starts_with(kGreeting)) words.push_back(text_of(ack));
    }
    return words;
  }

  // Asks until the owner hears: a reader of Cyclone DDS alone may miss what came right after the match (docs/dds.md).
  // Each question has a key of its own, so that a late answer to one is not taken for that of a later command.
  bool greet() {
    for (int attempt = 0; attempt < 10; ++attempt) {
      say(kQuery, kGreeting + std::to_string(attempt), 1);
      if (!acks_.empty()) return true;
    }
    return false;
  }

  // How often a word on `activity` has come since the last command.
  std::ptrdiff_t heard(const std::string& activity) const {
    return std::ranges::count(acks_, activity, [](const v1::CommandAck& ack) { return ack.activity(); });
  }

  bool spin_until(const std::function<bool()>& done, clock::WallDuration limit) {
    const auto end = clock::wall_now() + limit;
    while (!done() && clock::wall_now() < end) node_->spin_once(50ms);
    return done();
  }

  // The outcomes of bore_time, bore_time of two, and of a function that nobody has.
  std::vector<v1::FunctionOutcome> outcomes() {
    v1::FunctionRequest request;
    request.module_name("drill");
    for (const char* depth : {"0.5", "9", ""}) {
      v1::PlanObject object;
      v1::Property property;
      property.name("depth");
      property.value(depth);
      if (*depth != '\0') object.properties().push_back(property);
      request.objects().push_back(object);
    }
    for (const auto& [function, arity] :
         {std::pair{"bore_time", 1}, std::pair{"bore_time", 2}, std::pair{"dig_time", 1}}) {
      v1::FunctionBatch batch;
      batch.function(function);
      batch.arity(static_cast<std::uint32_t>(arity));
      batch.tuples(arity == 2 ? std::vector<std::uint32_t>{0, 1} : std::vector<std::uint32_t>{0, 1, 2, 7});
      request.batches().push_back(batch);
    }
    std::optional<CallResult<v1::FunctionReply>> result;
    calls_.call(request, "drill_svc", 20s, [&](const auto& came) { result = came; });
    spin_until([&] { return result.has_value(); }, 25s);
    std::vector<v1::FunctionOutcome> out;
    if (!result || result->status != rpc::CallStatus::ok) return out;
    for (const v1::FunctionValues& values : result->reply.results()) {
      EXPECT_EQ(values.numbers().size(), values.outcomes().size());
      out.insert(out.end(), values.outcomes().begin(), values.outcomes().end());
    }
    EXPECT_DOUBLE_EQ(result->reply.results().at(0).numbers().at(0), 260);
    return out;
  }

  const std::optional<v1::FunctionOffer>& offer() const { return offer_; }

 private:
  static std::string text_of(const v1::CommandAck& ack) {
    static constexpr const char* kStages[] = {"accepted",  "rejected",      "completed", "failed",
                                              "cancelled", "cancel_failed", "unknown"};
    return ack.activity() + " " + kStages[ack.stage()] + " " + ack.code() +
           (ack.refused_epoch() ? " newest " + std::to_string(ack.newest_epoch()) : "");
  }

  std::optional<Node> node_;
  Publisher<v1::Command> commands_;
  Client<v1::FunctionRequest, v1::FunctionReply> calls_;
  std::vector<v1::CommandAck> acks_;
  std::optional<v1::FunctionOffer> offer_;
};

class NativeOwner : public testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  const process::DomainClaim domain_;
};

TEST_P(NativeOwner, KeepsTheRulesOfThePage) {
  const auto [drill, vendor] = GetParam();
  const std::string mission = ROCI_BINARY_DIR "/tests/missions/" + std::string(drill) + "/borehole";
  const std::int64_t epoch = clock::unix_us() / 1'000'000;
  ChildProcess process({mission + "/bin/drill_svc",
                        "--name",
                        "drill_svc",
                        "--run",
                        "test",
                        "--mission",
                        mission,
                        "--robot",
                        "miner",
                        "--domain",
                        std::to_string(domain_.id()),
                        "--clock",
                        "live",
                        "--scale",
                        "1",
                        "--epoch",
                        std::to_string(epoch),
                        "--incarnation",
                        "1",
                        "--dds",
                        vendor},
                       {"ROCI_PLUGIN_PATH=" ROCI_BINARY_DIR "/lib/rocinante"});
  Commander first(vendor, domain_.id(), epoch * 1'000'000, 1);
  ASSERT_TRUE(first.greet());

  EXPECT_THAT(first.say(kQuery, "nothing", 1), ElementsAre("nothing unknown unknown-key"));
  EXPECT_THAT(first.say(kExecute, "a", 1), ElementsAre("a accepted "));
  EXPECT_THAT(first.say(kExecute, "a", 1), ElementsAre("a accepted ")) << "a key is taken once";
  EXPECT_THAT(first.say(kQuery, "a", 1), ElementsAre("a accepted "));
  EXPECT_THAT(first.say(kExecute, "b", 1), ElementsAre("b rejected busy"));
  EXPECT_THAT(first.say(kExecute, "c", 1, "dance"), ElementsAre("c rejected unknown-command"));
  EXPECT_THAT(first.say(kExecute, "lead", 2, "lead"), ElementsAre("lead completed done"));
  EXPECT_THAT(first.say(kExecute, "d", 1), ElementsAre("d rejected old-epoch newest 2"));
  EXPECT_THAT(first.say(kQuery, "a", 1), ElementsAre("a rejected old-epoch newest 2"));
  EXPECT_THAT(first.say(kExecute, "d", 1003), ElementsAre("d rejected epoch-jump newest 2"));
  EXPECT_THAT(first.say(kQuery, "a", 1003), ElementsAre("a accepted ")) << "a question moves nothing";
  EXPECT_THAT(first.say(kCancel, "nothing", 2), ElementsAre("nothing unknown unknown-key"));
  EXPECT_THAT(first.say(kCancel, "a", 2), ElementsAre("a cancelled cancelled"));
  EXPECT_THAT(first.say(kCancel, "a", 2), ElementsAre("a cancel_failed already-ended"));
  EXPECT_THAT(first.say(kExecute, "a", 2), ElementsAre("a cancelled cancelled")) << "the last word stays";
  EXPECT_THAT(first.say(kExecute, "d", 2), ElementsAre("d accepted "))
      << "what was refused has not taken its key";
  EXPECT_THAT(first.say(kExecute, "halt", 0, "stop"),
              ElementsAre("d cancelled stopped", "halt completed done"));

  ASSERT_TRUE(first.spin_until([&] { return first.offer().has_value(); }, 10s));
  EXPECT_EQ(first.offer()->module_name(), "drill");
  EXPECT_THAT(first.outcomes(),
              ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_UNREACHABLE, v1::FUNCTION_UNKNOWN_OBJECT,
                          v1::FUNCTION_UNKNOWN_OBJECT, v1::FUNCTION_WRONG_ARITY,
                          v1::FUNCTION_UNKNOWN_FUNCTION, v1::FUNCTION_UNKNOWN_FUNCTION,
                          v1::FUNCTION_UNKNOWN_FUNCTION, v1::FUNCTION_UNKNOWN_FUNCTION));

  // Who comes late hears the last word on each key, once.
  Commander second(vendor, domain_.id(), epoch * 1'000'000, 2);
  const std::vector<std::string> keys{"nothing", "a", "b", "c", "d", "lead", "halt"};
  EXPECT_TRUE(second.spin_until(
      [&] { return std::ranges::all_of(keys, [&](const auto& key) { return second.heard(key) > 0; }); },
      20s));
  for (const std::string& activity : keys) EXPECT_EQ(second.heard(activity), 1) << activity;
  ASSERT_TRUE(second.greet());
  EXPECT_THAT(second.say(kExecute, "e", 2), ElementsAre("e rejected doubled-epoch newest 2"));
}

INSTANTIATE_TEST_SUITE_P(Drills, NativeOwner,
                         testing::Combine(testing::Values("sdk", "native_c", "native_cpp"),
                                          testing::Values("fastdds", "cyclonedds")),
                         [](const auto& drill) {
                           return std::string(std::get<0>(drill.param)) + "_" + std::get<1>(drill.param);
                         });

}  // namespace
}  // namespace roci::services::contract
