/// Who gave an order or an answer, under a name of the giver's choice.
#pragma once

#include <compare>
#include <string>

namespace roci::exec::orders {

struct IssuedKey {
  std::string issuer;
  std::string id;
  auto operator<=>(const IssuedKey&) const = default;
  std::string text() const { return issuer + "/" + id; }
};

}  // namespace roci::exec::orders
