#include "planner_svc/function_owners_service.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/limits.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/log/log.hpp"
#include "services/publisher.hpp"

namespace roci::planner {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionValue, engine::Provenance;
using temporal::FunctionAccuracy;

namespace {

using Offers = std::vector<const v1::FunctionOffer*>;

std::string no_offer(const FunctionOffers& offers, const std::string& module_name) {
  std::string offered;
  std::string last;
  for (const auto& [key, offer] : offers) {
    if (key.first != last) offered += (offered.empty() ? "" : ", ") + key.first;
    last = key.first;
  }
  return "no service offers module '" + module_name +
         "'; offered are: " + (offered.empty() ? "none" : offered);
}

std::string names_of(const Offers& offers) {
  std::string text;
  for (const v1::FunctionOffer* offer : offers) {
    const std::string& robot = offer->header().robot();
    text += (text.empty() ? "" : ", ") + offer->owner() + (robot.empty() ? "" : " of " + robot);
  }
  return text;
}

// An owner that has no such values for the function is asked for exact ones.
FunctionAccuracy accuracy_asked(const v1::FunctionOffer& offer, const FunctionCall& call) {
  const auto wanted = static_cast<v1::FunctionAccuracy>(call.accuracy);
  for (const v1::FunctionSignature& function : offer.functions())
    if (function.name() == call.function && std::ranges::count(function.accuracies(), wanted) > 0)
      return call.accuracy;
  return FunctionAccuracy::exact;
}

}  // namespace

OwnerChoice choose_owner(const FunctionOffers& offers, const std::string& module_name,
                         const std::string& robot, const std::function<bool(const std::string&)>& alive) {
  Offers own, general, foreign;
  for (const auto& [key, offer] : offers) {
    if (key.first != module_name) continue;
    const std::string& of = offer.header().robot();
    (of.empty() ? general : robot.empty() || of == robot ? own : foreign).push_back(&offer);
  }
  Offers fit = own.empty() ? general : own;
  if (fit.size() > 1) {
    const auto is_gone = [&](const v1::FunctionOffer* offer) { return !alive(offer->owner()); };
    if (!std::ranges::all_of(fit, is_gone)) std::erase_if(fit, is_gone);
  }
  if (fit.size() == 1) return {fit.front()};
  if (!fit.empty())
    return {nullptr, "several services offer module '" + module_name + "': " + names_of(fit) +
                         "; give each its robot in 'services', and the executive that asks"};
  if (!foreign.empty())
    return {nullptr, "no service offers module '" + module_name + "' for robot '" + robot +
                         "'; it is offered by: " + names_of(foreign)};
  return {nullptr, no_offer(offers, module_name)};
}

FunctionOwners::FunctionOwners(services::Node& node, temporal::Duration timeout)
    : node_(node), timeout_(timeout), client_(node, services::topics::function_call) {
  services::subscribe(node, services::topics::function_offer, [this](const v1::FunctionOffer& offer) {
    const std::pair key{offer.module_name(), offer.owner()};
    if (offers_.size() < kOffers || offers_.contains(key)) return void(offers_[key] = offer);
    if (const std::uint64_t count = refusals_.note("offer"))
      services::log::warning("an offer of functions by " + offer.owner().substr(0, kNameBytes) +
                             " is not taken in: " + std::to_string(kOffers) + " are kept (" +
                             std::to_string(count) + " refused so far)");
  });
}

void FunctionOwners::ask(std::vector<FunctionCall> calls, const engine::Request& request, Done done) {
  const OwnerChoice choice =
      choose_owner(offers_, calls.front().module, request.robot,
                   [this](const std::string& owner) { return node_.peer_alive(owner); });
  if (choice.offer == nullptr)
    return done({calls.size(), FunctionValue{FunctionOutcome::unavailable, 0, {}, choice.reason}});
  const v1::FunctionOffer& offer = *choice.offer;
  const Provenance asked{offer.owner(), std::to_string(offer.model_version()), node_.now()};
  const FunctionAccuracy accuracy = accuracy_asked(offer, calls.front());
  for (FunctionCall& call : calls) call.accuracy = accuracy;
  const std::uint64_t number = ++asked_;
  asking_ = number;
  client_.call(to_wire(calls, request.objects), offer.owner(), timeout_,
               [this, calls, asked, number, done = std::move(done)](const auto& result) {
                 if (asking_ != number) return;
                 asking_.reset();
                 done(values_of(calls, asked, result));
               });
}

bool FunctionOwners::forget() { return std::exchange(asking_, std::nullopt).has_value(); }

}  // namespace roci::planner
