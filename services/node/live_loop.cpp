// The loop of live and observer nodes: samples are handled as they come.
#include <algorithm>
#include <optional>

#include "services/clock/live_clock.hpp"
#include "services/health/heart.hpp"
#include "services/health/peer_table.hpp"
#include "services/node/impl.hpp"
#include "services/publisher.hpp"
#include "services/type_support.hpp"

namespace roci::services {
namespace {

constexpr double kLongestWaitS = 0.25;

class LiveLoop : public Loop {
 public:
  explicit LiveLoop(Node& node)
      : node_(node),
        clock_(node.options().epoch_unix_us, node.options().live_scale),
        observer_(node.options().clock == ClockMode::observer),
        peers_(wall::seconds(node.options().live_hang_limit_s)) {}

  Time now() const override { return observer_ ? newest_stamp_ : clock_.now(); }
  Time timer_now() const override { return clock_.now(); }
  PeerState peer(std::string_view service) const override { return peers_.state(service); }

  void take_clocked(InTopic& input, const v1::SampleHeader& header,
                    std::shared_ptr<const void> value) override {
    newest_stamp_ = std::max(newest_stamp_, Time(header.stamp_us()));
    Node::Impl::handle(input, value.get());
  }

  void run() override {
    while (!stopped_) spin_once(std::chrono::hours(1));
    if (heart_) heart_->leave();
  }

  void spin_once(std::chrono::milliseconds wait) override {
    open();
    auto& impl = node_.impl();
    Inbox::Batch batch = impl.inbox.take(wake_up(wall::now() + wait));
    stopped_ = batch.stop;
    if (batch.matched) impl.announce_match();
    for (auto& arrival : batch.arrivals) impl.take_in(std::move(arrival));
    const wall::Instant now = wall::now();
    if (heart_) heart_->beat(now);
    impl.announce_turn();
    peers_.check(now);
    for (const PeerChange& change : peers_.take_changes()) {
      if (change.service != node_.options().name) impl.announce(change);
    }
    for (auto& result : batch.results) impl.work.finish(result.work, std::move(result.run));
    impl.work.run_finished();
    impl.timers.run_due(timer_now());
  }

 private:
  void open() {
    if (opened_) return;
    opened_ = true;
    if (!observer_) heart_.emplace(node_);
    subscribe(node_, topics::heartbeat,
              [this](const v1::Heartbeat& beat) { peers_.heartbeat(beat, wall::now()); });
    node_.impl()
        .endpoints.find_in(topics::heartbeat.name)
        ->on_owner_lost.push_back([this](const Payload& key) {
          v1::Heartbeat beat;
          if (deserialize_key(key, beat) && beat.run() == node_.impl().run) peers_.owner_lost(beat.service());
        });
    if (observer_) {
      subscribe(node_, topics::clock_step, [this](const v1::ClockStep& step) {
        newest_stamp_ = std::max(newest_stamp_, Time(step.time_us()));
      });
    }
  }

  wall::Instant wake_up(wall::Instant latest) const {
    latest = std::min(latest, wall::now() + wall::seconds(kLongestWaitS));
    if (heart_) latest = std::min(latest, heart_->next());
    if (const auto due = node_.impl().timers.earliest()) {
      latest = std::min(latest, wall::now() + clock_.wall_for(std::max(*due - timer_now(), Duration(0))));
    }
    return latest;
  }

  Node& node_;
  LiveClock clock_;
  bool observer_;
  PeerTable peers_;
  std::optional<Heart> heart_;
  Time newest_stamp_{0};
  bool opened_ = false;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Loop> make_live_loop(Node& node) { return std::make_unique<LiveLoop>(node); }

}  // namespace roci::services
