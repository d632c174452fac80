// The journal copy is the follower's side: a journal that takes another one's batches, each once, in order,
// unharmed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/chunk.hpp"

namespace roci::exec::standby {

/// Bounds the bytes of a leader's whole journal that a follower takes in, which keeps them in memory until all have
/// come: a hundred times what a mission of a month leaves (bench/endurance).
inline constexpr std::size_t kJournalCopyBytes = std::size_t{256} << 20;

/// Takes only what fits on the journal as it is, or a whole journal in its place. Of a whole one that arrives it keeps
/// kJournalCopyBytes at most, whatever comes.
class JournalCopy {
 public:
  /// `before_replacement` is called with the journal complete, right before another one takes its place. Where it
  /// throws DiskError, the journal stays, and what came is wanted again; all else that it throws passes through.
  explicit JournalCopy(journal::Journal& journal, std::function<void()> before_replacement = nullptr)
      : journal_(&journal), has_(journal.position()), before_replacement_(std::move(before_replacement)) {}

  enum class Result {
    batch,    ///< it is in the journal, on the disk
    part,     ///< it belongs to a whole journal that is not complete
    whole,    ///< complete: the journal is the leader's now
    known,    ///< this journal has it
    gap,      ///< something before it is missing, or this journal has another past
    corrupt,  ///< refused
    excess,  ///< more than there is room for, or than was announced: refused, and all of that journal forgotten
    old,     ///< its leader's epoch is over; refused
    unwritten,  ///< complete, but the disk does not take it, or what is to be kept of the journal it replaces
  };
  /// Takes a chunk; `epoch` is the latest that the follower knows of.
  Result take(const Chunk& chunk, std::uint64_t epoch);

  /// Returns how far the copy has come. It is kForkedHistory after a batch that does not fit, though its position
  /// does: the whole journal is wanted then.
  const journal::Position& has() const { return has_; }
  const TransferProgress& arrival() const { return arrival_; }

 private:
  Result take_batch(const Chunk& chunk);
  Result take_part(const Chunk& chunk);
  Result forget_arrival();

  journal::Journal* journal_;
  journal::Position has_;
  TransferProgress arrival_;
  std::uint32_t announced_ = 0;  ///< parts of the journal that arrives
  std::string arriving_;
  std::function<void()> before_replacement_;
};

}  // namespace roci::exec::standby
