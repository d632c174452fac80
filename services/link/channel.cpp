#include "services/link/channel.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/bytes/fnv_1a.hpp"
#include "core/pseudorandom/split_mix.hpp"

namespace roci::services::link {

using temporal::Duration;
using temporal::Time;

namespace {

// Hashes tuples, with a length before each text so that no two tuples run together.
class Hash {
 public:
  void add(std::uint64_t number) { hash_.add_number(number); }
  void add(std::string_view text) { hash_.add_number(text.size()).add(text); }
  // FNV's high bits alone are not uniform.
  std::uint64_t mixed() const { return pseudorandom::SplitMix64(hash_.value()).next(); }

 private:
  bytes::Fnv1a hash_;
};

}  // namespace

double chance(std::uint64_t seed, const std::string& link, const LinkSample& sample, std::uint32_t attempt) {
  Hash hash;
  hash.add(seed);
  hash.add(link);
  hash.add(sample.topic);
  hash.add(sample.sender);
  hash.add(sample.incarnation);
  hash.add(sample.number);
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

bool Channel::offer(LinkSample sample, Time now) {
  run(now);
  const std::uint64_t offer = ++offers_;
  ++counts_.offered;
  if (refuses(sample, now)) {
    ++counts_.lost;
    note(now, sample, 1, Fate::lost);
    return false;
  }
  if (sample.lifetime == Lifetime::newest) supersede(sample, offer, now);
  waiting_.emplace(Order{now, offer}, Waiting{std::move(sample)});
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

bool Channel::refuses(const LinkSample& sample, Time now) const {
  if (flying_.size() + waiting_.size() >= kLongestFlight) return true;
  if (sample.lifetime == Lifetime::newest && newest_.size() >= kLongestFlight &&
      !newest_.contains({sample.topic, {sample.sender, sample.instance}}))
    return true;
  return sample.lifetime == Lifetime::once && (waiting_.size() >= kLongestQueue || !link_->open.open(now));
}

// What is ready first is sent first; the link being closed for it, it is closed for all behind it.
std::optional<Time> Channel::next_start() const {
  if (waiting_.empty()) return std::nullopt;
  const auto& [order, waiting] = *waiting_.begin();
  const Time earliest = std::max(order.first, free_at_);
  const bool dies = waiting.sample.lifetime == Lifetime::once && link_->open.closes(order.first) <= earliest;
  return dies ? std::optional(order.first) : link_->open.next_open(earliest);
}

void Channel::run(Time now) {
  for (auto start = next_start(); start && *start <= now; start = next_start()) {
    auto first = waiting_.extract(waiting_.begin());
    send(first.key(), std::move(first.mapped()), *start);
  }
}

void Channel::send(Order order, Waiting waiting, Time start) {
  const bool once = waiting.sample.lifetime == Lifetime::once;
  if (once && link_->open.closes(order.first) <= std::max(start, free_at_)) {
    ++counts_.lost;
    note(link_->open.closes(order.first), waiting.sample, waiting.attempt, Fate::lost);
    return;
  }
  const Time closes = link_->open.closes(start);
  const Time end = temporal::plus(start, sending_time(waiting.sample));
  free_at_ = std::min(end, closes);
  if (end > closes || chance_loses(waiting)) {
    if (!once) return repeat(order, std::move(waiting), free_at_);
    ++counts_.lost;
    note(free_at_, waiting.sample, waiting.attempt, Fate::lost);
    return;
  }
  flying_.emplace(Order{temporal::plus(end, link_->light_time), order.second}, std::move(waiting.sample));
}

void Channel::repeat(Order order, Waiting waiting, Time ended) {
  const LinkSample& sample = waiting.sample;
  if (newest_[{sample.topic, {sample.sender, sample.instance}}] != order.second) {
    ++counts_.superseded;
    note(ended, sample, waiting.attempt, Fate::superseded);
    return;
  }
  note(ended, sample, waiting.attempt, Fate::repeated);
  const Duration pause =
      std::min(kLongestRepetitionPause, kRepetitionPause * (1 << std::min(waiting.attempt - 1, 8U)));
  ++waiting.attempt;
  ++counts_.repeated;
  const Time ready = temporal::plus(ended, round_trip(*link_) + pause);
  waiting_.emplace(Order{ready, order.second}, std::move(waiting));
}

void Channel::supersede(const LinkSample& newer, std::uint64_t offer, Time now) {
  newest_[{newer.topic, {newer.sender, newer.instance}}] = offer;
  counts_.superseded += std::erase_if(waiting_, [&](const auto& entry) {
    const LinkSample& older = entry.second.sample;
    if (older.lifetime != Lifetime::newest || older.topic != newer.topic || older.sender != newer.sender ||
        older.instance != newer.instance)
      return false;
    note(now, older, entry.second.attempt, Fate::superseded);
    return true;
  });
}

void Channel::note(Time at, const LinkSample& sample, std::uint32_t attempt, Fate fate) {
  if (losses_.size() < kMostLosses) losses_.push_back({at, sample, attempt, fate});
}

std::vector<Loss> Channel::take_losses() { return std::exchange(losses_, {}); }

bool Channel::chance_loses(const Waiting& waiting) const {
  return link_->loss > 0 && chance(seed_, link_->name, waiting.sample, waiting.attempt) < link_->loss;
}

Duration Channel::sending_time(const LinkSample& sample) const {
  if (link_->rate_bit_s <= 0) return Duration{0};
  const double us = std::ceil(8e6 * static_cast<double>(sample.bytes) / link_->rate_bit_s);
  return us < 9e18 ? Duration{static_cast<std::int64_t>(us)} : temporal::no_bound;
}

}  // namespace roci::services::link
