// This is `roci network …`: the planner's task network and its parameters, from the ground (R83, R118).
#pragma once

#include <string>

#include "ground_console/lib/client.hpp"

namespace roci::console::cli {

/// Holds the arguments of `roci network`.
struct NetworkArguments {
  std::string file;       ///< of `upload`: YAML or binary
  std::string parameter;  ///< of `set`
  double value = 0;
  std::string id;  ///< empty: one that nobody has used
  std::string issuer = "ground";
  std::string robot;  ///< empty: the only one
};

/// Checks and packs a network with the program roci-network beside this one. Returns its binary form. Throws
/// std::invalid_argument where that finds an error; it has then told what.
std::string packed_network(const std::string& file);

/// Makes the order; throws as packed_network() does.
v1::NetworkOrder network_order_of(const NetworkArguments& arguments);

/// Sends it and prints its stages as they come. Returns an exit code (docs/exit-codes.md).
int order_network(lib::Client& client, const NetworkArguments& arguments, bool json);

/// Prints which network is in force, and all orders about it.
int show_networks(lib::Client& client, bool json);

/// "ground/n2  in force with plan 4: small-lander, version 2".
std::string network_line(const v1::NetworkStatus& status);

}  // namespace roci::console::cli
