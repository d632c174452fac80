#include "planner_svc/utility_htn/assessor/assessor.hpp"

namespace roci::planner::utility_htn::assessor {

std::string Assessor::objection(std::uint32_t, const Context&) const { return {}; }

temporal::RankVector Assessor::executed(const ExistingProduct& product, const Context&) const {
  return product.utility;
}

temporal::RankVector NetworkAssessor::predicted(std::uint32_t chain, const Context& context) const {
  return flattening::utility(context.network, context.chains.chains.at(chain), context.values);
}

temporal::RankVector NetworkAssessor::most(std::uint32_t chain, const Context& context) const {
  return predicted(chain, context);
}

bool NetworkAssessor::contextual(std::uint32_t, const Context&) const { return false; }

}  // namespace roci::planner::utility_htn::assessor
