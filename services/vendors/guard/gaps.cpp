#include "services/vendors/guard/gaps.hpp"

#include <algorithm>

#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {

SkippedNumbers& SkippedNumbers::operator+=(const SkippedNumbers& more) {
  from_start += more.from_start;
  further_up += more.further_up;
  starts.insert(starts.end(), more.starts.begin(), more.starts.end());
  return *this;
}

SkippedNumbers skipped_by(const Submessage& message) {
  if (message.id == kHeartbeat) {
    const std::int64_t first = message.body.sequence_number(8);
    if (first <= SkippedNumbers::kFreeStart) return {};
    return {.starts = {{message.body.entity_id(4), first}}};
  }
  if (message.id != kGap || message.body.size() < 28) return {};
  const std::int64_t start = message.body.sequence_number(8), base = message.body.sequence_number(16);
  // More than is ever let through counts as just that much, so that no sum overflows.
  const std::int64_t before_base =
      std::clamp(base - start, std::int64_t{0}, SkippedNumbers::kMostFromStart + 1);
  const std::int64_t bits = message.body.u32(24);
  return start == 1 ? SkippedNumbers{before_base, bits, {}} : SkippedNumbers{0, before_base + bits, {}};
}

GapBudget::Spent GapBudget::Spent::by(Time now) const {
  const double seconds = std::chrono::duration<double>(now - at).count();
  return {std::max(0., from_start - seconds * static_cast<double>(kPerSecond.from_start)),
          std::max(0., further_up - seconds * static_cast<double>(kPerSecond.further_up)), now};
}

bool GapBudget::take(const Source& source, const GuidPrefix& sender, const SkippedNumbers& numbers,
                     Time now) {
  if (numbers.none()) return true;
  if (numbers.starts.size() > kStarts) return false;
  std::int64_t walked = 0;
  const auto known = starts_.find(source);
  for (const WriterStart& start : numbers.starts) {
    std::int64_t from = SkippedNumbers::kFreeStart;
    if (known != starts_.end()) {
      const auto before = known->second.firsts.find({sender, start.writer});
      if (before != known->second.firsts.end()) from = before->second;
    }
    walked += kCostOfStart * std::clamp(start.first - from, std::int64_t{0}, kBurst.from_start + 1);
    if (walked > kBurst.from_start) return false;
  }
  std::erase_if(spent_, [now](const auto& one) {
    const Spent left = one.second.by(now);
    return left.from_start == 0 && left.further_up == 0;
  });
  const auto found = spent_.find(source);
  Spent spent = found == spent_.end() ? Spent{0, 0, now} : found->second.by(now);
  spent.from_start += static_cast<double>(numbers.from_start + walked);
  spent.further_up += static_cast<double>(numbers.further_up);
  const bool fits = spent.from_start <= static_cast<double>(kBurst.from_start) &&
                    spent.further_up <= static_cast<double>(kBurst.further_up);
  if (!fits) return false;
  if (spent.from_start > 0 || spent.further_up > 0) spent_[source] = spent;
  if (!numbers.starts.empty()) remember(source, sender, numbers, now);
  return true;
}

void GapBudget::remember(const Source& source, const GuidPrefix& sender, const SkippedNumbers& numbers,
                         Time now) {
  if (!starts_.contains(source) && starts_.size() >= kSockets)
    starts_.erase(std::ranges::min_element(starts_, {}, [](const auto& one) { return one.second.heard; }));
  Starts& of = starts_[source];
  of.heard = now;
  if (of.firsts.size() + numbers.starts.size() > kStarts) of.firsts.clear();
  for (const WriterStart& start : numbers.starts) {
    std::int64_t& first = of.firsts[{sender, start.writer}];
    first = std::max(first, start.first);
  }
}

}  // namespace roci::services::vendors::guard
