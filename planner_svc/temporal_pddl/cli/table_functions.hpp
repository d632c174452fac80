// Values of external functions from a table instead of a service.
#pragma once

#include <string>

#include "core/pddl/function_table.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Gives exact values where no lower bound stands in the tables; tuples that are not in them are unavailable.
/// `owner` is given as who says so.
class TableFunctions final : public engine::FunctionSource {
 public:
  TableFunctions(pddl::FunctionTables tables, std::string owner)
      : tables_(std::move(tables)), owner_(engine::Provenance{std::move(owner), "", temporal::Time{0}}) {}

  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;

 private:
  engine::FunctionValue answer(const engine::FunctionCall& call) const;

  pddl::FunctionTables tables_;
  engine::SharedProvenance owner_;
};

}  // namespace roci::planner::temporal_pddl::cli
