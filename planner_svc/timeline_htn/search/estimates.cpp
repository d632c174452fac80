#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

namespace {

class Blind : public Estimate {
 public:
  std::uint32_t of(const PartialPlan&) override { return 0; }
};

}  // namespace

std::unique_ptr<Estimate> make_estimate(Heuristic, Ground&, const Successors&) {
  return std::make_unique<Blind>();
}

}  // namespace roci::planner::timeline_htn::search
