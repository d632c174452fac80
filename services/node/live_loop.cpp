// The loop of live and observer nodes: samples are handled as they come.
#include <algorithm>
#include <optional>

#include "services/clock/live_clock.hpp"
#include "services/health/failure_detector.hpp"
#include "services/health/heartbeat_sender.hpp"
#include "services/node/node_impl.hpp"
#include "services/node/typed_endpoints.hpp"
#include "services/transport/type_support.hpp"

namespace roci::services::node {
namespace {

constexpr double kLongestWaitS = 0.25;

// An observer has timers alone on its clock, and nobody hands it an anchor: it takes one of its own.
std::optional<clock::HostAnchor> anchor_for(clock::ClockMode mode) {
  const auto& handed = clock::handed_anchor();
  if (handed || mode != clock::ClockMode::observer) return handed;
  return clock::anchor_host();
}

class LiveLoop : public Loop {
 public:
  explicit LiveLoop(NodeImpl& node)
      : node_(node),
        clock_(node.options.epoch_unix_us, node.options.live_scale, anchor_for(node.options.clock)),
        observer_(node.options.clock == clock::ClockMode::observer),
        peers_(clock::wall_seconds(node.options.live_hang_limit_s)) {}

  temporal::Time now() const override { return observer_ ? newest_stamp_ : clock_.now(); }
  temporal::Time timer_now() const override { return clock_.now(); }
  health::PeerState peer(std::string_view service) const override { return peers_.state(service); }

  void take_clocked(TopicReader& input, const v1::SampleHeader& header,
                    std::shared_ptr<const void> value) override {
    newest_stamp_ = std::max(newest_stamp_, temporal::Time(header.stamp_us()));
    if (observer_ || node_.links.admit(input, value, now())) NodeImpl::handle(input, value.get());
  }

  void run() override {
    while (!stopped_) spin_once(std::chrono::hours(1));
    if (heartbeat_) heartbeat_->leave();
  }

  void beat() override {
    if (heartbeat_) heartbeat_->beat(clock::wall_now(), true);
  }

  void spin_once(std::chrono::milliseconds wait) override {
    open();
    NodeImpl& impl = node_;
    Inbox::Batch batch = impl.inbox.take(wake_up(clock::wall_now() + wait));
    stopped_ = batch.stop;
    if (batch.matched) impl.announce_match();
    if (!observer_) {
      for (const LinkGate::Due& due : impl.links.take(this->now()))
        NodeImpl::handle(*due.reader, due.value.get());
    }
    for (auto& arrival : batch.arrivals) impl.receive(std::move(arrival));
    const clock::WallTime now = clock::wall_now();
    if (heartbeat_) heartbeat_->beat(now, impl.degraded);
    impl.announce_turn();
    peers_.check(now);
    for (const health::PeerChange& change : peers_.take_changes()) {
      if (change.service != node_.options.name) impl.announce(change);
    }
    for (auto& result : batch.results) impl.work.finish(result.work, std::move(result.run));
    impl.work.run_finished();
    impl.timers.run_due(timer_now());
  }

 private:
  void open() {
    if (opened_) return;
    opened_ = true;
    if (!observer_) heartbeat_.emplace(node_.make_heartbeat_sender());
    subscribe(node_, topics::heartbeat, [this](const v1::Heartbeat& beat) {
      if (!peers_.heartbeat(beat, clock::wall_now()))
        node_.rejected.note(topics::heartbeat.name, SampleRejection::no_room);
      node_.hear_namesake(beat);
    });
    node_.endpoints.find_in(topics::heartbeat.name)
        ->on_no_writers.push_back([this](const transport::Payload& key) {
          v1::Heartbeat beat;
          if (transport::deserialize_key(key, beat) && beat.run() == node_.run.name())
            peers_.writer_lost(beat.service());
        });
    if (observer_) {
      subscribe(node_, topics::clock_step, [this](const v1::ClockStep& step) {
        newest_stamp_ = std::max(newest_stamp_, temporal::Time(step.time_us()));
      });
    }
  }

  clock::WallTime wake_up(clock::WallTime latest) const {
    latest = std::min(latest, clock::wall_now() + clock::wall_seconds(kLongestWaitS));
    if (heartbeat_) latest = std::min(latest, heartbeat_->next());
    if (const auto due = node_.timers.earliest()) latest = std::min(latest, wall_of(*due));
    if (const auto due = node_.links.next()) latest = std::min(latest, wall_of(*due));
    return latest;
  }

  clock::WallTime wall_of(temporal::Time due) const {
    return clock::wall_now() + clock_.wall_for(std::max(due - timer_now(), temporal::Duration(0)));
  }

  NodeImpl& node_;
  clock::LiveClock clock_;
  bool observer_;
  health::FailureDetector peers_;
  std::optional<health::HeartbeatSender> heartbeat_;
  temporal::Time newest_stamp_{0};
  bool opened_ = false;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Loop> make_live_loop(NodeImpl& node) { return std::make_unique<LiveLoop>(node); }

}  // namespace roci::services::node
