#include "services/clock/hold_back_queue.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "services/bounds/limits.hpp"
#include "services/clock/stream_topic.hpp"

namespace roci::services::clock {
namespace {

StreamKey key_of(const v1::StreamCount& count) {
  return {count.topic(), count.sender(), count.incarnation()};
}

bool in_roster(const v1::ClockStep& step, const v1::StreamCount& count) {
  return std::ranges::any_of(step.roster(), [&](const v1::RosterEntry& entry) {
    return entry.service() == count.sender() && entry.incarnation() == count.incarnation();
  });
}

}  // namespace

void HoldBackQueue::Stream::close_gaps() {
  while (held.contains(received + 1)) ++received;
}

void HoldBackQueue::subscribe(const std::string& topic, Durability durability, KeyOf key_of) {
  inputs_.try_emplace(topic, Input{durability, std::move(key_of)});
}

bool HoldBackQueue::add(const std::string& topic, const v1::SampleHeader& header,
                        std::shared_ptr<const void> value) {
  StreamKey key{topic, header.sender(), header.incarnation()};
  if (streams_.size() >= bounds::kHeldBackStreams && !streams_.contains(key)) return false;
  Stream& stream = streams_[std::move(key)];
  if (header.seq() <= stream.delivered) return true;
  if (stream.held.size() >= bounds::kHeldBackSamples) return false;
  stream.held.emplace(header.seq(), std::move(value));
  stream.close_gaps();
  return true;
}

bool HoldBackQueue::awaited(const v1::ClockStep& step, const v1::StreamCount& count) const {
  const auto input = find_subscription(inputs_, count.topic());
  if (input == inputs_.end() || !in_roster(step, count)) return false;
  return joined_ || input->second.durability == Durability::transient_local;
}

bool HoldBackQueue::has_all(const v1::StreamCount& count) const {
  const auto found = streams_.find(key_of(count));
  if (found == streams_.end()) return count.total() == 0;
  const Stream& stream = found->second;
  if (joined_) return stream.received >= count.total();
  // History has gaps, but comes in order: with its newest sample all of it is here.
  return !stream.held.empty() && stream.held.rbegin()->first >= count.total();
}

bool HoldBackQueue::complete(const v1::ClockStep& step) const {
  return std::ranges::all_of(
      step.totals(), [&](const v1::StreamCount& count) { return !awaited(step, count) || has_all(count); });
}

std::vector<std::string> HoldBackQueue::missing(const v1::ClockStep& step) const {
  std::vector<std::string> streams;
  for (const v1::StreamCount& count : step.totals()) {
    if (!awaited(step, count) || has_all(count)) continue;
    const auto found = streams_.find(key_of(count));
    const std::uint64_t received = found == streams_.end() ? 0 : found->second.received;
    streams.push_back(count.topic() + " " + count.sender() + "#" + std::to_string(count.incarnation()) + " " +
                      std::to_string(received) + "/" + std::to_string(count.total()));
  }
  return streams;
}

std::vector<const v1::StreamCount*> HoldBackQueue::grown(const v1::ClockStep& step) const {
  std::vector<const v1::StreamCount*> counts;
  for (const v1::StreamCount& count : step.totals()) {
    if (find_subscription(inputs_, count.topic()) == inputs_.end()) continue;
    const auto stream = streams_.find(key_of(count));
    if (count.total() > (stream == streams_.end() ? 0 : stream->second.delivered)) counts.push_back(&count);
  }
  std::ranges::sort(counts, {}, [](const v1::StreamCount* count) {
    return std::tuple(topic_of(count->topic()), std::string_view(count->sender()), count->incarnation());
  });
  return counts;
}

std::vector<Delivery> HoldBackQueue::take(const v1::ClockStep& step) {
  std::vector<Delivery> deliveries;
  for (const v1::StreamCount* announced : grown(step)) {
    const v1::StreamCount& count = *announced;
    const StreamKey key = key_of(count);
    Stream& stream = streams_[key];
    if (joined_) {
      deliver(key, stream, count.total(), deliveries);
    } else {
      deliver_history(key, stream, count.total(), deliveries);
    }
    stream.held.erase(stream.held.begin(), stream.held.upper_bound(count.total()));
    stream.delivered = count.total();
    stream.received = std::max(stream.received, stream.delivered);
    stream.close_gaps();
  }
  joined_ = true;
  return deliveries;
}

void HoldBackQueue::deliver(const StreamKey& key, Stream& stream, std::uint64_t total,
                            std::vector<Delivery>& deliveries) const {
  const auto end = stream.held.upper_bound(total);
  for (auto sample = stream.held.begin(); sample != end; ++sample) {
    deliveries.push_back({std::string(topic_of(key.topic)), std::move(sample->second)});
  }
}

void HoldBackQueue::deliver_history(const StreamKey& key, Stream& stream, std::uint64_t total,
                                    std::vector<Delivery>& deliveries) const {
  const Input& input = find_subscription(inputs_, key.topic)->second;
  if (input.durability != Durability::transient_local) return;
  std::set<std::string> seen;
  std::vector<Delivery> newest_first;
  auto sample = stream.held.upper_bound(total);
  while (sample != stream.held.begin()) {
    --sample;
    if (!sample->second) continue;
    const Key instance = input.key_of(sample->second.get());
    if (!seen.emplace(instance.begin(), instance.end()).second) continue;
    newest_first.push_back({std::string(topic_of(key.topic)), std::move(sample->second)});
  }
  deliveries.insert(deliveries.end(), std::make_move_iterator(newest_first.rbegin()),
                    std::make_move_iterator(newest_first.rend()));
}

}  // namespace roci::services::clock
