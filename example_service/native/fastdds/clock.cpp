#include "clock.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "clockPubSubTypes.h"
#include "healthPubSubTypes.h"

namespace borehole {
namespace {

using namespace std::chrono_literals;

// "roci/command" of senders without a robot, "roci/command@miner" of the robot's.
std::string stream_of(const std::string& topic, const std::string& robot) {
  return robot.empty() ? topic : topic + "@" + robot;
}

std::string topic_of(const std::string& stream) { return stream.substr(0, stream.find('@')); }

void notify_launcher() {
  constexpr std::string_view alive = "READY=1\nWATCHDOG=1";
  const char* given = std::getenv("NOTIFY_SOCKET");
  const std::string_view address = given == nullptr ? "" : given;
  sockaddr_un name{};
  if (address.empty() || address.size() >= sizeof name.sun_path) return;
  name.sun_family = AF_UNIX;
  address.copy(name.sun_path, address.size());
  if (address[0] == '@') name.sun_path[0] = '\0';
  const int notify = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sendto(notify, alive.data(), alive.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&name),
         static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address.size()));
  close(notify);
}

auto order(const v1::ClockStep& step) {
  return std::tuple(step.time_us(), step.micro_step(), step.revision());
}

}  // namespace

Clock::Clock(Participant& participant) : participant_(participant), options_(participant.options()) {
  heartbeat_ = participant.output<v1::HeartbeatPubSubType>("roci/heartbeat", Durability::state, false);
  if (!options_.simulated) return;
  ready_ = participant.output<v1::ClockReadyPubSubType>("roci/clock/ready", Durability::state, false);
  done_ = participant.output<v1::ClockDonePubSubType>("roci/clock/done", Durability::state, false);
  steps_ = participant.input<v1::ClockStepPubSubType>("roci/clock/step", Durability::state, false);
}

std::int64_t Clock::now_us() const {
  if (options_.simulated) return simulated_us_;
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  const double unix_s = std::chrono::duration<double>(since).count();
  return static_cast<std::int64_t>((unix_s - options_.epoch_s) * options_.scale * 1e6);
}

// Simulated: held back. Live: handled at once.
void Clock::arrive(Arrival arrival) {
  const v1::SampleHeader& header = arrival.header;
  if (header.run() != options_.run) return;
  if (!options_.simulated) return arrival.handle();
  if (header.incarnation() == 0) return outside_.push_back(std::move(arrival));
  const StreamKey key{stream_of(arrival.topic, header.robot()), header.sender(), header.incarnation()};
  if (header.seq() > delivered_[key]) held_[key].emplace(header.seq(), std::move(arrival));
}

// A sign of life for everybody, and one for the launcher, from the loop itself.
void Clock::beat(bool stopping) {
  ++progress_;
  const auto now = std::chrono::steady_clock::now();
  if (!stopping && now < next_beat_) return;
  next_beat_ = now + 250ms;
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  v1::Heartbeat beat;
  beat.run(options_.run);
  beat.service(options_.name);
  beat.mission(options_.mission);
  beat.robot(options_.robot);
  beat.incarnation(options_.incarnation);
  beat.progress(progress_);
  beat.state(stopping ? v1::SERVICE_STOPPING : v1::SERVICE_RUNNING);
  beat.dds("fastdds");
  beat.host(host);
  beat.process_id(getpid());
  heartbeat_.writer->write(&beat);
  notify_launcher();
}

void Clock::say_ready() {
  const auto now = std::chrono::steady_clock::now();
  if (admitted_ || now < next_ready_) return;
  next_ready_ = now + 1s;
  v1::ClockReady ready;
  ready.run(options_.run);
  ready.service(options_.name);
  ready.incarnation(options_.incarnation);
  for (const std::string& topic : topics_) {
    ready.subscriptions().push_back(topic);
    ready.subscriptions().push_back(stream_of(topic, options_.robot));
  }
  ready_.writer->write(&ready);
}

void Clock::take_steps() {
  dds::SampleInfo info;
  for (v1::ClockStep next; steps_->take_next_sample(&next, &info) == ReturnCode_t::RETCODE_OK;) {
    // The end of an instance comes without its key; a run has one master.
    if (!info.valid_data) master_gone_ = master_gone_ || step_.has_value();
    if (info.valid_data && next.run() == options_.run && (!step_ || order(next) > order(*step_)))
      step_ = next;
  }
}

