#include "exec_svc/orders/order.hpp"

#include <array>

namespace roci::exec::orders {

const char* to_string(OrderKind kind) {
  constexpr std::array names{"hold",   "release", "approve",  "set",  "autonomy", "upload",
                             "answer", "drop",    "relaunch", "safe", "command"};
  return names.at(static_cast<std::size_t>(kind));
}

const char* to_string(OrderStage stage) {
  constexpr std::array names{"received", "accepted", "refused", "applied"};
  return names.at(static_cast<std::size_t>(stage));
}

}  // namespace roci::exec::orders
