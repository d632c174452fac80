#include <map>

#include "core/pddl/grammar.hpp"

namespace roci::pddl::grammar {

namespace {

// Holds the `:keyword VALUE` pairs of an action.
class Fields {
 public:
  Fields(const Sexpr& action, std::initializer_list<std::string_view> known, const Source& source)
      : source_(source) {
    const auto items = rest(action, 2);
    for (std::size_t i = 0; i < items.size(); i += 2) {
      const Sexpr& key = items[i];
      bool found = false;
      for (const std::string_view name : known) found = found || key.is_word(name);
      if (!found) {
        const std::string what = key.is_list ? "a list" : "'" + key.word + "'";
        source.fail(key.where, what + " where a keyword of the action is expected", "known: " + join(known));
      }
      if (i + 1 == items.size())
        source.fail(key.where, key.word + " without a value", "write a list after it");
      if (!fields_.emplace(key.word, &items[i + 1]).second) {
        source.fail(key.where, key.word + " stands twice", "keep one");
      }
    }
  }

  // Returns nullptr if the key is absent.
  const Sexpr* find(const std::string& key) const {
    const auto it = fields_.find(key);
    return it == fields_.end() ? nullptr : &require_list(*it->second, "a list after " + key, source_);
  }

 private:
  static std::string join(std::initializer_list<std::string_view> names) {
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : " ") + std::string(name);
    return text;
  }

  const Source& source_;
  std::map<std::string, const Sexpr*> fields_;
};

std::string read_action_name(const Sexpr& s, const Source& source) {
  if (s.items.size() < 2) source.fail(s.where, "an action without a name", "write (:action NAME …)");
  return read_name(s.items[1], "the name of an action", source);
}

void add_duration(const Sexpr& s, TimePoint at, std::vector<DurationConstraint>& out, const Source& source) {
  require_list(s, "a duration constraint", source);
  const std::string_view head = s.head();
  if (s.items.empty()) return;
  if (head == "and") {
    for (const Sexpr& item : rest(s)) add_duration(item, at, out, source);
    return;
  }
  if (head == "at" && s.items.size() == 3 && (s.items[1].is_word("start") || s.items[1].is_word("end"))) {
    return add_duration(s.items[2], s.items[1].is_word("start") ? TimePoint::start : TimePoint::end, out,
                        source);
  }
  const auto op = as_comparison(head);
  const bool allowed = op && *op != ComparisonOperator::less && *op != ComparisonOperator::greater;
  if (!allowed || s.items.size() != 3 || !s.items[1].is_word("?duration")) {
    source.fail(s.where, "not a duration constraint",
                "write (= ?duration E), (<= ?duration E), (>= ?duration E) or their 'and'");
  }
  out.push_back({*op, read_expression(s.items[2], source), at, s.where});
}

}  // namespace

Action read_action(const Sexpr& s, const Source& source) {
  Action action;
  action.where = s.where;
  action.name = read_action_name(s, source);
  const Fields fields(s, {":parameters", ":precondition", ":effect"}, source);
  if (const Sexpr* list = fields.find(":parameters")) action.parameters = read_variables(*list, source);
  if (const Sexpr* list = fields.find(":precondition")) action.precondition = read_condition(*list, source);
  if (const Sexpr* list = fields.find(":effect"))
    action.effects = read_effects(*list, TimePoint::start, source);
  return action;
}

DurativeAction read_durative_action(const Sexpr& s, const Source& source) {
  DurativeAction action;
  action.where = s.where;
  action.name = read_action_name(s, source);
  const Fields fields(s, {":parameters", ":duration", ":condition", ":effect"}, source);
  if (const Sexpr* list = fields.find(":parameters")) action.parameters = read_variables(*list, source);
  const Sexpr* duration = fields.find(":duration");
  if (!duration) source.fail(s.where, "durative action '" + action.name + "' without :duration", "add one");
  add_duration(*duration, TimePoint::start, action.duration, source);
  if (const Sexpr* list = fields.find(":condition")) action.condition = read_timed_condition(*list, source);
  if (const Sexpr* list = fields.find(":effect")) {
    DurativeEffects effects = read_durative_effects(*list, source);
    action.start_effects = std::move(effects.at_start);
    action.end_effects = std::move(effects.at_end);
    action.continuous_effects = std::move(effects.continuous);
  }
  return action;
}

}  // namespace roci::pddl::grammar
