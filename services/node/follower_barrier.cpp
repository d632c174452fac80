// The barrier as a follower sees it: ClockReady until admitted, ClockStep in, ClockDone out.
#include <algorithm>
#include <ranges>

#include "services/log/log.hpp"
#include "services/node/barrier.hpp"
#include "services/node/node_impl.hpp"
#include "services/node/typed_endpoints.hpp"
#include "services/transport/type_support.hpp"

namespace roci::services::node {
namespace {

constexpr double kReadyPeriodS = 1;
constexpr int kPeriodsUntilNote = 10;

auto order(const v1::ClockStep& step) {
  return std::tuple(step.time_us(), step.micro_step(), step.revision());
}

class FollowerBarrier : public Barrier {
 public:
  explicit FollowerBarrier(NodeImpl& node)
      : node_(node),
        ready_stream_(advertise(node, topics::clock_ready)),
        done_stream_(advertise(node, topics::clock_done)) {
    subscribe(node, topics::clock_step, [this](const v1::ClockStep& step) {
      if (!step_ || order(step) > order(*step_)) step_ = step;
    });
    subscribe(node, topics::heartbeat, [this](const v1::Heartbeat& beat) { node_.hear_namesake(beat); });
    node.endpoints.find_in(topics::clock_step.name)
        ->on_no_writers.push_back([this](const transport::Payload& key) {
          v1::ClockStep lost;
          if (transport::deserialize_key(key, lost) && lost.run() == node_.run.name())
            master_lost_ = step_.has_value();
        });
  }

  void open(const v1::ClockReady& ready) override { ready_ = ready; }

  void turn(clock::WallTime now) override {
    const bool last = step_ && step_->last();
    if (master_lost_ && !last)
      throw clock::ClockGone("the simulated clock's master " + step_->master() + " is gone");
    check_roster();
    if (admitted_ || now < next_ready_) return;
    next_ready_ = now + clock::wall_seconds(kReadyPeriodS);
    write(ready_stream_, ready_);
    if (++waited_periods_ == kPeriodsUntilNote)
      log::info(ready_.service() + " waits for the simulated clock to start");
  }

  const std::optional<v1::ClockStep>& step() const override { return step_; }
  void answer(const v1::ClockDone& done) override { write(done_stream_, done); }
  bool stop() override { return false; }
  bool over(clock::WallTime) const override { return true; }
  clock::WallTime next_turn(clock::WallTime now) const override {
    return admitted_ ? now + clock::wall_seconds(kReadyPeriodS) : next_ready_;
  }

 private:
  void check_roster() {
    if (!step_) return;
    const bool listed = std::ranges::any_of(step_->roster(), [&](const v1::RosterEntry& entry) {
      return entry.service() == ready_.service() && entry.incarnation() == ready_.incarnation();
    });
    if (admitted_ && !listed) {
      throw clock::ClockError("the clock's master dropped " + ready_.service() +
                              " from the run; it must be started anew");
    }
    admitted_ = listed;
  }

  NodeImpl& node_;
  TopicWriter& ready_stream_;
  TopicWriter& done_stream_;
  v1::ClockReady ready_;
  std::optional<v1::ClockStep> step_;
  clock::WallTime next_ready_;
  int waited_periods_ = 0;
  bool admitted_ = false;
  bool master_lost_ = false;
};

}  // namespace

std::unique_ptr<Barrier> make_follower_barrier(NodeImpl& node) {
  return std::make_unique<FollowerBarrier>(node);
}

}  // namespace roci::services::node
