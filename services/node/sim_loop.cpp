// The loop of nodes under the simulated clock: acts when the barrier says so, on exactly what the step
// announces.
#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "services/bounds/limits.hpp"
#include "services/clock/hold_back_queue.hpp"
#include "services/health/heartbeat_sender.hpp"
#include "services/node/barrier.hpp"
#include "services/node/node_impl.hpp"
#include "services/node/roster_view.hpp"

namespace roci::services::node {
namespace {

clock::Durability durability_of(transport::Qos qos) {
  return qos == transport::Qos::state ? clock::Durability::transient_local : clock::Durability::volatile_;
}

std::optional<temporal::Time> earliest(std::optional<temporal::Time> a, std::optional<temporal::Time> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

class SimLoop : public Loop {
 public:
  explicit SimLoop(NodeImpl& node) : node_(node) {}

  temporal::Time now() const override { return now_; }
  health::PeerState peer(std::string_view service) const override { return roster_.state(service); }

  void take_clocked(TopicReader& input, const v1::SampleHeader& header,
                    std::shared_ptr<const void> value) override {
    if (header.incarnation() == 0) {
      if (outside_.size() >= bounds::kOutsideInputs)
        return node_.rejected.note(input.topic.name, SampleRejection::queue_full);
      outside_.push_back({&input, std::move(value)});
    } else if (!held_back_.add(stream_topic(input.topic, header.robot()), header, std::move(value))) {
      node_.rejected.note(input.topic.name, SampleRejection::no_room);
    }
  }

  void spin_once(std::chrono::milliseconds) override {
    throw std::logic_error("spin_once: under the simulated clock a node runs with run()");
  }

  void beat() override {
    if (heartbeat_) heartbeat_->beat(clock::wall_now(), true);
  }

  void run() override {
    open();
    while (!over_) turn();
    heartbeat_->leave();
  }

 private:
  struct OutsideInput {
    TopicReader* input;
    std::shared_ptr<const void> value;
  };

  void open() {
    const bool master = node_.options.clock == clock::ClockMode::master;
    barrier_ = master ? make_master_barrier(node_) : make_follower_barrier(node_);
    heartbeat_.emplace(node_.make_heartbeat_sender());
    v1::ClockReady ready;
    ready.service(node_.options.name);
    ready.incarnation(node_.options.incarnation);
    for (const TopicSpec& topic : node_.endpoints.clocked_inputs()) {
      for (const std::string& stream : node_.endpoints.heard_streams(topic)) {
        held_back_.subscribe(stream, durability_of(topic.qos), topic.codec.key);
        ready.subscriptions().push_back(stream);
      }
    }
    barrier_->open(ready);
  }

  void turn() {
    NodeImpl& impl = node_;
    const clock::WallTime before = clock::wall_now();
    Inbox::Batch batch = impl.inbox.take(std::min(heartbeat_->next(), barrier_->next_turn(before)));
    for (auto& arrival : batch.arrivals) impl.receive(std::move(arrival));
    for (auto& result : batch.results) impl.work.finish(result.work, std::move(result.run));
    const clock::WallTime now = clock::wall_now();
    heartbeat_->beat(now);
    impl.announce_turn();
    if (batch.stop && !barrier_->stop()) over_ = true;
    barrier_->turn(now);
    if (const auto& step = barrier_->step()) follow(*step);
    if (barrier_->step() && barrier_->step()->last()) over_ = over_ || barrier_->over(now);
  }

  void follow(const v1::ClockStep& step) {
    if (!acting_ && awaits_me(step)) {
      if (step.last()) return answer(step);
      if (held_back_.complete(step)) act(step);
    }
    if (acting_) {
      node_.work.run_finished();
      if (!node_.work.outstanding()) answer(step);
    } else if (!outside_.empty() && !awaits_me(step)) {
      ask_for_a_step();
    }
  }

  bool awaits_me(const v1::ClockStep& step) const {
    const NodeOptions& me = node_.options;
    if (answered_ && answered_->time_us() == step.time_us() && answered_->micro_step() == step.micro_step())
      return false;
    return std::ranges::find(step.participants(), me.name) != step.participants().end() &&
           contains(step.roster(), me.name, me.incarnation);
  }

  void act(const v1::ClockStep& step) {
    acting_ = true;
    now_ = temporal::Time(step.time_us());
    // A death in the middle of a micro-step shows in its revisions, but everybody surfaces it in the next
    // one.
    if (step.revision() == 0) {
      for (const health::PeerChange& change : roster_.update(step, node_.options.name))
        node_.announce(change);
    }
    for (const LinkGate::Due& due : node_.links.take(now_)) NodeImpl::handle(*due.reader, due.value.get());
    for (const clock::Delivery& delivery : held_back_.take(step))
      if (delivery.value) hear(*node_.endpoints.find_in(delivery.topic), delivery.value);
    take_outside_input();
    node_.timers.run_due(now_);
  }

  void take_outside_input() {
    for (const OutsideInput& input : std::exchange(outside_, {})) {
      const bool stale =
          !answered_ && input.input->topic.qos != transport::Qos::state;  // said before this node took part
      if (!stale) hear(*input.input, input.value);
    }
  }

  void hear(TopicReader& input, const std::shared_ptr<const void>& value) {
    if (node_.links.admit(input, value, now_)) NodeImpl::handle(input, value.get());
  }

  void answer(const v1::ClockStep& step) {
    const NodeOptions& me = node_.options;
    v1::ClockDone done;
    done.service(me.name);
    done.incarnation(me.incarnation);
    done.time_us(step.time_us());
    done.micro_step(step.micro_step());
    done.sent(node_.endpoints.take_growth());
    const auto wish = earliest(node_.timers.earliest(), node_.links.next());
    done.wish_us(wish ? std::max(*wish, now_).count() : -1);
    node_.endpoints.begin_micro_step();
    acting_ = false;
    asked_ = false;
    answered_ = done;
    barrier_->answer(done);
  }

  void ask_for_a_step() {
    if (asked_ || !answered_) return;
    asked_ = true;
    v1::ClockDone again = *answered_;
    again.wish_us(now_.count());
    barrier_->answer(again);
  }

  NodeImpl& node_;
  std::unique_ptr<Barrier> barrier_;
  std::optional<health::HeartbeatSender> heartbeat_;
  clock::HoldBackQueue held_back_;
  RosterView roster_;
  std::vector<OutsideInput> outside_;
  std::optional<v1::ClockDone> answered_;
  temporal::Time now_{0};
  bool acting_ = false;
  bool asked_ = false;
  bool over_ = false;
};

}  // namespace

std::unique_ptr<Loop> make_sim_loop(NodeImpl& node) { return std::make_unique<SimLoop>(node); }

}  // namespace roci::services::node
