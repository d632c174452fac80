#include "planner_svc/function_owners_service.hpp"

#include <utility>

#include "planner_svc/wire_service.hpp"
#include "services/publisher.hpp"

namespace roci::planner {

FunctionOwners::FunctionOwners(services::Node& node, temporal::Duration timeout)
    : node_(node), timeout_(timeout), client_(node, services::topics::function_call) {
  services::subscribe(node, services::topics::function_offer,
                      [this](const v1::FunctionOffer& offer) { offers_[offer.module_name()] = offer; });
}

void FunctionOwners::ask(const std::vector<FunctionCall>& calls, const std::vector<v1::PlanObject>& objects,
                         Done done) {
  const std::string& module_name = calls.front().module;
  const auto found = offers_.find(module_name);
  if (found == offers_.end())
    return done({calls.size(), FunctionValue{FunctionOutcome::unavailable, 0, {}, no_offer(module_name)}});
  const v1::FunctionOffer& offer = found->second;
  const Provenance asked{offer.owner(), std::to_string(offer.model_version()), node_.now()};
  const std::uint64_t number = ++asked_;
  asking_ = number;
  client_.call(to_wire(calls, objects), offer.owner(), timeout_,
               [this, calls, asked, number, done = std::move(done)](const auto& result) {
                 if (asking_ != number) return;
                 asking_.reset();
                 done(values_of(calls, asked, result));
               });
}

bool FunctionOwners::forget() { return std::exchange(asking_, std::nullopt).has_value(); }

std::string FunctionOwners::no_offer(const std::string& module_name) const {
  std::string offered;
  for (const auto& [name, offer] : offers_) offered += (offered.empty() ? "" : ", ") + name;
  return "no service offers module '" + module_name +
         "'; offered are: " + (offered.empty() ? "none" : offered);
}

}  // namespace roci::planner
