// The completion queue has the work that threads of a service have under way, and its results until the loop
// runs them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>

namespace roci::services::node {

/// Says in which order results run.
enum class ResultOrder { as_begun, as_finished };

/// Runs each result once, on the loop, in the chosen order.
class CompletionQueue {
 public:
  explicit CompletionQueue(ResultOrder order) : order_(order) {}

  std::uint64_t begin();
  void finish(std::uint64_t work, std::function<void()> run);
  /// Runs the results whose turn has come. Throws std::logic_error for a result of work that was not begun.
  void run_finished();
  bool outstanding() const { return !begun_.empty(); }

 private:
  ResultOrder order_;
  std::uint64_t next_ = 1;
  std::set<std::uint64_t> begun_;
  std::map<std::uint64_t, std::function<void()>> finished_;
};

}  // namespace roci::services::node
