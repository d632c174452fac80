// The follower's side: a journal that takes another one's batches, each once, in order, unharmed.
#pragma once

#include <cstdint>
#include <string>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/parcel.hpp"

namespace roci::exec::standby {

class JournalCopy {
 public:
  explicit JournalCopy(journal::Journal& journal) : journal_(&journal), has_(journal.position()) {}

  enum class Taken {
    batch,    // it is in the journal, on the disk
    part,     // of a whole journal that is not complete
    whole,    // complete: the journal is the leader's now
    known,    // this journal has it
    gap,      // something before it is missing, or this journal has another past
    corrupt,  // refused
    old,      // of a leader whose epoch is over; refused
  };
  // `epoch`: the latest that the follower knows of.
  Taken take(const Parcel& parcel, std::uint64_t epoch);

  // kOwnPast after a batch that does not fit, though its position does: the whole journal is wanted then.
  const journal::Position& has() const { return has_; }
  const Arrival& arrival() const { return arrival_; }

 private:
  Taken take_batch(const Parcel& parcel);
  Taken take_part(const Parcel& parcel);

  journal::Journal* journal_;
  journal::Position has_;
  Arrival arrival_;
  std::string arriving_;
};

}  // namespace roci::exec::standby
