// Sessions say how long downlinks last: as long as the waiting data take, as far as the limits of energy permit (R111,
// R127).
#pragma once

#include <vector>

#include "planner_svc/utility_htn/cycle/placement.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"

namespace roci::planner::utility_htn::cycle {

/// Returns what all that is placed will generate and send, as planned or as it turned out so far;
/// of downlinks those that have not ended.
search::PlannedData data_of(const std::vector<Block>& blocks, const model::Network& network,
                            const flattening::Chains& chains, const model::Values& values);

/// Knows which downlink is the next one, since that also takes data whose own downlink has gone without them.
class Sessions {
 public:
  /// Both arguments must outlive this object.
  Sessions(const model::Network& network, const flattening::Chains& chains)
      : network_(network), chains_(chains) {}

  /// Finds anew the next downlink of what has begun, if data wait on board.
  void look(const std::vector<Block>& blocks, const delivery::Delivery& delivery);
  /// Returns what a downlink takes. Of one that is committed that is what the executive was told. Of another one of
  /// what has begun it is what the data take that wait for it, of those that go with it: as far as `room`, its limit
  /// and that of its sol permit beside the other downlinks in `blocks`. It is never less than the network says, which
  /// holds for what has not begun.
  temporal::Duration length(const std::vector<Block>& blocks, const Block& of, std::size_t link,
                            const delivery::Delivery& delivery, const model::Values& values,
                            temporal::Duration room = temporal::no_bound) const;
  /// Returns the same where it may last no longer than this.
  temporal::Duration wanted(const std::vector<Block>& blocks, const Block& of, std::size_t link,
                            const delivery::Delivery& delivery, const model::Values& values,
                            temporal::Duration permitted) const;
  /// Returns how long it may take at most if it starts then, by the same limits.
  temporal::Duration longest(const std::vector<Block>& blocks, const Block& of, std::size_t link,
                             temporal::Time start, const delivery::Delivery& delivery,
                             const model::Values& values) const;

 private:
  const model::Network& network_;
  const flattening::Chains& chains_;
  TaskId next_ = 0;
};

}  // namespace roci::planner::utility_htn::cycle
