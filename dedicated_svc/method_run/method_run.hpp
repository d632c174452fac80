// A method run is one command under way (R145, R146): it says which call comes next, what its answer means, and when
// the command is over. It is pure: answers of calls go in, what to call comes out.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/value.hpp"
#include "dedicated_svc/methods/method.hpp"

namespace roci::dedicated::method_run {

/// What was observed last, by timeline.
using Observations = std::map<std::string, temporal::Value>;

/// Holds a call with all names filled in.
struct Ask {
  /// Counts the calls of this run from 1, so that the same answers give the same numbers.
  std::uint32_t number = 0;
  methods::Call call;
};

/// Says how a call went.
struct Answer {
  std::string error{};   ///< a stable code; empty: it went well
  std::string reason{};  ///< in words
  std::map<std::string, temporal::Value> values{};
  std::optional<double> energy_j{};
};

/// Holds what decided a step of a run: with the same ones in the same order a run comes to the same call.
struct Taken {
  Answer answer;
  Observations observed;  ///< all that the method asks for
};

/// Says how the command ended.
struct End {
  std::string error{};  ///< empty: it is carried out. The failed call's, or wrong-value (R145)
  std::string reason{};
  /// Holds what `results` says where it succeeded, else what the failed call brought.
  std::map<std::string, temporal::Value> values{};
  std::optional<double> energy_j{};  ///< of all calls, repairs included; empty: some call told none
  std::string call{};                ///< whose error it is
};

/// Says what comes next: a call, or the end. `repairing` is not empty where the call begins a repair: whoever hosts the
/// run must be allowed to (owner::CommandServer::repair), else it says so by forbid_repair().
struct Step {
  std::optional<Ask> ask{};
  std::optional<End> end{};
  std::string repairing{};
};

/// The method outlives the run.
class MethodRun {
 public:
  /// The arguments are those of the command; all that the method lists are among them.
  MethodRun(const methods::Method& method, std::map<std::string, std::string> arguments);

  /// The first call.
  Step begin();
  /// Takes the answer to the call that was asked for last.
  Step take(const Answer& answer, const Observations& observed);
  /// Begins, and takes what an earlier run of this command has taken: returns the step that that one came to. Neither
  /// call nor end, if it would have ended before: it was another method.
  Step begin_after(const std::vector<Taken>& taken);
  /// Returns the numbers of what is observed that this method's repairs need.
  Observations needed(const Observations& observed) const;
  /// Why a repair is under way; empty: none is.
  std::string repairing() const { return go_on_ ? error_.reason : std::string{}; }
  /// Instead of the repair's first call: there is no time for it, so the error that it was for stands.
  End forbid_repair();

  /// The state to be shown while it runs, when it is carried out, and where it failed.
  temporal::Value during() const;
  temporal::Value then(const methods::Shown& rest) const;
  temporal::Value failed(const End& end, const methods::Shown& rest) const;
  /// What is to be said of other timelines in the end.
  std::map<std::string, temporal::Value> told(const End& end) const;

 private:
  // Where the run stands: in the method's own calls, or in those of a repair.
  struct Position {
    const std::vector<methods::Call>* calls;
    std::size_t index;
  };

  const methods::Call& current() const { return (*at_.calls)[at_.index]; }
  Step ask();
  void forget(const std::string& front);  // values whose names begin so
  Step advance();
  Step fail(const Answer& answer, const Observations& observed);
  Step wrong_value(const std::string& reason, std::map<std::string, temporal::Value> values);
  std::optional<double> energy_j() const { return energy_known_ ? std::optional(energy_j_) : std::nullopt; }
  bool fits(const methods::Repair& repair, const Observations& observed) const;
  End ended(std::string error, std::string reason, std::map<std::string, temporal::Value> values) const;
  std::optional<std::string> value_of(const std::string& name) const;
  std::optional<methods::Call> filled(const methods::Call& call) const;
  temporal::Value shown(const methods::Shown& what) const;

  const methods::Method* method_;
  std::map<std::string, std::string> arguments_;
  Position at_;
  std::uint32_t number_ = 0;
  const methods::Repair* repair_ = nullptr;  // the last that was begun
  // During a repair: index of the method's call that follows it, or their number.
  std::optional<std::size_t> go_on_;
  End error_;                                      // that is being repaired
  std::map<std::string, std::uint32_t> repaired_;  // how often, as the method names them
  std::map<std::string, temporal::Value> values_;  // by "call.value"
  double energy_j_ = 0;
  bool energy_known_ = true;
};

/// Returns a value as a template gets it: a number as short as it reads back the same, a state by its name.
std::string to_argument(const temporal::Value& value);

}  // namespace roci::dedicated::method_run
