// Orders apart are those that an executive had taken before its journal was replaced by the leader's. Unlike goals they
// are not merged: an old hold or release must not overrule what the leader was told since. Those who gave them are
// told.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/journal/journal.hpp"

namespace roci::exec::standby {

/// Describes an order that was acknowledged and not refused, by what the journal's trace says of it.
struct TakenOrder {
  std::string key;   ///< reads "issuer/id"
  std::string what;  ///< reads "hold arm"
  temporal::Time at{0};
};

/// Returns the orders of this journal, in the order in which they came.
std::vector<TakenOrder> taken_orders(const journal::Journal& journal);

/// Returns the orders of `taken` that the successor's journal does not know, without those that are older than
/// what it still holds.
std::vector<TakenOrder> unknown_orders(std::vector<TakenOrder> taken, const journal::Journal& successor);

}  // namespace roci::exec::standby
