// A replay sends a journal's inputs through a reactor again, and tells whether it decides what it decided
// then.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/journal/decisions.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::journal {

/// Holds the first decision that came out differently.
struct Divergence {
  temporal::Time time{0};
  std::string expected;  ///< "kind text" as journaled; empty: nothing more was decided then
  std::string got;       ///< empty: nothing more is decided now
};

/// Compares what a reactor decides now with the decisions of a journal, up to the first difference.
class Replay {
 public:
  explicit Replay(reactor::Reactor& reactor) : reactor_(&reactor) {}

  /// Takes the next record of the journal. After a divergence nothing more happens.
  void take(temporal::Time time, std::string_view kind, std::string_view bytes);
  /// Compares the last turn; it is to be called after the last record.
  void finish();

  const std::optional<Divergence>& divergence() const { return divergence_; }
  std::size_t turns() const { return turns_; }
  temporal::Time now() const { return now_; }
  /// Returns what the reactor put out in the newest turn.
  const reactor::ReactorOutputs& outputs() const { return outputs_; }
  /// Returns the decision that equalled the newest journaled one.
  const DecisionLine& matched() const { return lines_.at(matched_ - 1); }

 private:
  void turn(temporal::Time time, std::string_view bytes);
  void differ(std::string expected, std::string got);

  reactor::Reactor* reactor_;
  reactor::ReactorOutputs outputs_;
  std::vector<DecisionLine> lines_;  ///< decided now
  std::size_t matched_ = 0;          ///< number of them that were journaled, too
  std::size_t turns_ = 0;
  temporal::Time now_{0};
  std::optional<Divergence> divergence_;
};

}  // namespace roci::exec::journal
