// The events that a scenario expects are compared with those that come.
#pragma once
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace roci::sim::scenario {

/// Describes an event that the scenario expects.
struct ExpectedEvent {
  std::string code;
  std::string part;      ///< belongs to the event's text; empty: any text
  bool repeats = false;  ///< once or more
};

/// Watches whether the events of a run come as its scenario expects: of those whose codes stand in the list
/// exactly the listed ones come, in this order. Others may lie between.
class EventOrder {
 public:
  explicit EventOrder(std::vector<ExpectedEvent>);

  void note(std::string_view code, std::string_view text);

  std::size_t expected() const { return expected_.size(); }
  /// Names the first event that did not come as expected, once and for all; the text is empty while all did.
  const std::string& fault() const { return fault_; }
  /// Returns the fault of a run that ends now: fault(), or what is still missing.
  std::string final_fault() const;

 private:
  bool matches(std::size_t index, std::string_view code, std::string_view text) const;
  std::string next() const;

  std::vector<ExpectedEvent> expected_;
  std::set<std::string, std::less<>> codes_;
  std::size_t seen_ = 0;
  std::string fault_;
};

}  // namespace roci::sim::scenario
