#include "exec_svc/journal/journaled_reactor.hpp"

#include <algorithm>

#include "exec_svc/journal/format.hpp"
#include "exec_svc/reactor/message_fields.hpp"

namespace roci::exec::journal {

using archive::ArchiveError;
using archive::to_bytes;
using goals::GoalRecord;
using mission::MissionModel;
using reactor::Reactor;
using reactor::ReactorInputs;
using reactor::ReactorOutputs;

namespace {

// Bounds the turns of a replay, so that it takes a moment: an anchor is written then as soon as the reactor
// rests.
constexpr std::size_t kTurnsUntilAnchor = 500;

// Exceeds the number of plans that another executive may have made meanwhile.
constexpr std::int64_t kPlansOfAnother = 1000;

// Names the journal's text with what plans have made of timelines that nobody observes.
constexpr char kConcluded[] = "concluded";

// Compares goals as far as the journal's table keeps their requests; the inputs have them exactly.
bool same(const GoalRecord& a, const GoalRecord& b) {
  return a.request.key == b.request.key && a.state == b.state && a.reason == b.reason &&
         a.arrival == b.arrival && a.plan_version == b.plan_version;
}

}  // namespace

JournaledReactor::JournaledReactor(const MissionModel& mission, Journal& journal, bool doubtful)
    : mission_(&mission), journal_(&journal), reactor_(std::make_unique<Reactor>(mission)) {
  recover(doubtful);
}

void JournaledReactor::recover(bool doubtful) {
  bool empty = true;
  journal_->for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
    empty = false;
    if (kind == "trace") trace_.add(text);
  });
  if (empty && journal_->goals().empty()) {
    journal_->set_number("format", journal::kInputFormat);
    return;
  }
  recovery_.restarted = true;
  if (doubtful) {
    journal_->set_number("plan_version", journal_->number("plan_version", 0) + kPlansOfAnother);
    journal_->commit();  // it is read below
    recovery_.divergence = Divergence{temporal::Time{0}, "all that was done", "perhaps a part of it"};
  } else {
    recovery_.resumed = replay();
  }
  if (recovery_.resumed) {
    resume_due_ = true;
  } else {
    begin_anew();
  }
}

bool JournaledReactor::replay() {
  Replay replay(*reactor_);
  const auto fail = [this](std::string expected, std::string got) {
    recovery_.divergence = Divergence{temporal::Time{0}, std::move(expected), std::move(got)};
    return false;
  };
  const std::int64_t format = journal_->number("format", 0);
  if (format != journal::kInputFormat)
    return fail("a journal of format " + std::to_string(journal::kInputFormat),
                "format " + std::to_string(format));
  try {
    journal_->for_each_from(journal_->number("anchor", 0),
                            [&](temporal::Time time, std::string_view kind, std::string_view bytes) {
                              const bool snapshot = kind == "anchor" || kind == "restored";
                              if (snapshot && replay.turns() == 0) reactor_->restore(bytes);
                              replay.take(time, kind, bytes);
                              recovery_.until = time;
                            });
  } catch (const ArchiveError& error) {
    return fail("a snapshot that can be read", error.what());
  } catch (const JournalError&) {
    throw;
  } catch (const std::exception& error) {  // of a reactor that took what it never would have been given
    return fail("inputs that can be taken", error.what());
  }
  replay.finish();
  recovery_.turns = replay.turns();
  recovery_.divergence = replay.divergence();
  if (recovery_.divergence) return false;
  recovery_.last_events = replay.outputs().events;
  const auto replayed = reactor_->goals().all();
  const auto journaled = journal_->goals();
  const auto equal = [](const GoalRecord* a, const GoalRecord& b) { return same(*a, b); };
  if (!std::equal(replayed.begin(), replayed.end(), journaled.begin(), journaled.end(), equal))
    return fail("the goals of the journal", "others");
  return true;
}

// Begins with goals, plan numbers and what the ground leaves to the executive from the journal; the rest comes from
// observations.
void JournaledReactor::begin_anew() {
  reactor_ = std::make_unique<Reactor>(*mission_);
  reactor_->restore(journal_->goals(), static_cast<std::uint32_t>(journal_->number("plan_version", 0)));
  const std::int64_t first = static_cast<std::int64_t>(mission_->executive.autonomy);
  reactor_->restore_authority(static_cast<mission::AutonomyLevel>(journal_->number("autonomy", first)),
                              journal_->number("held", 0) != 0);
  restore_concluded();
  journal_->set_number("format", journal::kInputFormat);
  anchor(temporal::Time{0}, "restored");
}

// Restores conclusions, which nobody else could tell again.
void JournaledReactor::restore_concluded() {
  const std::string bytes = journal_->text(kConcluded);
  if (bytes.empty()) return;
  try {
    reactor_->restore_concluded(archive::from_bytes<std::map<std::string, temporal::Value>>(bytes));
  } catch (const ArchiveError&) {  // of another version of the code: they are brought about anew
  }
}

ReactorOutputs JournaledReactor::step(temporal::Time now, ReactorInputs inputs,
                                      const std::vector<std::string>& seen) {
  inputs.restarted = std::exchange(resume_due_, false);
  ReactorOutputs out = reactor_->step(now, inputs);
  write(now, inputs, seen, out);
  return out;
}

void JournaledReactor::write(temporal::Time now, const ReactorInputs& inputs,
                             const std::vector<std::string>& seen, const ReactorOutputs& out) {
  journal_->append_bytes(now, "input", to_bytes(inputs));
  for (const std::string& line : seen) trace(now, std::to_string(now.count()) + " " + line);
  for (const DecisionLine& line : decisions(now, out)) {
    if (line.kind == "trace") {
      trace(now, line.text);
    } else {
      journal_->append(now, line.kind, line.text);
    }
  }
  for (const GoalRecord& goal : out.goal_changes) journal_->put_goal(goal);
  if (!out.order_statuses.empty()) {
    journal_->set_number("autonomy", static_cast<std::int64_t>(reactor_->autonomy()));
    journal_->set_number("held", reactor_->held() ? 1 : 0);
  }
  if (!out.concluded.empty()) journal_->set_text(kConcluded, to_bytes(reactor_->concluded()));
  if (out.adopted) journal_->set_number("plan_version", reactor_->plan_version());
  ++turns_since_anchor_;
  if (reactor_->at_rest() && (out.call || turns_since_anchor_ >= kTurnsUntilAnchor)) anchor(now, "anchor");
  journal_->commit();
}

void JournaledReactor::trace(temporal::Time now, const std::string& line) {
  journal_->append(now, "trace", line);
  trace_.add(line);
}

void JournaledReactor::anchor(temporal::Time now, std::string_view kind) {
  const std::int64_t number = journal_->append_bytes(now, kind, reactor_->snapshot());
  journal_->set_number("anchor", number);
  if (!mission_->executive.keep_inputs) {
    journal_->forget_inputs_before(number);
    journal_->forget_texts_before(number - static_cast<std::int64_t>(mission_->executive.kept_records));
  }
  turns_since_anchor_ = 0;
}

}  // namespace roci::exec::journal
