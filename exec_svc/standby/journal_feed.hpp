// The journal feed is the leader's side of the journal's copy: it says which chunks the follower is to get
// next, from what the follower says that it has, and sends again from there when nothing moves. It is pure.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "exec_svc/standby/chunk.hpp"

namespace roci::exec::standby {

/// Keeps the newest batches; a follower that lacks an older one gets the whole journal.
class JournalFeed {
 public:
  using Moment = std::chrono::microseconds;

  /// Takes the `newest` position of the journal when the epoch begins.
  JournalFeed(std::uint64_t epoch, const journal::Position& newest);

  void add(journal::Batch batch);
  const journal::Position& newest() const { return newest_; }

  /// Takes in what the follower says that it has, in its journal and of a whole one under way.
  void hear(const journal::Position& has, const TransferProgress& arrival, Moment now);

  /// Returns what to send now, in order. `whole` gives the whole journal as it is now, at newest().
  std::vector<Chunk> due(Moment now, const std::function<std::string()>& whole);

 private:
  bool keeps(const journal::Position& has) const;
  std::vector<Chunk> next_batches();
  std::vector<Chunk> next_parts(const std::function<std::string()>& whole);

  std::uint64_t epoch_;
  journal::Position newest_;
  journal::Position oldest_after_;  ///< is where the journal stood before the oldest batch kept
  std::deque<Chunk> kept_;          ///< batches of this epoch, without gaps up to newest_
  std::size_t kept_bytes_ = 0;

  bool heard_ = false;
  journal::Position has_;
  TransferProgress arrival_;
  Moment moved_at_{0};        ///< the follower's, or the last time that all was sent again
  std::uint64_t sent_ = 0;    ///< sequence up to which batches are under way
  std::vector<Chunk> parts_;  ///< belong to the whole journal under way
  std::uint32_t sent_parts_ = 0;
};

}  // namespace roci::exec::standby
