// The gate before a node's handlers: no sample passes whose type means something else at its writer, and who does not
// understand this node is told of, once per participant and topic, in the log and by the event contract.mismatch.
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

class ContractGate {
 public:
  /// `pass` gets the samples that may be read. `prepare` opens the topic of events, `tell` writes one.
  ContractGate(ContractCheck&, std::function<void(Arrival&&)> pass, std::function<void()> prepare,
               std::function<void(const v1::Event&)> tell);

  /// Passes the sample on, counts it as refused, or holds it back until its participant is known. The samples of a
  /// writer keep their order.
  void arrive(Arrival&&);

  /// Is called in each turn of the loop: looks again at what is held back, and tells of new mismatches.
  void turn(clock::WallTime now);

  /// Tells operators of something else that was found out about another participant.
  void tell_later(v1::Event event, clock::WallTime now);
  /// The same without delay, for a process that ends.
  void tell_now(const v1::Event&);

  /// Samples that were refused so far, or held back in vain.
  std::uint64_t refused() const { return refused_; }

  /// So many samples of unknown participants are held back, of kHeldBytes together (bounds/limits.hpp); more push out
  /// the oldest.
  static constexpr std::size_t kHeldBack = 1024;

  /// The event is written so much wall time after the mismatch was found (and logged): by then the participants that
  /// started together have found each other, and readers of events miss none.
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
