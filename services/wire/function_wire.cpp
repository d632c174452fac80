#include "services/wire/function_wire.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace roci::services::wire {
namespace {

FunctionResult answer_tuple(const v1::FunctionRequest& request, std::span<const std::uint32_t> tuple,
                            const OwnedFunction& function, v1::FunctionAccuracy accuracy,
                            const Evaluator& evaluate) {
  if (tuple.size() != function.parameter_types.size()) return {v1::FUNCTION_WRONG_ARITY};
  std::vector<const v1::PlanObject*> objects;
  for (const std::uint32_t index : tuple) {
    if (index >= request.objects().size()) return {v1::FUNCTION_UNKNOWN_OBJECT};
    objects.push_back(&request.objects()[index]);
  }
  return evaluate(function, objects, accuracy);
}

}  // namespace

bool OwnedFunction::offers(v1::FunctionAccuracy accuracy) const {
  if (accuracies.empty()) return accuracy == v1::ACCURACY_EXACT;
  return std::ranges::find(accuracies, accuracy) != accuracies.end();
}

v1::FunctionOffer function_offer(const std::string& module_name, const std::string& owner,
                                 std::uint64_t model_version, const std::vector<OwnedFunction>& functions) {
  v1::FunctionOffer offer;
  offer.module_name(module_name);
  offer.owner(owner);
  offer.model_version(model_version);
  for (const OwnedFunction& function : functions) {
    v1::FunctionSignature signature;
    signature.name(function.name);
    signature.parameter_types(function.parameter_types);
    signature.unit(function.unit);
    signature.accuracies(function.accuracies);
    signature.depends_on(function.depends_on);
    offer.functions().push_back(signature);
  }
  return offer;
}

v1::FunctionReply answer_batches(const v1::FunctionRequest& request, std::uint64_t model_version,
                                 const std::vector<OwnedFunction>& functions, const Evaluator& evaluate,
                                 const std::stop_token& stop) {
  v1::FunctionReply reply;
  reply.model_version(model_version);
  for (const v1::FunctionBatch& batch : request.batches()) {
    v1::FunctionValues values;
    values.function(batch.function());
    const auto function = std::ranges::find(functions, batch.function(), &OwnedFunction::name);
    const bool offered = function != functions.end() && function->offers(batch.accuracy());
    values.accuracy(offered ? batch.accuracy() : v1::ACCURACY_EXACT);
    const std::size_t arity = std::max<std::size_t>(batch.arity(), 1);
    const std::span<const std::uint32_t> tuples = batch.tuples();
    for (std::size_t i = 0; i < tuples.size(); i += arity) {
      FunctionResult result{v1::FUNCTION_UNKNOWN_FUNCTION};
      if (stop.stop_requested()) {
        result.outcome = v1::FUNCTION_FAILED;
      } else if (function != functions.end()) {
        result = answer_tuple(request, tuples.subspan(i, std::min(arity, tuples.size() - i)), *function,
                              values.accuracy(), evaluate);
      }
      values.numbers().push_back(result.number);
      values.outcomes().push_back(result.outcome);
    }
    reply.results().push_back(values);
  }
  return reply;
}

void put_words(v1::FunctionReply& reply, const std::map<std::string, std::string>& words) {
  std::string lines;
  for (const auto& [object, why] : words) {
    std::string line = object + ": " + why;
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < 0x20; }, ' ');
    lines += line + "\n";
  }
  reply.reply().remote_message(std::move(lines));
}

std::map<std::string, std::string> words_of(const v1::FunctionReply& reply) {
  std::map<std::string, std::string> out;
  std::istringstream lines(reply.reply().remote_message());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) out[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return out;
}

const std::string* property(const v1::PlanObject& object, const std::string& name) {
  const auto found =
      std::ranges::find_if(object.properties(), [&](const auto& entry) { return entry.name() == name; });
  return found == object.properties().end() ? nullptr : &found->value();
}

std::optional<double> finite_property(const v1::PlanObject& object, const std::string& name) {
  const std::string* text = property(object, name);
  if (text == nullptr) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace roci::services::wire
