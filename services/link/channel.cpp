#include "services/link/channel.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::services::link {

using temporal::Duration;
using temporal::Time;

namespace {

// FNV-1a, the same on every machine, with a length before each text so that no two tuples run together.
class Hash {
 public:
  void add(std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) add_byte(static_cast<unsigned char>(number >> (8 * byte)));
  }
  void add(std::string_view text) {
    add(text.size());
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
  }
  // FNV's high bits alone are not uniform.
  std::uint64_t mixed() const { return pseudorandom::SplitMix64(value_).next(); }

 private:
  void add_byte(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211ULL; }
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace

double chance(std::uint64_t seed, const std::string& link, const Passenger& passenger,
              std::uint32_t attempt) {
  Hash hash;
  hash.add(seed);
  hash.add(link);
  hash.add(passenger.topic);
  hash.add(passenger.sender);
  hash.add(passenger.incarnation);
  hash.add(passenger.number);
  hash.add(attempt);
  return static_cast<double>(hash.mixed() >> 11) * 0x1.0p-53;
}

Counts& Counts::operator+=(const Counts& other) {
  offered += other.offered;
  arrived += other.arrived;
  lost += other.lost;
  superseded += other.superseded;
  under_way += other.under_way;
  repeated += other.repeated;
  return *this;
}

Counts Channel::counts() const {
  Counts out = counts_;
  out.under_way = waiting_.size() + flying_.size();
  return out;
}

bool Channel::offer(Passenger passenger, Time now) {
  run(now);
  const std::uint64_t offer = ++offers_;
  ++counts_.offered;
  if (refuses(passenger, now)) {
    ++counts_.lost;
    note(now, passenger, 1, Fate::lost);
    return false;
  }
  if (passenger.lifetime == Lifetime::newest) supersede(passenger, offer, now);
  waiting_.emplace(Order{now, offer}, Waiting{std::move(passenger)});
  run(now);
  if (flying_.erase({now, offer}) == 0) return false;
  ++counts_.arrived;
  return true;
}

std::vector<Channel::Arrival> Channel::take(Time now) {
  run(now);
  std::vector<Arrival> out;
  while (!flying_.empty() && flying_.begin()->first.first <= now) {
    auto first = flying_.extract(flying_.begin());
    out.push_back({first.key().first, std::move(first.mapped())});
    ++counts_.arrived;
  }
  return out;
}

std::optional<Time> Channel::next() const {
  std::optional<Time> next = next_start();
  if (!flying_.empty()) {
    const Time arrival = flying_.begin()->first.first;
    next = next ? std::min(*next, arrival) : arrival;
  }
  return next;
}

bool Channel::refuses(const Passenger& passenger, Time now) const {
  if (flying_.size() + waiting_.size() >= kLongestFlight) return true;
  if (passenger.lifetime == Lifetime::newest && newest_.size() >= kLongestFlight &&
      !newest_.contains({passenger.topic, {passenger.sender, passenger.instance}}))
    return true;
  return passenger.lifetime == Lifetime::once && (waiting_.size() >= kLongestQueue || !link_->open.open(now));
}

// What is ready first is sent first; the link being closed for it, it is closed for all behind it.
std::optional<Time> Channel::next_start() const {
  if (waiting_.empty()) return std::nullopt;
  const auto& [order, waiting] = *waiting_.begin();
  const Time earliest = std::max(order.first, free_at_);
  const bool dies =
      waiting.passenger.lifetime == Lifetime::once && link_->open.closes(order.first) <= earliest;
  return dies ? std::optional(order.first) : link_->open.next_open(earliest);
}

void Channel::run(Time now) {
  for (auto start = next_start(); start && *start <= now; start = next_start()) {
    auto first = waiting_.extract(waiting_.begin());
    send(first.key(), std::move(first.mapped()), *start);
  }
}

void Channel::send(Order order, Waiting waiting, Time start) {
  const bool once = waiting.passenger.lifetime == Lifetime::once;
  if (once && link_->open.closes(order.first) <= std::max(start, free_at_)) {
    ++counts_.lost;
    note(link_->open.closes(order.first), waiting.passenger, waiting.attempt, Fate::lost);
    return;
  }
  const Time closes = link_->open.closes(start);
  const Time end = temporal::plus(start, sending_time(waiting.passenger));
  free_at_ = std::min(end, closes);
  if (end > closes || chance_loses(waiting)) {
    if (!once) return repeat(order, std::move(waiting), free_at_);
    ++counts_.lost;
    note(free_at_, waiting.passenger, waiting.attempt, Fate::lost);
    return;
  }
  flying_.emplace(Order{temporal::plus(end, link_->light_time), order.second}, std::move(waiting.passenger));
}

void Channel::repeat(Order order, Waiting waiting, Time ended) {
  const Passenger& passenger = waiting.passenger;
  if (newest_[{passenger.topic, {passenger.sender, passenger.instance}}] != order.second) {
    ++counts_.superseded;
    note(ended, passenger, waiting.attempt, Fate::superseded);
    return;
  }
  note(ended, passenger, waiting.attempt, Fate::repeated);
  const Duration pause =
      std::min(kLongestRepetitionPause, kRepetitionPause * (1 << std::min(waiting.attempt - 1, 8U)));
  ++waiting.attempt;
  ++counts_.repeated;
  const Time ready = temporal::plus(ended, round_trip(*link_) + pause);
  waiting_.emplace(Order{ready, order.second}, std::move(waiting));
}

void Channel::supersede(const Passenger& newer, std::uint64_t offer, Time now) {
  newest_[{newer.topic, {newer.sender, newer.instance}}] = offer;
  counts_.superseded += std::erase_if(waiting_, [&](const auto& entry) {
    const Passenger& older = entry.second.passenger;
    if (older.lifetime != Lifetime::newest || older.topic != newer.topic || older.sender != newer.sender ||
        older.instance != newer.instance)
      return false;
    note(now, older, entry.second.attempt, Fate::superseded);
    return true;
  });
}

void Channel::note(Time at, const Passenger& passenger, std::uint32_t attempt, Fate fate) {
  if (losses_.size() < kMostLosses) losses_.push_back({at, passenger, attempt, fate});
}

std::vector<Loss> Channel::take_losses() { return std::exchange(losses_, {}); }

bool Channel::chance_loses(const Waiting& waiting) const {
  return link_->loss > 0 && chance(seed_, link_->name, waiting.passenger, waiting.attempt) < link_->loss;
}

Duration Channel::sending_time(const Passenger& passenger) const {
  if (link_->rate_bit_s <= 0) return Duration{0};
  const double us = std::ceil(8e6 * static_cast<double>(passenger.bytes) / link_->rate_bit_s);
  return us < 9e18 ? Duration{static_cast<std::int64_t>(us)} : temporal::no_bound;
}

}  // namespace roci::services::link
