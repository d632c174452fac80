#include "exec_svc/standby/journal_feed.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::standby {

using journal::Batch;
using journal::Position;

namespace {

constexpr std::size_t kMostBatches = 4096;  // kept for a follower that comes back
constexpr std::size_t kMostBytes = 16 * 1024 * 1024;
constexpr std::uint64_t kBatchesUnderWay = 256;
constexpr std::uint32_t kPartsUnderWay = 4;
constexpr JournalFeed::Moment kAgainAfter = std::chrono::milliseconds(500);

}  // namespace

JournalFeed::JournalFeed(std::uint64_t epoch, const Position& newest)
    : epoch_(epoch), newest_(newest), oldest_after_(newest) {}

void JournalFeed::add(Batch batch) {
  Chunk chunk{epoch_, batch.after, batch.at, 0, 0, 0, std::move(batch.changes)};
  chunk.checksum = checksum(chunk);
  newest_ = chunk.at;
  kept_bytes_ += chunk.bytes.size();
  kept_.push_back(std::move(chunk));
  while (kept_.size() > kMostBatches || (kept_bytes_ > kMostBytes && kept_.size() > 1)) {
    kept_bytes_ -= kept_.front().bytes.size();
    oldest_after_ = kept_.front().at;
    kept_.pop_front();
  }
}

void JournalFeed::hear(const Position& has, const TransferProgress& arrival, Moment now) {
  if (!heard_ || has != has_ || arrival != arrival_) moved_at_ = now;
  if (!heard_ || has < has_) sent_ = has.sequence;  // another start of it
  heard_ = true;
  has_ = has;
  arrival_ = arrival;
  sent_ = std::max(sent_, has_.sequence);
}

bool JournalFeed::keeps(const Position& has) const {
  if (has == oldest_after_) return true;
  return has.epoch == epoch_ && has.sequence > oldest_after_.sequence && has.sequence <= newest_.sequence;
}

std::vector<Chunk> JournalFeed::due(Moment now, const std::function<std::string()>& whole) {
  if (!heard_ || has_ == newest_) return {};
  if (now - moved_at_ >= kAgainAfter) {
    moved_at_ = now;
    sent_ = has_.sequence;
    sent_parts_ = 0;
  }
  if (!keeps(has_)) return next_parts(whole);
  if (!parts_.empty()) sent_ = has_.sequence;
  parts_.clear();
  return next_batches();
}

std::vector<Chunk> JournalFeed::next_batches() {
  const std::uint64_t until = std::min(newest_.sequence, has_.sequence + kBatchesUnderWay);
  std::vector<Chunk> out;
  for (; sent_ < until; ++sent_) {
    const std::uint64_t index = sent_ - oldest_after_.sequence;  // of the batch after it
    out.push_back(kept_.at(index));
  }
  return out;
}

std::vector<Chunk> JournalFeed::next_parts(const std::function<std::string()>& whole) {
  if (parts_.empty() || has_ == parts_.front().at) {
    parts_ = split(epoch_, newest_, whole());
    sent_parts_ = 0;
  }
  const std::uint32_t arrived = arrival_.at == parts_.front().at ? arrival_.parts : 0;
  sent_parts_ = std::max(sent_parts_, arrived);
  const auto until = std::min(static_cast<std::uint32_t>(parts_.size()), arrived + kPartsUnderWay);
  std::vector<Chunk> out;
  for (; sent_parts_ < until; ++sent_parts_) out.push_back(parts_[sent_parts_]);
  return out;
}

}  // namespace roci::exec::standby
