#include "planner_svc/utility_htn/assessor/assessor.hpp"

namespace roci::planner::utility_htn::assessor {

namespace {

class PlainForecast final : public Forecast {
 public:
  PlainForecast(const Assessor& assessor, const Context& context) : assessor_(assessor), context_(context) {}

  void plan(std::span<const std::uint32_t> planned) override {
    planned_.assign(planned.begin(), planned.end());
  }
  void plan_next(std::uint32_t chain) override { planned_.push_back(chain); }
  temporal::RankVector predicted(std::uint32_t chain) const override {
    return assessor_.predicted(chain, {context_.network, context_.values, context_.chains,
                                       context_.timelines_now, context_.products, planned_, context_.closed});
  }

 private:
  const Assessor& assessor_;
  Context context_;
  std::vector<std::uint32_t> planned_;
};

}  // namespace

std::unique_ptr<Forecast> Assessor::forecast(const Context& context) const {
  return std::make_unique<PlainForecast>(*this, context);
}

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
