// This is what every owner of external functions does on the wire (R35-R39): the offer, and one outcome for
// each tuple of each batch.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "roci_idl/function.h"

namespace roci::services::wire {

/// Describes an external function that an owner offers.
struct OwnedFunction {
  std::string name;
  std::vector<std::string> parameter_types;
  std::string unit;
  /// Holds what can be asked for; empty: exact values alone. A value of ACCURACY_LOWER_BOUND is
  /// never above the exact one.
  std::vector<v1::FunctionAccuracy> accuracies{};
  /// Names the timelines whose values it takes into account.
  std::vector<std::string> depends_on{};

  bool offers(v1::FunctionAccuracy accuracy) const;
};

/// Says what an evaluation of one tuple came to.
struct FunctionResult {
  v1::FunctionOutcome outcome = v1::FUNCTION_FAILED;
  double number = 0;  ///< with FUNCTION_VALUE: in the function's unit
};

/// Evaluates one tuple: it gets one of the owned functions, as many objects as that has parameters, and an
/// accuracy that it offers.
using Evaluator = std::function<FunctionResult(const OwnedFunction&, std::span<const v1::PlanObject* const>,
                                               v1::FunctionAccuracy)>;

v1::FunctionOffer function_offer(const std::string& module_name, const std::string& owner,
                                 std::uint64_t model_version, const std::vector<OwnedFunction>& functions);

/// Answers every tuple; unknown functions, wrong arities and indices beyond the request's objects are reported as
/// such without asking `evaluate`. Where a function does not offer the accuracy asked for, the reply has the exact
/// value and says so. Once stopped, the rest is FUNCTION_FAILED.
v1::FunctionReply answer_batches(const v1::FunctionRequest& request, std::uint64_t model_version,
                                 const std::vector<OwnedFunction>& functions, const Evaluator& evaluate,
                                 const std::stop_token& stop);

/// Write and read, by object, why tuples with it have no value, in the owner's words: "place-1" → "the rover cannot
/// stand there". They travel in the reply's remote_message, a line "OBJECT: WORDS" each; control characters in them
/// become blanks.
void put_words(v1::FunctionReply& reply, const std::map<std::string, std::string>& words);
std::map<std::string, std::string> words_of(const v1::FunctionReply& reply);

/// Returns the value of the property, or null if the object has none of that name.
const std::string* property(const v1::PlanObject& object, const std::string& name);
/// Returns the value of the property as a number if it is there and finite.
std::optional<double> finite_property(const v1::PlanObject& object, const std::string& name);

}  // namespace roci::services::wire
