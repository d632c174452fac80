#include "exec_svc/journal/replay.hpp"

#include "exec_svc/archive/fields.hpp"

namespace roci::exec {

void Replay::take(temporal::Time time, std::string_view kind, std::string_view bytes) {
  if (divergence_) return;
  if (kind == "input") return turn(time, bytes);
  if (!is_decision(kind, bytes)) return;
  const Line journaled{std::string(kind), std::string(bytes)};
  if (matched_ < lines_.size() && lines_[matched_] == journaled) {
    ++matched_;
  } else {
    differ(journaled.kind + " " + journaled.text,
           matched_ < lines_.size() ? lines_[matched_].kind + " " + lines_[matched_].text : "");
  }
}

void Replay::turn(temporal::Time time, std::string_view bytes) {
  finish();
  if (divergence_) return;
  now_ = time;
  ReactorInputs inputs;
  try {
    inputs = from_bytes<ReactorInputs>(bytes);
  } catch (const ArchiveError& error) {
    return differ("inputs that can be read", error.what());
  }
  outputs_ = reactor_->step(time, inputs);
  lines_ = decisions(time, outputs_);
  matched_ = 0;
  ++turns_;
}

void Replay::finish() {
  if (!divergence_ && matched_ < lines_.size())
    differ("", lines_[matched_].kind + " " + lines_[matched_].text);
}

void Replay::differ(std::string expected, std::string got) {
  divergence_ = Divergence{now_, std::move(expected), std::move(got)};
}

}  // namespace roci::exec
