#include <algorithm>
#include <iterator>

#include "core/pddl/grammar.hpp"

namespace roci::pddl::grammar {

namespace {

std::optional<AssignmentOperator> as_assignment(std::string_view word) {
  if (word == "assign") return AssignmentOperator::assign;
  if (word == "increase") return AssignmentOperator::increase;
  if (word == "decrease") return AssignmentOperator::decrease;
  if (word == "scale-up") return AssignmentOperator::scale_up;
  if (word == "scale-down") return AssignmentOperator::scale_down;
  return {};
}

Effect read_assignment(const Sexpr& s, AssignmentOperator op, const Source& source) {
  if (s.items().size() != 3) {
    source.fail(s.where, "'" + std::string(s.head()) + "' needs a function and a value",
                "write (" + std::string(s.head()) + " (f …) VALUE)");
  }
  return {Assignment{op, read_function(s.items()[1], source), read_expression(s.items()[2], source)},
          s.where};
}

void require_body(const Sexpr& s, std::string_view form, const Source& source) {
  if (s.items().size() == 3) return;
  source.fail(
      s.where,
      "'" + std::string(s.head()) + "' effect with " + std::to_string(s.items().size() - 1) + " parts, not 2",
      "write " + std::string(form));
}

void add_effects(const Sexpr& s, TimePoint moment, std::vector<Effect>& out, const Source& source) {
  require_list(s, "an effect", source);
  const std::string_view head = s.head();
  if (s.items().empty()) return;
  if (head == "and") {
    for (const Sexpr& item : rest(s)) source.attempt([&] { add_effects(item, moment, out, source); });
  } else if (head == "not") {
    if (s.items().size() != 2) source.fail(s.where, "'not' needs one atom", "write (not (p …))");
    out.push_back({Literal{read_atom(s.items()[1], "an atom", source), true}, s.where});
  } else if (head == "forall") {
    require_body(s, "(forall (?x - TYPE …) EFFECT)", source);
    auto variables = read_variables(s.items()[1], source);
    out.push_back({ForallEffect{std::move(variables), read_effects(s.items()[2], moment, source)}, s.where});
  } else if (head == "when") {
    require_body(s, "(when CONDITION EFFECT)", source);
    When when;
    (moment == TimePoint::start ? when.condition.at_start : when.condition.at_end) =
        read_condition(s.items()[1], source);
    when.effects = read_effects(s.items()[2], moment, source);
    out.push_back({std::move(when), s.where});
  } else if (const auto op = as_assignment(head)) {
    out.push_back(read_assignment(s, *op, source));
  } else if (head == "or" || head == "imply" || head == "exists") {
    source.fail(s.where, "'" + std::string(head) + "' in an effect",
                "effects are certain: use and, forall, when");
  } else {
    out.push_back({Literal{read_atom(s, "an effect", source), false}, s.where});
  }
}

// ---- Effects of durative actions

void append(std::vector<Effect> from, std::vector<Effect>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Puts each non-empty part of `inner` into the same part of `out`, wrapped by `wrap`.
template <typename Wrap>
void add_wrapped(DurativeEffects inner, DurativeEffects& out, Wrap wrap) {
  if (!inner.at_start.empty()) out.at_start.push_back(wrap(std::move(inner.at_start)));
  if (!inner.at_end.empty()) out.at_end.push_back(wrap(std::move(inner.at_end)));
  if (!inner.continuous.empty()) out.continuous.push_back(wrap(std::move(inner.continuous)));
}

bool mentions_continuous_time(const Sexpr& s) {
  return s.is_word("#t") || std::any_of(s.items().begin(), s.items().end(), mentions_continuous_time);
}

void add_durative(const Sexpr& s, DurativeEffects& out, const Source& source) {
  require_list(s, "an effect", source);
  const std::string_view head = s.head();
  if (s.items().empty()) return;
  if (head == "and") {
    for (const Sexpr& item : rest(s)) source.attempt([&] { add_durative(item, out, source); });
  } else if (head == "forall") {
    require_body(s, "(forall (?x - TYPE …) EFFECT)", source);
    const auto variables = read_variables(s.items()[1], source);
    add_wrapped(read_durative_effects(s.items()[2], source), out, [&](std::vector<Effect> effects) {
      return Effect{ForallEffect{variables, std::move(effects)}, s.where};
    });
  } else if (head == "when") {
    require_body(s, "(when CONDITION EFFECT)", source);
    const TimedCondition condition = read_timed_condition(s.items()[1], source);
    add_wrapped(read_durative_effects(s.items()[2], source), out, [&](std::vector<Effect> effects) {
      return Effect{When{condition, std::move(effects)}, s.where};
    });
  } else if (s.items().size() == 3 && head == "at" && s.items()[1].is_word("start")) {
    append(read_effects(s.items()[2], TimePoint::start, source), out.at_start);
  } else if (s.items().size() == 3 && head == "at" && s.items()[1].is_word("end")) {
    append(read_effects(s.items()[2], TimePoint::end, source), out.at_end);
  } else if (const auto op = as_assignment(head); op && mentions_continuous_time(s)) {
    out.continuous.push_back(read_assignment(s, *op, source));
  } else {
    source.fail(s.where, "an effect of a durative action without a time",
                "write (at start …) or (at end …) around it");
  }
}

}  // namespace

std::vector<Effect> read_effects(const Sexpr& s, TimePoint moment, const Source& source) {
  std::vector<Effect> effects;
  add_effects(s, moment, effects, source);
  return effects;
}

DurativeEffects read_durative_effects(const Sexpr& s, const Source& source) {
  DurativeEffects effects;
  add_durative(s, effects, source);
  return effects;
}

}  // namespace roci::pddl::grammar
