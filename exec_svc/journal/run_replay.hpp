// A run replay decides a whole run again, from its journal.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/journal/replay.hpp"

namespace roci::exec::journal {

/// Says how the replay of a whole run went. Times are mission times.
struct RunReplay {
  std::size_t turns = 0;
  std::size_t decisions = 0;
  std::size_t restarts = 0;  ///< restarts of the executive in that run
  temporal::Time from{0};    ///< time of the first inputs; later than 0 where older ones were forgotten
  temporal::Time until{0};
  std::optional<Divergence> divergence;
  std::string trace_sha256;     ///< as journaled
  std::string replayed_sha256;  ///< with what was decided now; up to the divergence, if there is one
};

/// Replays a run with the `mission` as it was then; a changed one may diverge like changed code. Throws
/// ArchiveError for a snapshot that this code cannot read.
RunReplay replay_run(const Journal& journal, const mission::MissionModel& mission);

}  // namespace roci::exec::journal
