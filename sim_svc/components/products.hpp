// This file makes the data products of a component's commands, as its settings describe them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "sim_svc/setup/settings.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Describes a product that a command makes.
struct ProductForm {
  std::string kind;  ///< arguments of the command stand in braces: trench_{site}
  world::Tier tier = world::Tier::mandatory;
  double bytes = 1e6;
  double bytes_noise = 0;         ///< standard deviation, as a share
  std::vector<double> utility{};  ///< by rank, the highest first; empty: it is not judged on board
};

/// Reads `trench_{site}: {tier: decisional, bytes: 3e6, bytes_noise: 0.1, utility: [0, 0.3]}` and so on, for a command
/// with these arguments. Throws mission::FileError with place and remedy.
std::vector<ProductForm> read_products(const mission::Entry&, const std::string& command,
                                       const std::vector<std::string>& arguments);

/// Reads `products: {<command>: {<kind>: {…}}}` for a component with these commands, and `data_factor`.
std::map<std::string, std::vector<ProductForm>> read_products_by_command(
    setup::Settings&, const std::vector<world::CommandForm>& commands);

/// Multiplies the sizes by the setting `data_factor`, a number for all tiers or {<tier>: number}, which a scenario's
/// world may give for all components with products.
void apply_data_factor(setup::Settings&, std::vector<ProductForm>&);

/// Makes the products of a task at `now` and stores them on board, the more urgent tiers first; each size is drawn from
/// the noise and multiplied by `content`. Fails `no-store` on a robot without a store, and `data-full`, naming what
/// found no room; the others are kept.
world::Ending make_products(const std::vector<ProductForm>&, const world::TaskKey&,
                            const std::map<std::string, std::string>& arguments, double content,
                            temporal::Time now, world::RandomStream& noise, world::Surroundings&);

}  // namespace roci::sim::components
