#include "exec_svc/standby/epochs.hpp"

#include <algorithm>

namespace roci::exec::standby {
namespace {

// Exceeds the epochs in which a member that lost its journal may have led without anybody to tell it.
constexpr std::uint64_t kUntoldEpochs = 100;

// The first member leads in odd epochs, the second in even ones.
bool is_own(Member self, std::uint64_t epoch) { return (epoch % 2 == 1) == (self == Member::first); }

// Returns the next epoch after `highest` of a member's own.
std::uint64_t next_epoch(Member self, std::uint64_t highest) {
  return is_own(self, highest + 1) ? highest + 1 : highest + 2;
}

}  // namespace

bool Epochs::believable(std::uint64_t epoch) const {
  const std::uint64_t known = persisted_.epoch;
  return known == 0 || epoch <= known || epoch - known <= kJump;
}

bool Epochs::note(std::uint64_t epoch) {
  if (epoch <= persisted_.epoch) return false;
  persisted_ = {epoch, false, persisted_.holds};
  return true;
}

bool Epochs::note_of_owner(std::uint64_t epoch) { return note(std::min(epoch, persisted_.epoch + kJump)); }

bool Epochs::note_led(std::uint64_t epoch) {
  if (is_own(self_, epoch)) return false;
  if (own_ == 0) {
    told_ = std::max(told_, epoch);
    return false;
  }
  if (epoch >= own_ || epoch <= persisted_.holds) return false;
  unknown_ = epoch;
  return note(own_ + 1);
}

std::uint64_t Epochs::next(bool has_lost_all) const {
  return next_epoch(self_, persisted_.epoch + (has_lost_all ? kUntoldEpochs : 0));
}

bool Epochs::lead(std::uint64_t epoch, const journal::Position& newest, bool doubtful) {
  std::uint64_t holds = persisted_.holds;
  if (!is_own(self_, newest.epoch)) holds = std::max(holds, newest.epoch);
  doubtful = doubtful || persisted_.epoch > newest.epoch || told_ > holds;
  if (doubtful) holds = std::max({holds, told_, persisted_.epoch});
  own_ = epoch;
  persisted_ = {epoch, true, holds};
  return doubtful;
}

}  // namespace roci::exec::standby
