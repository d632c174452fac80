// Table functions take values of external functions from a table instead of a service.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pddl/function_table.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

/// Gives exact values where the tables have no lower bound; tuples that are not in them are unavailable.
/// `owner` is named as the source.
class TableFunctions final : public FunctionSource {
 public:
  TableFunctions(pddl::FunctionTables tables, std::string owner)
      : tables_(std::move(tables)), owner_(Provenance{std::move(owner), "", {}}) {}

  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled) override;

 private:
  FunctionValue answer(const FunctionCall& call) const;

  pddl::FunctionTables tables_;
  SharedProvenance owner_;
};

/// Returns what owners said as such tables, by which a call can be made again without them. A tuple without a
/// value for any other reason is entered as unreachable.
pddl::FunctionTables tables_of(std::span<const FunctionUse> uses);

}  // namespace roci::planner::engine
