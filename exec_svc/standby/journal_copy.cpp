#include "exec_svc/standby/journal_copy.hpp"

#include <utility>

namespace roci::exec::standby {

using journal::JournalError;
using journal::kOwnPast;

JournalCopy::Taken JournalCopy::take(const Parcel& parcel, std::uint64_t epoch) {
  if (parcel.checksum != checksum(parcel)) return Taken::corrupt;
  if (parcel.leader < epoch) return Taken::old;
  return parcel.parts == 0 ? take_batch(parcel) : take_part(parcel);
}

JournalCopy::Taken JournalCopy::take_batch(const Parcel& parcel) {
  if (parcel.at.epoch == has_.epoch && parcel.at.sequence <= has_.sequence) return Taken::known;
  if (parcel.after != has_) return Taken::gap;
  try {
    journal_->apply({parcel.after, parcel.at, parcel.bytes});
  } catch (const JournalError&) {
    has_ = kOwnPast;
    return Taken::corrupt;
  }
  has_ = parcel.at;
  return Taken::batch;
}

JournalCopy::Taken JournalCopy::take_part(const Parcel& parcel) {
  if (has_ == parcel.at) return Taken::known;
  if (parcel.part == 0 && (arrival_.at != parcel.at || arrival_.parts == 0)) {
    arrival_ = {parcel.at, 0};
    arriving_.clear();
  }
  if (arrival_.at != parcel.at || parcel.part > arrival_.parts) return Taken::gap;
  if (parcel.part < arrival_.parts) return Taken::known;
  arriving_ += parcel.bytes;
  if (++arrival_.parts < parcel.parts) return Taken::part;
  const std::string whole = std::exchange(arriving_, {});
  arrival_ = {};
  try {
    journal_->become(whole);
  } catch (const JournalError&) {
    return Taken::corrupt;
  }
  has_ = journal_->position();
  return Taken::whole;
}

}  // namespace roci::exec::standby
