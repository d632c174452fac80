// Engines get the values of external functions (R35, R36) from a function source: in batches, from whoever
// owns them.
//
// The interface is synchronous and holds no clock: a source that asks another process waits there under its
// own deadline and answers late for what did not come in time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::engine {

/// Says which values an engine asks owners for, and when (docs/external-functions.md).
enum class FunctionsMode {
  eager,         ///< every typed tuple exactly, before the search (R37)
  lazy,          ///< exactly, and only what searches touch
  two_accuracy,  ///< every typed tuple as a lower bound, and exactly what a candidate plan stands on
};

/// Returns "eager", "lazy" or "two_accuracy", as written in mission files.
const char* to_string(FunctionsMode mode);
/// Returns the mode of that name, where '-' may stand for '_', or nothing for any other text.
std::optional<FunctionsMode> functions_mode_named(std::string_view name);

/// Holds a number that a timeline is assumed to have while a function is evaluated.
struct AssumedValue {
  std::string timeline;
  double number = 0;
  std::string object;  ///< that stands for the number in the engine's model: "battery-20"

  bool operator==(const AssumedValue&) const = default;
};

/// Names one tuple of one function of one module.
struct FunctionCall {
  std::string module;
  std::string function;
  std::vector<std::string> arguments;  ///< object names
  temporal::FunctionAccuracy accuracy = temporal::FunctionAccuracy::exact;
  std::vector<AssumedValue> state{};  ///< values of the timelines on which the function depends

  bool operator==(const FunctionCall&) const = default;
};

/// Returns "(traverse_time a b)"; objects that stand for assumed values follow the arguments.
std::string application(const FunctionCall& call);

/// Says whether a call brought a value, or why not.
enum class FunctionOutcome {
  value,
  unreachable,   ///< the owner proved that no value exists: the action instance that needs it does not exist
  unknown,       ///< the owner found no value with the effort spent: as unreachable, but nothing is proved
  unavailable,   ///< nobody owns the function, or its owner cannot say
  owner_lost,    ///< the owner died while it was asked
  late,          ///< the owner did not answer within the source's deadline
  not_a_number,  ///< NaN or infinite
  wrong_arity,   ///< the owner knows the function with another number of arguments
  unknown_object,  ///< the owner does not know one of the objects
};

/// Returns "value", "unreachable", …, as written in reports and files.
const char* to_string(FunctionOutcome outcome);

/// Says who gave a value, from which model, and at which mission time.
struct Provenance {
  std::string owner;
  std::string model_version;
  temporal::Time time{0};

  bool operator==(const Provenance&) const = default;
};

/// Shares a Provenance that many values have: all values of one answer point to the same.
class SharedProvenance {
 public:
  SharedProvenance() = default;  ///< of nobody
  SharedProvenance(Provenance said) : said_(std::make_shared<const Provenance>(std::move(said))) {}
  SharedProvenance(std::string owner, std::string model_version, temporal::Time time)
      : SharedProvenance(Provenance{std::move(owner), std::move(model_version), time}) {}

  const Provenance& operator*() const { return said_ ? *said_ : nobody(); }
  const Provenance* operator->() const { return &**this; }

 private:
  static const Provenance& nobody() {
    static const Provenance none;
    return none;
  }

  std::shared_ptr<const Provenance> said_;
};

/// Holds the answer to one call, with its provenance.
struct FunctionValue {
  FunctionOutcome outcome = FunctionOutcome::unavailable;
  double value = 0;  ///< with value: finite
  SharedProvenance provenance;
  std::string reason;  ///< the owner's own words, may be empty
  /// Says how accurate the value is: an owner that has no bounds gives exact values where these are asked
  /// for.
  temporal::FunctionAccuracy accuracy = temporal::FunctionAccuracy::exact;

  bool is_exact() const { return accuracy == temporal::FunctionAccuracy::exact; }
};

/// Holds one tuple that was asked for, and what its owner said.
struct FunctionUse {
  FunctionCall call;
  FunctionValue answer;
};

/// Gives values of external functions, and says for each call why there is none.
class FunctionSource {
 public:
  virtual ~FunctionSource() = default;

  /// Returns one value per call, in the same order; an answer of another length counts as unavailable for all. All
  /// calls of a batch belong to one function, ask for one accuracy and assume one state. Returns early, with late for
  /// the rest, once `cancelled` returns true.
  virtual std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                              const std::function<bool()>& cancelled) = 0;
};

/// Gives no values, for domains without modules.
class NoFunctions final : public FunctionSource {
 public:
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled) override;
};

}  // namespace roci::planner::engine
