#include "exec_svc/reactor/failure_backoff.hpp"

#include <algorithm>

namespace roci::exec::reactor {

FailureBackoff::Count FailureBackoff::failed(const std::string& component) {
  Count out;
  out.in_a_row = ++in_a_row_[component];
  out.used_up = out.in_a_row >= limit_;
  if (out.used_up) in_a_row_.erase(component);
  if (out.in_a_row < 2 || out.used_up) return out;
  out.pause = std::min(first_pause_, longest_pause_);
  for (std::uint32_t i = 2; i < out.in_a_row && out.pause < longest_pause_; ++i)
    out.pause = std::min(2 * out.pause, longest_pause_);
  return out;
}

}  // namespace roci::exec::reactor
