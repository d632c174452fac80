#include "tests/unit/services/toy_run.hpp"

#include <memory>
#include <random>

#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kRoster{"alpha", "beta", "delta", "gamma"};
constexpr temporal::Time kEnd = 3s;

class Toy {
 public:
  Toy(Node& node, std::uint64_t seed)
      : node_(node),
        random_(seed ^ std::hash<std::string>{}(node.options().name)),
        events_(advertise(node, topics::event)),
        observations_(advertise(node, topics::observation)),
        commands_(advertise(node, topics::command)),
        arm_(make_client(node, topics::arm_motion)) {
    subscribe(node, topics::event,
              [this](const v1::Event& event) { saw("event", event.header(), event.text()); });
    subscribe(node, topics::observation, [this](const v1::Observation& observation) {
      saw("observation", observation.header(), observation.timeline());
    });
    subscribe(node, topics::command, [this](const v1::Command& command) {
      saw("command", command.header(), command.command_name());
    });
    serve(node, topics::arm_motion, [this](const v1::ArmMotionRequest& request, auto responder) {
      saw("request", request.header(), request.to_pose());
      v1::ArmMotionReply reply;
      reply.reason(request.to_pose() + " by " + node_.options().name);
      node_.after(temporal::Duration(pick(3) * 500), [responder, reply] { responder.reply(reply); });
    });
    node.on_peer_change([this](const health::PeerChange& change) { note("peer " + change.service); });
    for (int i = 0; i < 3; ++i) set_timer();
    write_something();
  }

  const Trace& trace() const { return trace_; }

 private:
  std::int64_t pick(std::int64_t below) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(below));
  }

  void note(const std::string& what) { trace_.push_back(std::to_string(node_.now().count()) + " " + what); }

  void saw(const std::string& what, const v1::SampleHeader& header, const std::string& content) {
    note(what + " " + header.sender() + " " + std::to_string(header.seq()) + " " +
         std::to_string(header.stamp_us()) + " " + content);
    if (pick(6) == 0) write_something();  // below 1/4 on average, so that chains of answers die out
  }

  void set_timer() {
    // Few distinct times, so that many services act at the same one.
    node_.after(temporal::Duration(1'000 * (1 + pick(200))), [this, id = ++timers_] {
      note("timer " + std::to_string(id));
      write_something();
      if (node_.now() < kEnd) set_timer();
    });
  }

  void write_something() {
    const std::string text = node_.options().name + std::to_string(++written_);
    switch (pick(4)) {
      case 0: {
        v1::Event event;
        event.text(text);
        events_.write(event);
        return;
      }
      case 1: {
        v1::Observation observation;
        observation.timeline("t" + std::to_string(pick(3)));
        observations_.write(observation);
        return;
      }
      case 2: {
        v1::Command command;
        command.activity(text);
        command.command_name(text);
        commands_.write(command);
        return;
      }
      default:
        call(text);
    }
  }

  void call(const std::string& text) {
    v1::ArmMotionRequest request;
    request.to_pose(text);
    const std::string owner = kRoster[static_cast<std::size_t>(pick(4))];
    arm_.call(request, owner, temporal::Duration(1'000),
              [this, text](const CallResult<v1::ArmMotionReply>& result) {
                note("result " + text + " " + to_string(result.status) + " " + result.reply.reason());
              });
  }

  Node& node_;
  std::mt19937_64 random_;
  Publisher<v1::Event> events_;
  Publisher<v1::Observation> observations_;
  Publisher<v1::Command> commands_;
  Client<v1::ArmMotionRequest, v1::ArmMotionReply> arm_;
  int written_ = 0;
  int timers_ = 0;
  Trace trace_;
};

}  // namespace

Trace toy_run(std::uint64_t seed, const std::vector<std::string>& transports, int domain) {
  SimRun run(kRoster, domain);
  std::vector<std::unique_ptr<Toy>> toys;
  for (std::size_t i = 0; i < kRoster.size(); ++i) {
    toys.push_back(std::make_unique<Toy>(run.add(kRoster[i], 1, transports[i]), seed));
  }
  run.node("alpha").at(kEnd + 1s, [&run] { run.node("alpha").stop(); });
  run.run();
  Trace trace;
  for (const auto& toy : toys) trace.insert(trace.end(), toy->trace().begin(), toy->trace().end());
  return trace;
}

}  // namespace roci::services
