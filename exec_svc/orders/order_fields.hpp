// This file lists the fields of orders for the archive, each type once, for writing and reading.
#pragma once

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/goals/goal_fields.hpp"
#include "exec_svc/orders/order.hpp"

namespace roci::exec::orders {

template <class A>
void fields(A& a, archive::Of<IssuedKey, A>& v) {
  a(v.issuer, v.id);
}
template <class A>
void fields(A& a, archive::Of<Order, A>& v) {
  a(v.key, v.sample, v.kind, v.target, v.content, v.choice, v.level, v.upload, v.checksum);
  if (v.kind < OrderKind::hold || v.kind > OrderKind::command)
    throw archive::ArchiveError("an order is of no known kind");
}
template <class A>
void fields(A& a, archive::Of<OrderStatus, A>& v) {
  a(v.key, v.answers, v.stage, v.reason, v.plan_version);
}

}  // namespace roci::exec::orders
