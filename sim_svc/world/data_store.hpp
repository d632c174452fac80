// The data store holds what a robot has measured and not yet brought home.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Says how soon a product must reach the ground (R110): at once, with the next downlink, before the end, with energy
/// left over. The order is that of idl/command.idl.
enum class Tier : std::uint8_t { critical, decisional, mandatory, residual };

/// Returns the tier of that name, or nothing if there is none.
std::optional<Tier> tier_named(std::string_view name);
std::string_view name_of(Tier);

/// Says what became of a product, in the order of idl/command.idl.
enum class Fate : std::uint8_t { stored, sent, received, discarded, left_behind, lost };

/// Returns "stored", "sent", "received", "discarded", "left-behind" or "lost".
std::string_view name_of(Fate);

/// Returns whether nothing can become of the product any more.
bool is_final(Fate);

/// Describes data that a task has brought.
struct Product {
  std::string id;  ///< is the store's: the kind, or, after the first of it, kind-2, kind-3, …
  std::string kind;
  std::string robot;
  std::string source;  ///< activity that made it
  std::uint64_t bytes = 0;
  Tier tier = Tier::mandatory;
  Fate fate = Fate::stored;
  temporal::Time created{};
  std::vector<double> utility{};  ///< by rank, the highest first; empty: it was not judged on board
  bool operator==(const Product&) const = default;
};

/// Holds what of a store outlives the process that simulates it.
struct DataMemory {
  std::vector<Product> products;
  std::map<std::string, std::uint32_t> made;  ///< kind → how many products of it there were
};

/// Holds the products of one robot until their fate is final.
class DataStore {
 public:
  explicit DataStore(double capacity_bytes) : capacity_bytes_(capacity_bytes) {}

  double capacity_bytes() const { return capacity_bytes_; }
  /// Returns how many bytes are taken: those of the products that are stored. What was sent takes none.
  double used_bytes() const;

  /// Takes the product in, stored, under an id that no product before it had. Returns it as it is kept; nothing, and
  /// nothing has changed, when it does not fit.
  std::optional<Product> add(Product);
  /// Returns the products whose fate is not final, in the order in which they were made.
  const std::vector<Product>& products() const { return products_; }
  /// Returns the product of that id, or null when there is none whose fate is open.
  const Product* find(std::string_view id) const;
  /// Sets what became of a product and returns it; one with a final fate is kept no longer. Returns nothing when there
  /// is none of that id.
  std::optional<Product> set_fate(std::string_view id, Fate);

  DataMemory memory() const { return {products_, made_}; }
  void restore(DataMemory);

 private:
  double capacity_bytes_;
  std::vector<Product> products_;
  std::map<std::string, std::uint32_t> made_;
};

}  // namespace roci::sim::world
