#include "sim_svc/world/data_store.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace roci::sim::world {

namespace {

constexpr std::array<std::string_view, 4> kTiers{"critical", "decisional", "mandatory", "residual"};
constexpr std::array<std::string_view, 6> kFates{"stored",    "sent",        "received",
                                                 "discarded", "left-behind", "lost"};

}  // namespace

std::optional<Tier> tier_named(std::string_view name) {
  const auto found = std::ranges::find(kTiers, name);
  if (found == kTiers.end()) return std::nullopt;
  return static_cast<Tier>(found - kTiers.begin());
}

std::string_view name_of(Tier tier) { return kTiers.at(static_cast<std::size_t>(tier)); }
std::string_view name_of(Fate fate) { return kFates.at(static_cast<std::size_t>(fate)); }

bool is_final(Fate fate) { return fate != Fate::stored && fate != Fate::sent; }

double DataStore::used_bytes() const {
  double out = 0;
  for (const Product& one : products_)
    if (one.fate == Fate::stored) out += static_cast<double>(one.bytes);
  return out;
}

std::optional<Product> DataStore::add(Product product) {
  if (used_bytes() + static_cast<double>(product.bytes) > capacity_bytes_) return std::nullopt;
  const std::uint32_t number = ++made_[product.kind];
  product.id = number == 1 ? product.kind : product.kind + "-" + std::to_string(number);
  product.fate = Fate::stored;
  return products_.emplace_back(std::move(product));
}

const Product* DataStore::find(std::string_view id) const {
  const auto found = std::ranges::find(products_, id, &Product::id);
  return found == products_.end() ? nullptr : &*found;
}

std::optional<Product> DataStore::set_fate(std::string_view id, Fate fate) {
  const auto found = std::ranges::find(products_, id, &Product::id);
  if (found == products_.end()) return std::nullopt;
  found->fate = fate;
  Product out = *found;
  if (is_final(fate)) products_.erase(found);
  return out;
}

void DataStore::restore(DataMemory memory) {
  products_ = std::move(memory.products);
  made_ = std::move(memory.made);
}

}  // namespace roci::sim::world
