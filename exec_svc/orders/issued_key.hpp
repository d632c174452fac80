// An issued key says who gave an order or an answer.
#pragma once

#include <compare>
#include <string>

namespace roci::exec::orders {

/// Names an order or an answer by its giver and an id that the giver chose.
struct IssuedKey {
  std::string issuer;
  std::string id;
  auto operator<=>(const IssuedKey&) const = default;
  std::string text() const { return issuer + "/" + id; }
};

}  // namespace roci::exec::orders
