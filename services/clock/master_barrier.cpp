// The barrier in the master's node: feeds the ClockMaster with what the participants say, publishes its
// steps.
#include <algorithm>

#include "services/clock/barrier.hpp"
#include "services/clock/clock_master.hpp"
#include "services/clock/pace.hpp"
#include "services/clock/restart_hold.hpp"
#include "services/health/peer_table.hpp"
#include "services/log.hpp"
#include "services/node/impl.hpp"
#include "services/publisher.hpp"
#include "services/type_support.hpp"

namespace roci::services {
namespace {

constexpr double kIdleTurnS = 1;
constexpr double kShowTimeS = 0.2;  // observers see the time at least this often while only the master acts
constexpr double kNoteAfterS = 10;  // a barrier that waits this long is worth a line in the log
constexpr double kLeaveLimitS = 5;  // for the participants' answers to the last step

std::vector<std::string> full_roster(const NodeOptions& options) {
  std::vector<std::string> roster = options.master.roster;
  if (std::ranges::find(roster, options.name) == roster.end()) roster.push_back(options.name);
  return roster;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

class MasterBarrier : public Barrier {
 public:
  explicit MasterBarrier(Node& node)
      : node_(node),
        step_writer_(advertise(node, topics::clock_step)),
        master_(node.options().name, full_roster(node.options())),
        peers_(wall::seconds(node.options().master.hang_limit_s)),
        pace_(node.options().master.pace, wall::now()),
        hold_(wall::seconds(node.options().master.restart_hold_s)) {
    subscribe(node, topics::clock_ready, [this](const v1::ClockReady& ready) { master_.ready(ready); });
    subscribe(node, topics::clock_done, [this](const v1::ClockDone& done) {
      peers_.seen(done.service(), done.incarnation(), wall::now());
      master_.done(done);
    });
    subscribe(node, topics::heartbeat, [this](const v1::Heartbeat& beat) {
      if (beat.service() != node_.options().name) peers_.heartbeat(beat, wall::now());
    });
    node.impl()
        .endpoints.find_in(topics::heartbeat.name)
        ->on_owner_lost.push_back([this](const Payload& key) {
          v1::Heartbeat beat;
          if (deserialize_key(key, beat) && beat.run() == node_.impl().run) peers_.owner_lost(beat.service());
        });
  }

  void open(const v1::ClockReady& ready) override {
    master_.ready(ready);
    waiting_since_ = wall::now();
  }

  void turn(wall::Instant now) override {
    peers_.check(now);
    for (const PeerChange& change : peers_.take_changes()) {
      if (!change.alive) lose(change, now);
    }
    if (auto revision = master_.take_revision()) publish(std::move(*revision), now);
    if (master_.owing().empty()) advance(now);
    note_long_wait(now);
  }

  const std::optional<v1::ClockStep>& step() const override { return step_; }
  void answer(const v1::ClockDone& done) override { master_.done(done); }

  bool stop() override {
    stopping_ = true;
    return step_.has_value();  // before time 0 there is no run to end
  }
  bool over(wall::Instant now) const override {
    return step_ && step_->last() && (master_.owing().empty() || now > leave_by_);
  }

  wall::Instant next_turn(wall::Instant now) const override {
    const auto window = master_.window();
    if (!window || hold_.holds(master_.missing().empty(), now)) return now + wall::seconds(kIdleTurnS);
    return std::min(pace_.earliest(window->earliest), now + wall::seconds(kIdleTurnS));
  }

 private:
  void lose(const PeerChange& change, wall::Instant now) {
    master_.lost(change.service, change.incarnation, change.cause);
    hold_.lost(change.cause, now);
  }

  void advance(wall::Instant now) {
    if (step_ && step_->last()) return;
    if (stopping_ && step_) return issue_last(now);
    if (hold_.holds(master_.missing().empty(), now)) return;
    const auto window = master_.window();
    if (!window || pace_.earliest(window->earliest) > now) return;
    const Time time = std::clamp(pace_.time_at(now), window->earliest, window->latest);
    try {
      publish(master_.issue(time), now);
    } catch (const ClockError&) {
      issue_last(now);
      throw;
    }
    pace_.reached(time, now);
  }

  void issue_last(wall::Instant now) {
    leave_by_ = now + wall::seconds(kLeaveLimitS);
    publish(master_.issue_last(), now);
  }

  void publish(v1::ClockStep step, wall::Instant now) {
    const auto& participants = step.participants();
    const bool alone = participants.size() == 1 && participants.front() == node_.options().name;
    if (!alone || now >= show_time_) {
      step_writer_.write(step);
      show_time_ = now + wall::seconds(kShowTimeS);
    }
    step_ = std::move(step);
    waiting_since_ = now;
    noted_ = false;
  }

  void note_long_wait(wall::Instant now) {
    if (noted_ || now - waiting_since_ < wall::seconds(kNoteAfterS)) return;
    noted_ = true;
    if (const auto missing = master_.missing(); !missing.empty()) {
      log_warning("the clock waits for services to start: " + joined(missing));
    } else if (const auto owing = master_.owing(); !owing.empty()) {
      log_warning("the clock waits at " + std::to_string(master_.time().count()) +
                  " us for: " + joined(owing));
    }
  }

  Node& node_;
  Publisher<v1::ClockStep> step_writer_;
  ClockMaster master_;
  PeerTable peers_;
  Pace pace_;
  RestartHold hold_;
  std::optional<v1::ClockStep> step_;
  bool stopping_ = false;
  bool noted_ = false;
  wall::Instant waiting_since_;
  wall::Instant show_time_;
  wall::Instant leave_by_;
};

}  // namespace

std::unique_ptr<Barrier> make_master_barrier(Node& node) { return std::make_unique<MasterBarrier>(node); }

}  // namespace roci::services
