// Values of external functions from a table instead of a service.
#pragma once

#include <string>

#include "core/pddl/function_table.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Tuples that are not in the table are unavailable. `owner` is given as who says so.
class TableFunctions final : public engine::FunctionSource {
 public:
  TableFunctions(pddl::FunctionTable table, std::string owner)
      : table_(std::move(table)), owner_(std::move(owner)) {}

  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;

 private:
  pddl::FunctionTable table_;
  std::string owner_;
};

}  // namespace roci::planner::temporal_pddl::cli
