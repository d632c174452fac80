#include "services/node/contract_gate.hpp"

#include <utility>

#include "services/bounds/limits.hpp"
#include "services/log/log.hpp"
#include "services/node/make_event.hpp"

namespace roci::services::node {
namespace {

v1::Event event_of(const ContractMismatch& mismatch) {
  return make_event(v1::SEVERITY_ERROR, "contract.mismatch", to_text(mismatch),
                    {{"topic", mismatch.topic},
                     {"participant", mismatch.participant},
                     {"own_build", mismatch.own_build},
                     {"own_hash", mismatch.own_hash},
                     {"other_build", mismatch.other_build},
                     {"other_hash", mismatch.other_hash}});
}

}  // namespace

ContractGate::ContractGate(ContractCheck& check, std::function<void(Arrival&&)> pass,
                           std::function<void()> prepare, std::function<void(const v1::Event&)> tell)
    : check_(check), pass_(std::move(pass)), prepare_(std::move(prepare)), tell_(std::move(tell)) {}

void ContractGate::arrive(Arrival&& arrival) {
  if (!held_.empty()) retry_held();
  switch (check_.judge(arrival.topic->contract, arrival.sample.writer)) {
    case ContractCheck::Agreement::same:
      return pass_(std::move(arrival));
    case ContractCheck::Agreement::different:
      ++refused_;
      return;
    case ContractCheck::Agreement::unknown:
      held_bytes_ += arrival.sample.payload.size();
      held_.push_back(std::move(arrival));
      while (held_.size() > kHeldBack || held_bytes_ > bounds::kHeldBytes) {
        held_bytes_ -= held_.front().sample.payload.size();
        held_.pop_front();
        ++refused_;
      }
  }
}

void ContractGate::retry_held() {
  held_bytes_ = 0;
  for (Arrival& arrival : std::exchange(held_, {})) {
    const auto agreement = check_.judge(arrival.topic->contract, arrival.sample.writer);
    if (agreement == ContractCheck::Agreement::unknown) {
      held_bytes_ += arrival.sample.payload.size();
      held_.push_back(std::move(arrival));
    } else if (agreement == ContractCheck::Agreement::same) {
      pass_(std::move(arrival));
    } else {
      ++refused_;
    }
  }
}

void ContractGate::tell_later(v1::Event event, clock::WallTime now) {
  prepare_();
  untold_.push_back({now + clock::wall_seconds(kTellAfterS), std::move(event)});
}

void ContractGate::tell_now(const v1::Event& event) {
  prepare_();
  tell_(event);
}

void ContractGate::turn(clock::WallTime now) {
  if (!held_.empty()) retry_held();
  for (const ContractMismatch& mismatch : check_.take_mismatches()) {
    log::error(to_text(mismatch));
    tell_later(event_of(mismatch), now);
  }
  while (!untold_.empty() && untold_.front().due <= now) {
    tell_(untold_.front().event);
    untold_.pop_front();
  }
}

}  // namespace roci::services::node
