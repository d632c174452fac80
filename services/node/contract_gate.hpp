// The contract gate stands before a node's handlers.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"
#include "services/node/contract_check.hpp"
#include "services/node/endpoints.hpp"
#include "services/node/inbox.hpp"

namespace roci::services::node {

/// Passes no sample whose type means something else at its writer, and reports each participant that does not
/// understand this node, once per topic, in the log and by the event contract.mismatch.
class ContractGate {
 public:
  /// Calls `pass` with the samples that may be read, `prepare` to open the topic of events, and `tell` to
  /// write one.
  ContractGate(ContractCheck&, std::function<void(Arrival&&)> pass, std::function<void()> prepare,
               std::function<void(const v1::Event&)> tell);

  /// Passes the sample on, counts it as refused, or holds it back until its participant is known. The samples of a
  /// writer keep their order.
  void arrive(Arrival&&);

  /// Judges again what is held back, and reports new mismatches; it is called in each turn of the loop.
  void turn(clock::WallTime now);

  /// Reports to operators something else that was found out about another participant.
  void tell_later(v1::Event event, clock::WallTime now);
  /// Reports without delay, for a process that ends.
  void tell_now(const v1::Event&);

  /// Returns how many samples were refused so far, or held back in vain.
  std::uint64_t refused() const { return refused_; }

  /// Bounds the samples of unknown participants that are held back, beside kHeldBytes (bounds/limits.hpp); more push
  /// out the oldest.
  static constexpr std::size_t kHeldBack = 1024;

  /// Delays the event, in wall time, after the mismatch was found (and logged): by then participants that started
  /// together have found each other, and readers of events miss none.
  static constexpr double kTellAfterS = 1.5;

 private:
  struct Untold {
    clock::WallTime due;
    v1::Event event;
  };
  void retry_held();

  ContractCheck& check_;
  std::function<void(Arrival&&)> pass_;
  std::function<void()> prepare_;
  std::function<void(const v1::Event&)> tell_;
  std::deque<Arrival> held_;
  std::size_t held_bytes_ = 0;
  std::deque<Untold> untold_;
  std::uint64_t refused_ = 0;
};

}  // namespace roci::services::node
