#include "services/owner/value_json.hpp"

#include <nlohmann/json.hpp>

namespace roci::services::owner {

using nlohmann::json;

json to_json(const temporal::Value& value) {
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  if (const auto* number = std::get_if<double>(&value)) return *number;  // no finite one: null
  if (const auto* state = std::get_if<temporal::State>(&value))
    return {{"state", state->name}, {"arguments", state->arguments}};
  return nullptr;
}

temporal::Value value_in(const json& in) {
  if (in.is_boolean()) return in.get<bool>();
  if (in.is_number()) return in.get<double>();
  if (in.is_object()) return temporal::state(in.at("state"), in.at("arguments"));
  return {};
}

}  // namespace roci::services::owner
