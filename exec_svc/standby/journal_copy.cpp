#include "exec_svc/standby/journal_copy.hpp"

#include <utility>

namespace roci::exec::standby {

using journal::DiskError;
using journal::JournalError;
using journal::kForkedHistory;

JournalCopy::Result JournalCopy::take(const Chunk& chunk, std::uint64_t epoch) {
  if (chunk.checksum != checksum(chunk)) return Result::corrupt;
  if (chunk.leader < epoch) return Result::old;
  return chunk.parts == 0 ? take_batch(chunk) : take_part(chunk);
}

JournalCopy::Result JournalCopy::take_batch(const Chunk& chunk) {
  if (chunk.at.epoch == has_.epoch && chunk.at.sequence <= has_.sequence) return Result::known;
  if (chunk.after != has_) return Result::gap;
  try {
    journal_->apply({chunk.after, chunk.at, chunk.bytes});
  } catch (const JournalError&) {
    has_ = kForkedHistory;
    return Result::corrupt;
  }
  has_ = chunk.at;
  return Result::batch;
}

JournalCopy::Result JournalCopy::forget_arrival() {
  arrival_ = {};
  std::string().swap(arriving_);
  return Result::excess;
}

JournalCopy::Result JournalCopy::take_part(const Chunk& chunk) {
  if (has_ == chunk.at) return Result::known;
  if (chunk.parts > kJournalCopyBytes / kPartBytes || chunk.bytes.size() > kPartBytes)
    return forget_arrival();
  if (chunk.part == 0 && (arrival_.at != chunk.at || arrival_.parts == 0)) {
    arrival_ = {chunk.at, 0};
    announced_ = chunk.parts;
    arriving_.clear();
  }
  if (arrival_.at != chunk.at || chunk.part > arrival_.parts) return Result::gap;
  if (chunk.part < arrival_.parts) return Result::known;
  if (chunk.parts != announced_) return forget_arrival();
  arriving_ += chunk.bytes;
  if (++arrival_.parts < announced_) return Result::part;
  const std::string whole = std::exchange(arriving_, {});
  arrival_ = {};
  try {
    if (before_replacement_) before_replacement_();
  } catch (const DiskError&) {
    return Result::unwritten;
  }
  try {
    journal_->replace_with(whole);
  } catch (const DiskError&) {
    return Result::unwritten;
  } catch (const JournalError&) {
    return Result::corrupt;
  }
  has_ = journal_->position();
  return Result::whole;
}

}  // namespace roci::exec::standby
