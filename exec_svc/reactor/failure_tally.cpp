#include "exec_svc/reactor/failure_tally.hpp"

#include <algorithm>

namespace roci::exec {

FailureTally::Count FailureTally::failed(const std::string& component) {
  Count out;
  out.in_a_row = ++in_a_row_[component];
  out.used_up = out.in_a_row >= limit_;
  if (out.used_up) in_a_row_.erase(component);
  if (out.in_a_row > 1 && !out.used_up) out.pause = pause_ * (1 << std::min(out.in_a_row - 2, 6U));
  return out;
}

}  // namespace roci::exec
