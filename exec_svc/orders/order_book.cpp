#include "exec_svc/orders/order_book.hpp"

#include <utility>

namespace roci::exec::orders {

bool OrderBook::receive(const Order& order) {
  const auto [known, is_new] = statuses_.try_emplace(order.key, OrderStatus{order.key, order.sample});
  OrderStatus& status = known->second;
  if (!is_new && status.answers == order.sample) return false;
  status.answers = order.sample;
  changes_.push_back(status);
  return is_new;
}

void OrderBook::move(const IssuedKey& key, OrderStage stage, const std::string& reason,
                     std::uint32_t plan_version) {
  OrderStatus& status = statuses_.at(key);
  status.stage = stage;
  status.reason = reason;
  status.plan_version = plan_version;
  changes_.push_back(status);
}

std::vector<OrderStatus> OrderBook::take_changes() { return std::exchange(changes_, {}); }

std::vector<OrderStatus> OrderBook::all() const {
  std::vector<OrderStatus> out;
  for (const auto& [key, status] : statuses_) out.push_back(status);
  return out;
}

}  // namespace roci::exec::orders
