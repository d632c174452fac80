// These are `roci order …` and `roci decisions`: orders to the executive, and the decisions that are open.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ground_console/lib/client.hpp"

namespace roci::console::cli {

/// Holds the arguments of `roci order`.
struct OrderArguments {
  v1::OrderKind kind = v1::ORDER_HOLD;
  std::string target;
  std::vector<std::string> value;  ///< of `set`: true, false, a number, or a state with its arguments
  std::string choice;              ///< of `answer`
  std::string bound;               ///< of `answer`: the value for the arguments that the decision binds
  std::string level;               ///< of `autonomy`
  std::string command;             ///< of `command`, whose target is the component
  std::vector<std::string> command_arguments;  ///< "name=value"
  std::string file;                            ///< of `upload`
  std::string id;                              ///< empty: one that nobody has used
  std::string issuer = "ground";
  std::string robot;  ///< empty: the only one
};

/// Makes the order; throws std::invalid_argument with the remedy: an unknown level, a file that cannot be read.
v1::Order order_of(const OrderArguments& arguments);

/// Sends an order and prints its stages as they come. Returns an exit code (docs/exit-codes.md).
int give_order(lib::Client& client, const OrderArguments& arguments, bool json);

/// Lists the decisions that the running plan has asked for and nobody has made.
int list_decisions(lib::Client& client, bool json);

std::string stage_line(const v1::OrderStatus& status);
/// "way: by-left or by-right? asked of ground, before 01:20:00".
std::string decision_line(const v1::Decision& decision);
nlohmann::json decision_json(const v1::Decision& decision);

}  // namespace roci::console::cli
