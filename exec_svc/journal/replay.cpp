#include "exec_svc/journal/replay.hpp"

#include <algorithm>

#include "exec_svc/reactor/message_fields.hpp"

namespace roci::exec::journal {

using archive::ArchiveError;
using archive::from_bytes;
using reactor::ReactorInputs;

namespace {

// Keeps, of long texts (problems), the kind and the first line that differs.
void keep_different_line(std::string& a, std::string& b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  const std::size_t line = a.rfind('\n', static_cast<std::size_t>(differs - a.begin()));
  if (line == std::string::npos || a.empty() || b.empty()) return;
  for (std::string* text : {&a, &b}) {
    const std::string shown = text->substr(line + 1, text->find('\n', line + 1) - line - 1);
    *text = text->substr(0, text->find(' ')) + ": " + shown;
  }
}

}  // namespace

void Replay::take(temporal::Time time, std::string_view kind, std::string_view bytes) {
  if (divergence_) return;
  if (kind == "input") return turn(time, bytes);
  if (turns_ == 0 || !is_decision(kind, bytes))
    return;  // what came before the first inputs has no cause here
  const DecisionLine journaled{std::string(kind), std::string(bytes)};
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
  keep_different_line(expected, got);
  divergence_ = Divergence{now_, std::move(expected), std::move(got)};
}

}  // namespace roci::exec::journal
