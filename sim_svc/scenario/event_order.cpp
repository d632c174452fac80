#include "sim_svc/scenario/event_order.hpp"

#include <utility>

namespace roci::sim::scenario {

EventOrder::EventOrder(std::vector<ExpectedEvent> expected) : expected_(std::move(expected)) {
  for (const ExpectedEvent& event : expected_) codes_.insert(event.code);
}

void EventOrder::note(std::string_view code, std::string_view text) {
  if (!fault_.empty() || !codes_.contains(code)) return;
  if (matches(seen_, code, text)) {
    ++seen_;
    return;
  }
  if (seen_ > 0 && expected_[seen_ - 1].repeats && matches(seen_ - 1, code, text)) return;
  fault_ = next() + ", but there was " + std::string(code) + ": " + std::string(text);
}

bool EventOrder::matches(std::size_t index, std::string_view code, std::string_view text) const {
  if (index >= expected_.size()) return false;
  const ExpectedEvent& event = expected_[index];
  return event.code == code && text.find(event.part) != std::string_view::npos;
}

std::string EventOrder::final_fault() const {
  if (!fault_.empty() || seen_ == expected_.size()) return fault_;
  return next() + ", but the run ended";
}

std::string EventOrder::next() const {
  std::string out =
      "after " + std::to_string(seen_) + " of " + std::to_string(expected_.size()) + " events, ";
  if (seen_ == expected_.size()) return out + "no further one was expected";
  const ExpectedEvent& event = expected_[seen_];
  return out + event.code + (event.part.empty() ? "" : " (" + event.part + ")") + " was expected";
}

}  // namespace roci::sim::scenario
