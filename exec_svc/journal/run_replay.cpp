#include "exec_svc/journal/run_replay.hpp"

#include "exec_svc/journal/trace.hpp"
#include "exec_svc/reactor/message_fields.hpp"

namespace roci::exec::journal {

using archive::from_bytes;
using mission::MissionModel;
using reactor::Reactor;
using reactor::ReactorInputs;

RunReplay replay_run(const Journal& journal, const MissionModel& mission) {
  RunReplay out;
  Reactor reactor(mission);
  Replay replay(reactor);
  Trace journaled, replayed;
  journal.for_each([&](temporal::Time time, std::string_view kind, std::string_view bytes) {
    if (kind == "restored" || (kind == "anchor" && replay.turns() == 0)) {
      replay.finish();
      reactor = Reactor(mission);
      reactor.restore(bytes);
    }
    if (kind == "input" && replay.turns() == 0) out.from = time;
    if (kind == "input" && from_bytes<ReactorInputs>(bytes).restarted) ++out.restarts;
    replay.take(time, kind, bytes);
    const bool decided = replay.turns() > 0 && is_decision(kind, bytes);
    if (decided && !replay.divergence()) ++out.decisions;
    if (kind != "trace") return;
    journaled.add(bytes);
    if (!replay.divergence()) replayed.add(decided ? std::string_view(replay.matched().text) : bytes);
  });
  replay.finish();
  out.turns = replay.turns();
  out.until = replay.now();
  out.divergence = replay.divergence();
  out.trace_sha256 = journaled.sha256();
  out.replayed_sha256 = replayed.sha256();
  return out;
}

}  // namespace roci::exec::journal
