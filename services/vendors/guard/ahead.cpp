#include "services/vendors/guard/ahead.hpp"

#include <algorithm>

#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {
namespace {

// Of a whole sample.
std::uint32_t size_of(const Submessage& data) {
  return data.id == kDataFragment ? data.body.u32(28) : static_cast<std::uint32_t>(data.body.size());
}

}  // namespace

void SamplesAhead::acknowledge(std::span<const std::uint8_t> message) {
  if (message.size() < kHeaderSize) return;
  GuidPrefix destination{};
  for_each_submessage(message, [&](const Submessage& one) {
    if (one.id == kInfoDestination && one.body.size() >= destination.size())
      std::copy_n(one.body.bytes.begin(), destination.size(), destination.begin());
    if (one.id != kAckNack || one.body.size() < 16) return;
    Expected& expected = expected_of({destination, one.body.entity_id(4)}, one.body.entity_id(0));
    forget_up_to(expected, one.body.sequence_number(8));
  });
}

SamplesAhead::Expected& SamplesAhead::expected_of(const Writer& writer, Reader reader) {
  const auto known = writers_.find(writer);
  if (known != writers_.end() && known->second.contains(reader)) return known->second.at(reader);
  if (pairs_ >= kPairs) forget_idle();
  ++pairs_;
  return writers_[writer][reader];
}

void SamplesAhead::forget_idle() {
  for (auto& [writer, readers] : writers_)
    pairs_ -= std::erase_if(readers, [](const auto& one) { return one.second.ahead.empty(); });
  std::erase_if(writers_, [](const auto& one) { return one.second.empty(); });
}

void SamplesAhead::forget_up_to(Expected& expected, std::int64_t next) {
  expected.next = std::max(expected.next, next);
  while (!expected.ahead.empty() && expected.ahead.begin()->first < expected.next) {
    --samples_;
    bytes_ -= expected.ahead.begin()->second;
    expected.ahead.erase(expected.ahead.begin());
  }
}

std::size_t SamplesAhead::take(std::span<std::uint8_t> message, std::size_t& refused) {
  GuidPrefix sender = sender_of(message);
  bool speaks = false;
  const std::size_t left =
      strip_submessages(message, [&](std::span<const std::uint8_t>, const Submessage& one) {
        if (one.id == kInfoSource) std::copy_n(one.body.bytes.begin() + 8, sender.size(), sender.begin());
        const bool admitted = !is_data(one) || admits(sender, one);
        refused += admitted ? 0 : 1;
        speaks = speaks || (admitted && !is_context(one));
        return admitted;
      });
  return speaks ? left : 0;
}

bool SamplesAhead::admits(const GuidPrefix& sender, const Submessage& data) {
  const auto readers = writers_.find({sender, data.body.entity_id(8)});
  if (readers == writers_.end()) return true;
  const Reader only = data.body.entity_id(4);
  const std::int64_t number = data.body.sequence_number(12);
  const std::uint32_t size = size_of(data);
  const auto keeps = [&](const auto& one) {
    const auto& [reader, expected] = one;
    const bool addressed = only == 0 || only == reader;
    return addressed && number > expected.next && !expected.ahead.contains(number);
  };
  const auto times = static_cast<std::size_t>(std::ranges::count_if(readers->second, keeps));
  if (times == 0) return true;
  if (samples_ + times > kMostSamples || bytes_ + times * size > kMostBytes) return false;
  for (auto& one : readers->second)
    if (keeps(one)) one.second.ahead.emplace(number, size);
  samples_ += times;
  bytes_ += times * size;
  return true;
}

void SamplesAhead::gave_up(const GuidPrefix& participant) {
  auto it = writers_.lower_bound({participant, 0});
  while (it != writers_.end() && it->first.first == participant) {
    for (auto& [reader, expected] : it->second) forget_up_to(expected, kHighestNumber + 1);
    pairs_ -= it->second.size();
    it = writers_.erase(it);
  }
}

}  // namespace roci::services::vendors::guard
