// A service that writes on a topic of each scope, calls a procedure, and says whom it hears: one program that stands in
// for every service of two robots, their world and the ground.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "services/service.hpp"

namespace roci::services::contract {

/// So many times each service writes.
inline constexpr int kRounds = 20;

/// Takes one line: "heard KIND SENDER", once for each kind (event, goal, observation, request) and other sender;
/// "rounds SENDER" when the last event of a sender has come; "mismatch TOPIC HASH by SENDER" when a sender tells of
/// another hash ("none": of none); "refused N" when N samples were refused; "over" at the end.
using Say = std::function<void(const std::string& line)>;

std::unique_ptr<Service> make_robot_service(Node&, Say);

}  // namespace roci::services::contract