bool Clock::listed(const std::string& service, std::uint32_t incarnation) const {
  return std::ranges::any_of(step_->roster(), [&](const v1::RosterEntry& entry) {
    return entry.service() == service && entry.incarnation() == incarnation;
  });
}

bool Clock::asks_me() const {
  if (answered_ && answered_->time_us() == step_->time_us() && answered_->micro_step() == step_->micro_step())
    return false;
  return std::ranges::find(step_->participants(), options_.name) != step_->participants().end() &&
         listed(options_.name, options_.incarnation);
}

bool Clock::hears(const v1::StreamCount& count) const {
  return std::ranges::any_of(topics_, [&](const std::string& topic) {
    return count.topic() == topic || count.topic() == stream_of(topic, options_.robot);
  });
}

// Everything that the step announces is here. In its first step a service waits for the past of state topics alone, and
// gets the newest of each key; a drill reads none.
bool Clock::complete() const {
  return std::ranges::all_of(step_->totals(), [&](const v1::StreamCount& count) {
    if (!joined_ || !hears(count) || !listed(count.sender(), count.incarnation())) return true;
    const StreamKey key{count.topic(), count.sender(), count.incarnation()};
    const auto done = delivered_.find(key);
    std::uint64_t here = done == delivered_.end() ? 0 : done->second;
    const auto held = held_.find(key);
    if (held != held_.end())
      while (here < count.total() && held->second.contains(here + 1)) ++here;
    return here >= count.total();
  });
}

// In the order (topic, sender, incarnation, number); then what observers said, as it came.
void Clock::deliver() {
  std::map<StreamKey, std::vector<Arrival>> due;
  for (const v1::StreamCount& count : step_->totals()) {
    if (!hears(count)) continue;
    const StreamKey key{count.topic(), count.sender(), count.incarnation()};
    auto& samples = held_[key];
    const auto end = samples.upper_bound(count.total());
    auto& stream = due[{topic_of(count.topic()), count.sender(), count.incarnation()}];
    for (auto sample = samples.begin(); joined_ && sample != end; ++sample)
      stream.push_back(std::move(sample->second));
    samples.erase(samples.begin(), end);
    delivered_[key] = count.total();
  }
  for (const auto& [stream, samples] : due)
    for (const Arrival& sample : samples) sample.handle();
  for (const Arrival& sample : std::exchange(outside_, {}))
    if (joined_) sample.handle();
  joined_ = true;
}

void Clock::answer() {
  v1::ClockDone done;
  done.run(options_.run);
  done.service(options_.name);
  done.incarnation(options_.incarnation);
  done.time_us(step_->time_us());
  done.micro_step(step_->micro_step());
  for (auto& [topic, output] : outputs_) {
    if (output.total == output.reported) continue;
    output.reported = output.total;
    v1::StreamCount count;
    count.topic(stream_of(topic, options_.robot));
    count.sender(options_.name);
    count.incarnation(options_.incarnation);
    count.total(output.total);
    done.sent().push_back(count);
  }
  const auto next = next_us();
  done.wish_us(next ? std::max(*next, step_->time_us()) : -1);
  done_.writer->write(&done);
  answered_ = done;
  asked_ = false;
}

void Clock::follow() {
  if (!step_) return;
  const bool is_listed = listed(options_.name, options_.incarnation);
  if (admitted_ && !is_listed) throw std::runtime_error("the clock's master dropped it from the run");
  admitted_ = is_listed;
  if (asks_me()) {
    if (!step_->last()) {
      if (!complete()) return;
      simulated_us_ = step_->time_us();
      deliver();
      wake();
    }
    answer();
  } else if (answered_ && !asked_ && !outside_.empty()) {
    asked_ = true;  // an observer said something: ask for a step to act on it
    v1::ClockDone again = *answered_;
    again.sent().clear();
    again.wish_us(simulated_us_);
    done_.writer->write(&again);
  }
}

int Clock::run(const volatile std::sig_atomic_t& stop) {
  while (stop == 0) {
    participant_.inbox().wait(options_.simulated ? 100ms : 10ms);
    for (const auto& take : takers_) take();
    beat(false);
    if (options_.simulated) {
      take_steps();
      say_ready();
      follow();
      if (step_ && step_->last()) break;
      if (master_gone_) return 4;
    } else if (const auto next = next_us(); next && *next <= now_us()) {
      wake();
    }
  }
  beat(true);
  return 0;
}

}  // namespace borehole
