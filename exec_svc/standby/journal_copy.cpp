#include "exec_svc/standby/journal_copy.hpp"

#include <utility>

namespace roci::exec::standby {

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

JournalCopy::Result JournalCopy::take_part(const Chunk& chunk) {
  if (has_ == chunk.at) return Result::known;
  if (chunk.part == 0 && (arrival_.at != chunk.at || arrival_.parts == 0)) {
    arrival_ = {chunk.at, 0};
    arriving_.clear();
  }
  if (arrival_.at != chunk.at || chunk.part > arrival_.parts) return Result::gap;
  if (chunk.part < arrival_.parts) return Result::known;
  arriving_ += chunk.bytes;
  if (++arrival_.parts < chunk.parts) return Result::part;
  const std::string whole = std::exchange(arriving_, {});
  arrival_ = {};
  if (before_replacement_) before_replacement_();
  try {
    journal_->replace_with(whole);
  } catch (const JournalError&) {
    return Result::corrupt;
  }
  has_ = journal_->position();
  return Result::whole;
}

}  // namespace roci::exec::standby
