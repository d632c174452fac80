// The barrier in the master's node: feeds the ClockMaster with what the participants say, publishes its
// steps.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "services/clock/clock_master.hpp"
#include "services/clock/pace.hpp"
#include "services/clock/restart_hold.hpp"
#include "services/health/failure_detector.hpp"
#include "services/log/log.hpp"
#include "services/node/barrier.hpp"
#include "services/node/node_impl.hpp"
#include "services/node/typed_endpoints.hpp"
#include "services/transport/type_support.hpp"

namespace roci::services::node {
namespace {

constexpr double kIdleTurnS = 1;
constexpr double kShowTimeS = 0.2;  // observers see the time at least this often while only the master acts
constexpr double kNoteAfterS = 10;  // a barrier that waits this long is worth a line in the log
constexpr double kLeaveLimitS = 5;  // for the participants' answers to the last step
// A helper, which the roster names with this mark behind it, is not waited for once it has died so often, or if it has
// not come for so long.
constexpr char kHelperMark = '?';
constexpr int kHelperDeaths = 5;
constexpr double kHelperStartS = 30;

std::vector<std::string> full_roster(const NodeOptions& options) {
  std::vector<std::string> roster = options.master.roster;
  for (std::string& service : roster)
    if (service.ends_with(kHelperMark)) service.pop_back();
  if (std::ranges::find(roster, options.name) == roster.end()) roster.push_back(options.name);
  return roster;
}

std::map<std::string, int> helpers_in(const NodeOptions& options) {
  std::map<std::string, int> out;
  for (const std::string& service : options.master.roster)
    if (service.ends_with(kHelperMark)) out[service.substr(0, service.size() - 1)] = 0;
  return out;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

class MasterBarrier : public Barrier {
 public:
  explicit MasterBarrier(NodeImpl& node)
      : node_(node),
        step_stream_(advertise(node, topics::clock_step)),
        master_(node.options.name, full_roster(node.options)),
        helper_deaths_(helpers_in(node.options)),
        peers_(clock::wall_seconds(node.options.master.hang_limit_s)),
        pace_(node.options.master.pace, clock::wall_now()),
        hold_(clock::wall_seconds(node.options.master.restart_hold_s)) {
    subscribe(node, topics::clock_ready, [this](const v1::ClockReady& ready) {
      if (!master_.ready(ready)) node_.rejected.note(topics::clock_ready.name, SampleRejection::no_room);
    });
    subscribe(node, topics::clock_done, [this](const v1::ClockDone& done) {
      peers_.seen(done.service(), done.incarnation(), clock::wall_now());
      if (!master_.done(done)) node_.rejected.note(topics::clock_done.name, SampleRejection::no_room);
    });
    subscribe(node, topics::heartbeat, [this](const v1::Heartbeat& beat) {
      if (beat.service() != node_.options.name && !peers_.heartbeat(beat, clock::wall_now()))
        node_.rejected.note(topics::heartbeat.name, SampleRejection::no_room);
      node_.hear_namesake(beat);
    });
    node.endpoints.find_in(topics::heartbeat.name)
        ->on_no_writers.push_back([this](const transport::Payload& key) {
          v1::Heartbeat beat;
          if (transport::deserialize_key(key, beat) && beat.run() == node_.run.name())
            peers_.writer_lost(beat.service());
        });
  }

  void open(const v1::ClockReady& ready) override {
    master_.ready(ready);
    waiting_since_ = clock::wall_now();
    helpers_by_ = waiting_since_ + clock::wall_seconds(kHelperStartS);
  }

  void turn(clock::WallTime now) override {
    peers_.check(now);
    for (const health::PeerChange& change : peers_.take_changes()) {
      if (!change.alive) lose(change, now);
    }
    if (!step_ && now > helpers_by_) excuse_missing_helpers();
    if (auto revision = master_.take_revision()) publish(std::move(*revision), now);
    if (master_.awaited().empty()) advance(now);
    note_long_wait(now);
  }

  const std::optional<v1::ClockStep>& step() const override { return step_; }
  void answer(const v1::ClockDone& done) override { master_.done(done); }

  bool stop() override {
    stopping_ = true;
    return step_.has_value();  // before time 0 there is no run to end
  }
  bool over(clock::WallTime now) const override {
    return step_ && step_->last() && (master_.awaited().empty() || now > leave_by_);
  }

  clock::WallTime next_turn(clock::WallTime now) const override {
    const auto window = master_.window();
    if (!window || hold_.holds(master_.missing().empty(), now)) return now + clock::wall_seconds(kIdleTurnS);
    return std::min(pace_.earliest(window->earliest), now + clock::wall_seconds(kIdleTurnS));
  }

 private:
  void lose(const health::PeerChange& change, clock::WallTime now) {
    master_.lost(change.service, change.incarnation, change.cause);
    hold_.lost(change.cause, now);
    const auto helper = helper_deaths_.find(change.service);
    if (helper != helper_deaths_.end() && ++helper->second == kHelperDeaths) excuse(change.service);
  }

  void excuse(const std::string& helper) {
    master_.excuse(helper);
    log::warning("the clock goes on without " + helper + ", which nobody needs");
  }

  void excuse_missing_helpers() {
    for (const std::string& service : master_.missing())
      if (helper_deaths_.contains(service)) excuse(service);
  }

  void advance(clock::WallTime now) {
    if (step_ && step_->last()) return;
    if (stopping_ && step_) return issue_last(now);
    if (hold_.holds(master_.missing().empty(), now)) return;
    const auto window = master_.window();
    if (!window || pace_.earliest(window->earliest) > now) return;
    const temporal::Time time = std::clamp(pace_.time_at(now), window->earliest, window->latest);
    try {
      publish(master_.issue(time), now);
    } catch (const clock::ClockError&) {
      issue_last(now);
      throw;
    }
    pace_.reached(time, now);
  }

  void issue_last(clock::WallTime now) {
    leave_by_ = now + clock::wall_seconds(kLeaveLimitS);
    publish(master_.issue_last(), now);
  }

  void publish(v1::ClockStep step, clock::WallTime now) {
    const auto& participants = step.participants();
    const bool alone = participants.size() == 1 && participants.front() == node_.options.name;
    if (!alone || now >= show_time_) {
      write(step_stream_, step);
      show_time_ = now + clock::wall_seconds(kShowTimeS);
    }
    step_ = std::move(step);
    waiting_since_ = now;
    noted_ = false;
  }

  void note_long_wait(clock::WallTime now) {
    if (noted_ || now - waiting_since_ < clock::wall_seconds(kNoteAfterS)) return;
    noted_ = true;
    if (const auto missing = master_.missing(); !missing.empty()) {
      log::warning("the clock waits for services to start: " + joined(missing));
    } else if (const auto owing = master_.awaited(); !owing.empty()) {
      log::warning("the clock waits at " + std::to_string(master_.time().count()) +
                   " us for: " + joined(owing));
    }
  }

  NodeImpl& node_;
  TopicWriter& step_stream_;
  clock::ClockMaster master_;
  std::map<std::string, int> helper_deaths_;
  health::FailureDetector peers_;
  clock::Pace pace_;
  clock::RestartHold hold_;
  std::optional<v1::ClockStep> step_;
  bool stopping_ = false;
  bool noted_ = false;
  clock::WallTime waiting_since_;
  clock::WallTime helpers_by_ = clock::WallTime::max();  // until then a helper may start
  clock::WallTime show_time_;
  clock::WallTime leave_by_;
};

}  // namespace

std::unique_ptr<Barrier> make_master_barrier(NodeImpl& node) { return std::make_unique<MasterBarrier>(node); }

}  // namespace roci::services::node
