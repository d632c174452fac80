#include "planner_svc/utility_htn/reading/names.hpp"

#include <algorithm>
#include <cmath>

#include "core/words/nearest_word.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"

namespace roci::planner::utility_htn::reading {

using model::Amount;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

namespace {

constexpr std::size_t kFew = 12;

// What is known, where it is little enough to read; else what to do.
template <typename Words>
std::string listed(const Words& known) {
  if (known.empty() || known.size() > kFew) return "declare it";
  std::string out;
  for (const std::string& one : known) out += (out.empty() ? "known: " : ", ") + one;
  return out;
}

double number_of(const std::string& operand, const Source& source) {
  const Expression expression = parse_expression(operand);
  if (!expression.fault.empty()) source.fail(expression.fault);
  if (!expression.name.empty())
    source.fail("'" + expression.name + "' is no number; a constraint on numbers compares with a number");
  return expression.constant;
}

// "none" on either side of a range is no bound.
double bound_of(const std::string& operand, double none, const Source& source) {
  return operand == "none" ? none : number_of(operand, source);
}

void compare_numbers(const Comparison& comparison, Constraint& out, const Source& source) {
  if (comparison.range) {
    out.lowest = bound_of(comparison.operands[0], out.lowest, source);
    out.highest = bound_of(comparison.operands[1], out.highest, source);
    if (out.lowest > out.highest)
      source.fail("no number lies within these bounds; write the lower one first");
    return;
  }
  if (comparison.relation == "!=" || comparison.relation == "in")
    source.fail("the values of '" + comparison.timeline +
                "' are numbers; write '>=', '<=', '=' or 'in LOWEST .. HIGHEST'");
  const double number = number_of(comparison.operands.front(), source);
  if (comparison.relation != "<=") out.lowest = number;
  if (comparison.relation != ">=") out.highest = number;
}

}  // namespace

void Names::add(const std::string& name, const Source& source) {
  const auto [entry, added] =
      known_.emplace(name, Known{static_cast<std::uint32_t>(known_.size()), source.entry().place()});
  if (!added)
    source.fail("there is a " + kind_ + " '" + name + "' already, at " + entry->second.place +
                "; rename one");
}

std::uint32_t Names::index(std::string_view name, const Source& source) const {
  if (faulty_.contains(name)) unknown_->fail_again(source);
  if (const auto found = known_.find(name); found != known_.end()) return found->second.index;
  std::vector<std::string> all;
  for (const auto& [known, entry] : known_) all.push_back(known);
  unknown_->fail({kind_, std::string(name), "unknown " + kind_ + " '" + std::string(name) + "'",
                  words::nearest(name, all).remedy(listed(all))},
                 source);
}

Amount Vocabulary::amount(const Source& source) const {
  const Expression expression = parse_expression(source.text());
  if (!expression.fault.empty()) source.fail(expression.fault);
  Amount out;
  out.constant = expression.constant;
  if (expression.name.empty()) return out;
  out.parameter = parameters.index(expression.name, source);
  out.factor = expression.factor;
  return out;
}

Amount Vocabulary::amount_or(const Source& source, std::string_view key, double fallback) const {
  const auto found = source.find(key);
  return found ? amount(*found) : Amount{fallback, {}, 1};
}

std::uint32_t Vocabulary::state(const Definition& timeline, std::string_view name,
                                const Source& source) const {
  const auto found = std::ranges::find(timeline.states, name);
  if (found == timeline.states.end())
    source.fail("'" + timeline.name + "' has no state '" + std::string(name) + "'; " +
                words::nearest(name, timeline.states).remedy(listed(timeline.states)));
  return static_cast<std::uint32_t>(found - timeline.states.begin());
}

Constraint Vocabulary::constraint(const Source& source, Phase phase) const {
  const std::string text = source.text();
  const Comparison comparison = parse_comparison(text);
  if (!comparison.fault.empty()) source.fail(comparison.fault);
  Constraint out;
  out.timeline = timelines.index(comparison.timeline, source);
  out.phase = phase;
  const Definition& timeline = network->timelines.at(out.timeline);
  if (timeline.kind != Kind::state) {
    compare_numbers(comparison, out, source);
    return out;
  }
  if (comparison.range || comparison.relation == ">=" || comparison.relation == "<=")
    source.fail("'" + timeline.name + "' has named states, not numbers; write '" + timeline.name +
                " = STATE' or '" + timeline.name + " in STATE, STATE'");
  if (timeline.states.size() > model::kMostStates) source.fail("'" + timeline.name + "' has too many states");
  for (const std::string& operand : comparison.operands)
    out.states |= std::uint64_t{1} << state(timeline, operand, source);
  if (comparison.relation == "!=") {
    const std::size_t count = timeline.states.size();
    out.states = ~out.states & (count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1);
  }
  return out;
}

std::vector<Constraint> Vocabulary::constraints(const std::optional<Source>& source, Phase phase) const {
  std::vector<Constraint> out;
  if (!source) return out;
  for (const Source& one : source->one_or_more())
    one.entry().attempt([&] { out.push_back(constraint(one, phase)); });
  return out;
}

}  // namespace roci::planner::utility_htn::reading
