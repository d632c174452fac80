// An answering engine answers calls: one request, one answer.
#pragma once

#include "planner_svc/engine/answer.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// Serves as the base of engines that answer calls.
class AnsweringEngine {
 public:
  virtual ~AnsweringEngine() = default;

  /// Plans. The answer is a function of the request and of the values that `functions` gives, unless time or
  /// cancellation ended the call. Runs on a thread of its own, one call at a time, without clock, files or
  /// DDS. Once `limits.cancelled` says so it returns within some milliseconds, with Verdict::cancelled. What
  /// it throws becomes Verdict::crashed (std::bad_alloc: out_of_memory).
  virtual Answer answer(const Request& request, const Limits& limits, FunctionSource& functions) = 0;
};

}  // namespace roci::planner::engine
