// The owners of external functions offer modules, and give one batch of values at a time. This is used on the
// node's loop.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"
#include "roci_idl/function.h"
#include "services/bounds/tally.hpp"
#include "services/rpc.hpp"

namespace roci::planner {

/// Holds the newest offers by module and owner.
using FunctionOffers = std::map<std::pair<std::string, std::string>, v1::FunctionOffer>;

/// Says who is to be asked, or nobody, with the reason in words.
struct OwnerChoice {
  const v1::FunctionOffer* offer = nullptr;
  std::string reason{};
};

/// Returns the owner of the module that belongs to this robot, else the one that belongs to none; if `robot`
/// is empty, any owner fits. Where several fit, those that are not alive do not count.
OwnerChoice choose_owner(const FunctionOffers& offers, const std::string& module_name,
                         const std::string& robot, const std::function<bool(const std::string&)>& alive);

/// Asks the right owner for one batch of values at a time, and gives a value or a reason for each.
class FunctionOwners {
 public:
  using Done = std::function<void(std::vector<engine::FunctionValue>)>;

  /// Asks with a `timeout` for each batch.
  FunctionOwners(services::Node& node, temporal::Duration timeout);
  FunctionOwners(const FunctionOwners&) = delete;
  FunctionOwners& operator=(const FunctionOwners&) = delete;

  /// Asks for `calls`: at least one, of one function, with one accuracy and one state. The owner that answers
  /// for the request's robot is asked, else the one that answers for all; exactly, if it does not offer the
  /// accuracy for this function. `done` gets one value for each, perhaps before this returns; all are
  /// unavailable, with the reason, unless exactly one owner fits.
  void ask(std::vector<engine::FunctionCall> calls, const engine::Request& request, Done done);

  /// Gives up the batch under way, whose `done` will not run. Returns false if none was under way.
  bool forget();

 private:
  services::Node& node_;
  temporal::Duration timeout_;
  services::Client<v1::FunctionRequest, v1::FunctionReply> client_;
  FunctionOffers offers_;  // at most kOffers (limits.hpp)
  services::bounds::Tally refusals_;
  std::uint64_t asked_ = 0;              // batches so far
  std::optional<std::uint64_t> asking_;  // the one under way
};

}  // namespace roci::planner
