#include <algorithm>
#include <utility>

#include "core/pddl/grammar.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl::grammar {

namespace {

// Holds the `:keyword VALUE` pairs of an action.
class Fields {
 public:
  Fields(const Sexpr& action, std::initializer_list<std::string_view> known, const Source& source)
      : source_(source) {
    const auto items = rest(action, 2);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Sexpr& key = items[i];
      if (std::ranges::count_if(known, [&](std::string_view name) { return key.is_word(name); }) == 0) {
        report_unknown(key, known);
        if (!key.is_list() && i + 1 < items.size() && items[i + 1].is_list()) ++i;
        continue;
      }
      const bool has_value = i + 1 < items.size() && !is_keyword(items[i + 1]);
      if (!has_value) {
        source.report(key.where, text(key) + " without a value", "write a list after it");
        continue;
      }
      const Sexpr& value = items[++i];
      if (find(key.word())) {
        source.report(key.where, text(key) + " stands twice", "keep one");
      } else {
        fields_.emplace_back(key.word(), &value);
      }
    }
  }

  // Reads the field, if there is one. Returns whether nothing is wrong with it.
  template <typename Read>
  bool read(std::string_view key, Read read) const {
    const Sexpr* const value = find(key);
    if (!value) return true;
    return source_.attempt([&] {
      if (!value->is_list()) require_list(*value, "a list after " + std::string(key), source_);
      read(*value);
    });
  }

  bool has(std::string_view key) const { return find(key) != nullptr; }

 private:
  const Sexpr* find(std::string_view key) const {
    for (const auto& [name, value] : fields_)
      if (name == key) return value;
    return nullptr;
  }

  static bool is_keyword(const Sexpr& s) { return !s.is_list() && s.word().front() == ':'; }

  void report_unknown(const Sexpr& key, std::initializer_list<std::string_view> known) const {
    const std::string what = key.is_list() ? "a list" : "'" + text(key) + "'";
    std::string all;
    for (const std::string_view name : known) all += (all.empty() ? "" : " ") + std::string(name);
    source_.report(key.where, what + " where a keyword of the action is expected",
                   words::nearest(key.word(), known).remedy("known: " + all));
  }

  const Source& source_;
  std::vector<std::pair<std::string_view, const Sexpr*>> fields_;
};

std::string read_action_name(const Sexpr& s, const Source& source) {
  if (s.items().size() < 2) source.fail(s.where, "an action without a name", "write (:action NAME …)");
  return read_name(s.items()[1], "the name of an action", source);
}

void add_duration(const Sexpr& s, TimePoint at, std::vector<DurationConstraint>& out, const Source& source) {
  require_list(s, "a duration constraint", source);
  const std::string_view head = s.head();
  if (s.items().empty()) return;
  if (head == "and") {
    for (const Sexpr& item : rest(s)) source.attempt([&] { add_duration(item, at, out, source); });
    return;
  }
  if (head == "at" && s.items().size() == 3 &&
      (s.items()[1].is_word("start") || s.items()[1].is_word("end"))) {
    return add_duration(s.items()[2], s.items()[1].is_word("start") ? TimePoint::start : TimePoint::end, out,
                        source);
  }
  const auto op = as_comparison(head);
  const bool allowed = op && *op != ComparisonOperator::less && *op != ComparisonOperator::greater;
  if (!allowed || s.items().size() != 3 || !s.items()[1].is_word("?duration")) {
    source.fail(s.where, "not a duration constraint",
                "write (= ?duration E), (<= ?duration E), (>= ?duration E) or their 'and'");
  }
  out.push_back({*op, read_expression(s.items()[2], source), at, s.where});
}

// What is left of an action whose parameters are not known: nothing in it could be checked.
template <typename AnyAction>
AnyAction without_body(AnyAction action) {
  AnyAction bare;
  bare.name = std::move(action.name);
  bare.where = action.where;
  return bare;
}

}  // namespace

Action read_action(const Sexpr& s, const Source& source) {
  Action action;
  action.where = s.where;
  action.name = read_action_name(s, source);
  const Fields fields(s, {":parameters", ":precondition", ":effect"}, source);
  const bool readable = fields.read(
      ":parameters", [&](const Sexpr& list) { action.parameters = read_variables(list, source); });
  fields.read(":precondition",
              [&](const Sexpr& list) { action.precondition = read_condition(list, source); });
  fields.read(":effect",
              [&](const Sexpr& list) { action.effects = read_effects(list, TimePoint::start, source); });
  if (!readable) return without_body(std::move(action));
  return action;
}

DurativeAction read_durative_action(const Sexpr& s, const Source& source) {
  DurativeAction action;
  action.where = s.where;
  action.name = read_action_name(s, source);
  const Fields fields(s, {":parameters", ":duration", ":condition", ":effect"}, source);
  const bool readable = fields.read(
      ":parameters", [&](const Sexpr& list) { action.parameters = read_variables(list, source); });
  if (!fields.has(":duration"))
    source.report(s.where, "durative action '" + action.name + "' without :duration", "add one");
  fields.read(":duration",
              [&](const Sexpr& list) { add_duration(list, TimePoint::start, action.duration, source); });
  fields.read(":condition",
              [&](const Sexpr& list) { action.condition = read_timed_condition(list, source); });
  fields.read(":effect", [&](const Sexpr& list) {
    DurativeEffects effects = read_durative_effects(list, source);
    action.start_effects = std::move(effects.at_start);
    action.end_effects = std::move(effects.at_end);
    action.continuous_effects = std::move(effects.continuous);
  });
  if (!readable) return without_body(std::move(action));
  return action;
}

}  // namespace roci::pddl::grammar
