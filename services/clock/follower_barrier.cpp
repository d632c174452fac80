// The barrier as a follower sees it: ClockReady until admitted, ClockStep in, ClockDone out.
#include <algorithm>
#include <ranges>

#include "services/clock/barrier.hpp"
#include "services/log.hpp"
#include "services/node/impl.hpp"
#include "services/publisher.hpp"
#include "services/type_support.hpp"

namespace roci::services {
namespace {

constexpr double kReadyPeriodS = 1;
constexpr int kPeriodsUntilNote = 10;

auto order(const v1::ClockStep& step) {
  return std::tuple(step.time_us(), step.micro_step(), step.revision());
}

class FollowerBarrier : public Barrier {
 public:
  explicit FollowerBarrier(Node& node)
      : node_(node),
        ready_writer_(advertise(node, topics::clock_ready)),
        done_writer_(advertise(node, topics::clock_done)) {
    subscribe(node, topics::clock_step, [this](const v1::ClockStep& step) {
      if (!step_ || order(step) > order(*step_)) step_ = step;
    });
    node.impl().endpoints.find_in(topics::clock_step.name)->on_owner_lost.push_back([this](const Payload& key) {
      v1::ClockStep lost;
      if (deserialize_key(key, lost) && lost.run() == node_.impl().run) master_lost_ = step_.has_value();
    });
  }

  void open(const v1::ClockReady& ready) override { ready_ = ready; }

  void turn(wall::Instant now) override {
    const bool last = step_ && step_->last();
    if (master_lost_ && !last)
      throw ClockGone("the simulated clock's master " + step_->master() + " is gone");
    check_roster();
    if (admitted_ || now < next_ready_) return;
    next_ready_ = now + wall::seconds(kReadyPeriodS);
    ready_writer_.write(ready_);
    if (++waited_periods_ == kPeriodsUntilNote)
      log_info(ready_.service() + " waits for the simulated clock to start");
  }

  const std::optional<v1::ClockStep>& step() const override { return step_; }
  void answer(const v1::ClockDone& done) override { done_writer_.write(done); }
  bool stop() override { return false; }
  bool over(wall::Instant) const override { return true; }
  wall::Instant next_turn(wall::Instant now) const override {
    return admitted_ ? now + wall::seconds(kReadyPeriodS) : next_ready_;
  }

 private:
  void check_roster() {
    if (!step_) return;
    const bool listed = std::ranges::any_of(step_->roster(), [&](const v1::RosterEntry& entry) {
      return entry.service() == ready_.service() && entry.incarnation() == ready_.incarnation();
    });
    if (admitted_ && !listed) {
      throw ClockError("the clock's master dropped " + ready_.service() +
                       " from the run; it must be started anew");
    }
    admitted_ = listed;
  }

  Node& node_;
  Publisher<v1::ClockReady> ready_writer_;
  Publisher<v1::ClockDone> done_writer_;
  v1::ClockReady ready_;
  std::optional<v1::ClockStep> step_;
  wall::Instant next_ready_;
  int waited_periods_ = 0;
  bool admitted_ = false;
  bool master_lost_ = false;
};

}  // namespace

std::unique_ptr<Barrier> make_follower_barrier(Node& node) { return std::make_unique<FollowerBarrier>(node); }

}  // namespace roci::services
