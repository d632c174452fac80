// A journaled reactor's inputs and decisions stand in the journal before anything leaves it, so that whoever
// opens the journal after a crash goes on exactly where it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/journal/replay.hpp"
#include "exec_svc/journal/trace.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::journal {

/// Says what was found in the journal.
struct Recovery {
  bool restarted = false;   ///< an earlier start left something
  bool resumed = false;     ///< its state is back; else only its goals are, and all is planned anew
  std::size_t turns = 0;    ///< replayed since the last anchor
  temporal::Time until{0};  ///< time of the newest record that was replayed
  std::optional<Divergence> divergence;     ///< why it was not resumed
  std::vector<reactor::Event> last_events;  ///< those of the newest turn, which may not have been sent
};

/// Steps a reactor, and makes inputs and decisions durable before it returns them.
class JournaledReactor {
 public:
  /// Recovers the reactor from the journal; both arguments must outlive this object. If `doubtful`, another
  /// executive may have gone on from this journal: its goals count, all else is planned anew, under plan
  /// numbers that nobody used. Throws JournalError.
  JournaledReactor(const mission::MissionModel& mission, Journal& journal, bool doubtful = false);

  /// Steps the reactor, and returns when inputs and decisions are durable. `seen` has the lines of the trace
  /// for the inputs.
  reactor::ReactorOutputs step(temporal::Time now, reactor::ReactorInputs inputs,
                               const std::vector<std::string>& seen);

  const Recovery& recovery() const { return recovery_; }
  const reactor::Reactor& reactor() const { return *reactor_; }
  std::string trace_sha256() const { return trace_.sha256(); }

 private:
  void recover(bool doubtful);
  bool replay();
  void begin_anew();
  void restore_concluded();
  void write(temporal::Time now, const reactor::ReactorInputs& inputs, const std::vector<std::string>& seen,
             const reactor::ReactorOutputs& out);
  void trace(temporal::Time now, const std::string& line);
  void anchor(temporal::Time now, std::string_view kind);

  const mission::MissionModel* mission_;
  Journal* journal_;
  std::unique_ptr<reactor::Reactor> reactor_;
  Trace trace_;
  Recovery recovery_;
  bool resume_due_ = false;
  std::size_t turns_since_anchor_ = 0;
};

}  // namespace roci::exec::journal
