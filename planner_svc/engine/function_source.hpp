// Where engines get the values of external functions (R35, R36): in batches, from whoever owns
// them.
//
// The interface is synchronous and holds no clock: a source that asks another process waits there under its
// own deadline and answers late for what did not come in time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::planner::engine {

/// One tuple of one function of one module.
struct FunctionCall {
  std::string module;
  std::string function;
  std::vector<std::string> arguments;  ///< object names

  bool operator==(const FunctionCall&) const = default;
};

enum class FunctionOutcome {
  value,
  unreachable,     ///< the owner says that no value exists: the action instance that needs it does not exist
  unavailable,     ///< nobody owns the function, or its owner cannot say
  owner_lost,      ///< the owner died while it was asked
  late,            ///< the owner did not answer within the source's deadline
  not_a_number,    ///< NaN or infinite
  wrong_arity,     ///< the owner knows the function with another number of arguments
  unknown_object,  ///< the owner does not know one of the objects
};

/// "value", "unreachable", …: as written in reports and files.
const char* to_string(FunctionOutcome outcome);

/// Who said so, from which model, and when: microseconds of mission time.
struct Provenance {
  std::string owner;
  std::string model_version;
  temporal::Time time{0};

  bool operator==(const Provenance&) const = default;
};

struct FunctionValue {
  FunctionOutcome outcome = FunctionOutcome::unavailable;
  double value = 0;  ///< with value: finite
  Provenance provenance;
  std::string reason;  ///< the owner's own words, may be empty
};

/// One tuple that was asked for, and what its owner said.
struct FunctionUse {
  FunctionCall call;
  FunctionValue answer;
};

class FunctionSource {
 public:
  virtual ~FunctionSource() = default;

  /// One value per call, in the same order; an answer of another length counts as unavailable for all. All
  /// calls of a batch belong to one function. Returns early, with late for the rest, once `cancelled` returns
  /// true.
  virtual std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                              const std::function<bool()>& cancelled) = 0;
};

/// For domains without modules: owns nothing.
class NoFunctions final : public FunctionSource {
 public:
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled) override;
};

}  // namespace roci::planner::engine
