// Counts what owners of external functions are asked for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::values {

/// Passes calls on. The source must outlive it.
class CountedFunctions final : public engine::FunctionSource {
 public:
  explicit CountedFunctions(engine::FunctionSource& source) : source_(source) {}

  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;

  std::size_t requests() const { return requests_; }
  std::size_t exact() const { return exact_; }
  std::size_t cheap() const { return cheap_; }

 private:
  engine::FunctionSource& source_;
  std::size_t requests_ = 0;  // batches
  std::size_t exact_ = 0;     // tuples that came, or were to come, exactly
  std::size_t cheap_ = 0;     // the others
};

}  // namespace roci::planner::temporal_pddl::values
