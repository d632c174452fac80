#include "planner_svc/timeline_htn/search/relaxed_reachability.hpp"

#include "planner_svc/timeline_htn/search/relaxation.hpp"

namespace roci::planner::timeline_htn::search {

std::optional<NeverReached> never_reached(const model::Model& model, std::size_t most_bytes,
                                          const std::function<bool()>& cancelled) {
  return Relaxation(model, most_bytes, cancelled).run();
}

}  // namespace roci::planner::timeline_htn::search
