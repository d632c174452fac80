// The values of one call as the owners gave them: for the checker, and for a second look at what they did not find.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

/// Passes calls on and keeps what the owners answered. The source must outlive it.
class RecordedFunctions final : public FunctionSource {
 public:
  explicit RecordedFunctions(FunctionSource& source) : source_(source) {}

  /// Asks the owners; after ask_again() only for what they have not been asked for.
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled) override;

  /// Asks the owners once more for each exact value that they have not found (FunctionOutcome::unknown), one
  /// batch per function and state. Returns whether they know one of them now, or have proved that there is
  /// none. What does not come, or comes with a fault, stays unknown.
  bool ask_again(const std::function<bool()>& cancelled);

  /// Everything that was answered; of what was asked for again the newest answer.
  std::span<const FunctionUse> uses() const { return uses_; }
  std::uint64_t requests() const { return requests_; }
  /// Tuples of all requests.
  std::uint64_t tuples() const { return tuples_; }
  /// Those of them that came, or were to come, exactly.
  std::uint64_t exact() const { return exact_; }

 private:
  std::vector<FunctionValue> ask(std::span<const FunctionCall> calls, const std::function<bool()>& cancelled);
  std::vector<FunctionValue> recalled(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled);

  FunctionSource& source_;
  std::uint64_t requests_ = 0;
  std::uint64_t tuples_ = 0;
  std::uint64_t exact_ = 0;
  std::vector<FunctionUse> uses_;
  std::map<std::string, std::size_t> known_;  // places in uses_, once something was asked for again
};

}  // namespace roci::planner::engine
