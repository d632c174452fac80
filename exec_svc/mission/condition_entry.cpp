#include "exec_svc/mission/condition_entry.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::mission {
namespace {

using roci::mission::Entry;
using temporal::Condition;
using temporal::ConditionOp;
using temporal::Value;

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Value read_value(const Entry& entry) {
  if (entry.is_sequence()) {
    std::vector<std::string> words = entry.texts();
    if (words.empty()) entry.fail("expected a state: [name, argument, ...]; give at least its name");
    std::string name = std::move(words.front());
    words.erase(words.begin());
    return temporal::state(std::move(name), std::move(words));
  }
  const std::string text = entry.text();
  if (text == "true" || text == "false") return text == "true";
  if (const auto number = number_in(text)) return *number;
  if (text.empty()) entry.fail("expected true, false, a number or a state's name; give one");
  return temporal::state(text);
}

std::vector<Condition> read_parts(const Entry& list) {
  std::vector<Condition> parts;
  for (const Entry& item : list.items()) parts.push_back(read_condition(item));
  if (parts.empty()) list.fail("expected at least one condition, e.g. {timeline: rover.camera, is: idle}");
  return parts;
}

Condition read_comparison(const Entry& entry) {
  static constexpr std::pair<const char*, ConditionOp> operators[]{
      {"is", ConditionOp::eq},      {"is_not", ConditionOp::ne},   {"below", ConditionOp::lt},
      {"at_most", ConditionOp::le}, {"at_least", ConditionOp::ge}, {"above", ConditionOp::gt}};
  entry.allow_only({"timeline", "is", "is_not", "below", "at_most", "at_least", "above"});
  std::vector<Condition> parts;
  for (const auto& [key, op] : operators) {
    const auto operand = entry.find(key);
    if (!operand) continue;
    const bool any_kind = op == ConditionOp::eq || op == ConditionOp::ne;
    parts.push_back(temporal::compare(entry.at("timeline").text(), op,
                                      any_kind ? read_value(*operand) : Value(operand->number())));
  }
  if (parts.empty())
    entry.fail("a condition compares its timeline; add is, is_not, below, at_most, at_least or above");
  return parts.size() == 1 ? parts.front() : temporal::all_of(parts);
}

}  // namespace

Condition read_condition(const Entry& entry) {
  if (entry.is_sequence()) return temporal::all_of(read_parts(entry));
  const auto all = entry.find("all");
  const auto any = entry.find("any");
  const auto negated = entry.find("not");
  if (all) entry.allow_only({"all"});
  if (any) entry.allow_only({"any"});
  if (negated) entry.allow_only({"not"});
  if (all) return temporal::all_of(read_parts(*all));
  if (any) return temporal::any_of(read_parts(*any));
  if (negated) return temporal::negate(read_condition(*negated));
  return read_comparison(entry);
}

Condition fill_names(const Condition& condition, const std::map<std::string, std::string>& values) {
  Condition out = condition;
  for (temporal::ConditionNode& node : out.nodes) {
    node.timeline = fill_names(node.timeline, values);
    auto* state = std::get_if<temporal::State>(&node.operand);
    if (state == nullptr) continue;
    const bool was_template = state->name.find('{') != std::string::npos;
    state->name = fill_names(state->name, values);
    for (std::string& argument : state->arguments) argument = fill_names(argument, values);
    if (!was_template || !state->arguments.empty()) continue;
    if (const auto number = number_in(state->name)) node.operand = *number;
  }
  return out;
}

}  // namespace roci::exec::mission
