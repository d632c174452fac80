#include "drill.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "commandPubSubTypes.h"
#include "functionPubSubTypes.h"

namespace borehole {
namespace {

constexpr double kSetUpS = 60, kPerMetreS = 400, kDeepestM = 5, kHardBelowM = 1, kAgainS = 30;

double bore_s(double depth_m) { return kSetUpS + kPerMetreS * depth_m; }

std::int64_t us(double seconds) { return static_cast<std::int64_t>(seconds * 1e6); }

// Empty if there is none of that name.
std::string property(const std::vector<v1::Property>& properties, const std::string& name) {
  for (const v1::Property& one : properties)
    if (one.name() == name) return one.value();
  return "";
}

}  // namespace

Drill::Drill(Clock& clock, const Options& options)
    : clock_(clock),
      options_(options),
      offers_(clock.advertise<v1::FunctionOfferPubSubType>("roci/function/offer", Durability::state)),
      replies_(clock.advertise<v1::FunctionReplyPubSubType>("roci/function/reply", Durability::request)),
      observations_(clock.advertise<v1::ObservationPubSubType>("roci/observation", Durability::state)),
      commands_(clock, options.name, *this) {
  clock.read<v1::FunctionRequestPubSubType, v1::FunctionRequest>(
      "roci/function/request", Durability::request,
      [this](const v1::FunctionRequest& request) { answer(request); });
  clock.next_us = [this] {
    const auto end = commands_.next_overrun_us();
    return !due_us_ || (end && *end < *due_us_) ? end : due_us_;
  };
  clock.wake = [this] { wake(); };

  v1::FunctionSignature bore_time;
  bore_time.name("bore_time");
  bore_time.parameter_types({"place"});
  bore_time.unit("s");
  v1::FunctionOffer offer;
  offer.module_name("drill");
  offer.owner(options.name);
  offer.model_version(1);
  offer.functions().push_back(bore_time);
  clock_.write(offers_, offer);
}

void Drill::wake() {
  if (due_us_ && *due_us_ <= clock_.now_us()) {
    due_us_.reset();
    running_ ? bored() : report("drill", "idle");
  }
  commands_.overrun();
}

// The function: one outcome for each place of each batch.
void Drill::answer(const v1::FunctionRequest& request) {
  const std::string& asked = request.request().instance_name();
  if (request.module_name() != "drill" || (!asked.empty() && asked != options_.name)) return;
  v1::FunctionReply reply;
  reply.reply().related_request_id(request.request().request_id());
  reply.reply().remote_ex(v1::REMOTE_EX_OK);
  reply.owner(options_.name);
  reply.model_version(1);
  reply.computed_us(clock_.now_us());
  for (const v1::FunctionBatch& batch : request.batches()) reply.results().push_back(values(request, batch));
  clock_.write(replies_, reply);
}

v1::FunctionValues Drill::values(const v1::FunctionRequest& request, const v1::FunctionBatch& batch) const {
  v1::FunctionValues values;
  values.function(batch.function());
  const std::size_t arity = std::max<std::size_t>(batch.arity(), 1);
  for (std::size_t tuple = 0; tuple < batch.tuples().size(); tuple += arity) {
    const std::uint32_t object = batch.tuples()[tuple];
    v1::FunctionOutcome outcome = batch.function() != "bore_time" ? v1::FUNCTION_UNKNOWN_FUNCTION
                                  : arity != 1                    ? v1::FUNCTION_WRONG_ARITY
                                                                  : v1::FUNCTION_UNKNOWN_OBJECT;
    double number = 0;
    if (outcome == v1::FUNCTION_UNKNOWN_OBJECT && object < request.objects().size()) {
      const std::string depth = property(request.objects()[object].properties(), "depth");
      const double depth_m = std::atof(depth.c_str());
      if (!depth.empty()) outcome = depth_m > kDeepestM ? v1::FUNCTION_UNREACHABLE : v1::FUNCTION_VALUE;
      if (outcome == v1::FUNCTION_VALUE) number = bore_s(depth_m);
    }
    values.outcomes().push_back(outcome);
    values.numbers().push_back(number);
  }
  return values;
}

void Drill::carry_out(const CommandKey& key, const v1::Command& request) {
  if (request.command_name() != "bore")
    return commands_.say(key, {v1::STAGE_REJECTED, "unknown-command", "it can only bore"});
  if (running_) return commands_.say(key, {v1::STAGE_REJECTED, "busy", "it still bores"});
  const double depth_m = std::atof(property(request.arguments(), "depth").c_str());
  running_ = key;
  place_ = property(request.arguments(), "place");
  hard_ = depth_m > kHardBelowM;
  commands_.say(key, {v1::STAGE_ACCEPTED});
  report("drill", "boring");
  due_us_ = clock_.now_us() + us(bore_s(depth_m));
}

void Drill::bored() {
  if (std::exchange(hard_, false)) {
    if (!commands_.repair(*running_, "the bit jammed; it tries again"))
      return rest({v1::STAGE_FAILED, "jammed", "the rock is hard, and no time is left"});
    due_us_ = clock_.now_us() + us(kAgainS);
    return;
  }
  report("drill.hole." + place_, "bored");
  rest({v1::STAGE_COMPLETED, "done", "", 1200});
}

void Drill::break_off(const CommandKey& key, const CommandStatus& why) {
  if (running_ == key) rest(why);
}

void Drill::rest(const CommandStatus& last) {
  due_us_.reset();
  report("drill", "idle");
  commands_.say(*std::exchange(running_, std::nullopt), last);
}

void Drill::report(const std::string& timeline, const std::string& state) {
  v1::Observation seen;
  seen.timeline(options_.robot + "." + timeline);
  seen.observed().kind(v1::VALUE_STATE);
  seen.observed().state(state);
  seen.sampled_us(clock_.now_us());
  clock_.write(observations_, seen);
}

}  // namespace borehole
