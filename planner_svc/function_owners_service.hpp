// The owners of external functions: who offers which module, and one batch of values at a time from them. On
// the node's loop.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/function_source.hpp"
#include "roci_idl/function.h"
#include "services/rpc.hpp"

namespace roci::planner {

class FunctionOwners {
 public:
  using Done = std::function<void(std::vector<FunctionValue>)>;

  /// `timeout`: of one batch.
  FunctionOwners(services::Node& node, temporal::Duration timeout);
  FunctionOwners(const FunctionOwners&) = delete;
  FunctionOwners& operator=(const FunctionOwners&) = delete;

  /// `calls`: at least one, of one function. `done` gets one value for each, perhaps before this returns.
  void ask(const std::vector<FunctionCall>& calls, const std::vector<v1::PlanObject>& objects, Done done);

  /// The batch under way is wanted no more, its `done` will not run. False: none was under way.
  bool forget();

 private:
  std::string no_offer(const std::string& module_name) const;

  services::Node& node_;
  temporal::Duration timeout_;
  services::Client<v1::FunctionRequest, v1::FunctionReply> client_;
  std::map<std::string, v1::FunctionOffer> offers_;  // by module
  std::uint64_t asked_ = 0;                          // batches so far
  std::optional<std::uint64_t> asking_;              // the one under way
};

}  // namespace roci::planner
