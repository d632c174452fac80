// The array is read from its end with a stack of finished subtrees, so that no depth of nesting costs call
// stack.
#include "core/temporal/condition.hpp"

#include <algorithm>

#include "core/temporal/plan_bounds.hpp"

namespace roci::temporal {
namespace {

bool is_comparison(ConditionOp op) { return op >= ConditionOp::eq; }

bool is_ordering(ConditionOp op) { return op >= ConditionOp::lt; }

Truth truth_of(bool holds) { return holds ? Truth::yes : Truth::no; }

/// Combines finished subtrees, last one on top. Value is what a subtree is reduced to; leaf(node) and
/// join(node, children) make one. Returns nothing if the tree is malformed.
template <typename Value, typename Leaf, typename Join>
std::optional<Value> fold(const Condition& condition, Leaf leaf, Join join) {
  std::vector<Value> finished;
  for (auto node = condition.nodes.rbegin(); node != condition.nodes.rend(); ++node) {
    if (node->op == ConditionOp::always || is_comparison(node->op)) {
      finished.push_back(leaf(*node));
      continue;
    }
    if (node->child_count > finished.size()) return std::nullopt;
    const auto first_child = finished.end() - static_cast<std::ptrdiff_t>(node->child_count);
    std::vector<Value> children(std::make_move_iterator(finished.rbegin()),
                                std::make_move_iterator(std::make_reverse_iterator(first_child)));
    finished.erase(first_child, finished.end());
    finished.push_back(join(*node, children));
  }
  if (finished.size() != 1) return std::nullopt;
  return std::move(finished.front());
}

bool matches(const Value& found, const Value& operand) {
  const auto* wanted = std::get_if<State>(&operand);
  const auto* state = std::get_if<State>(&found);
  if (wanted && state && wanted->arguments.empty()) return wanted->name == state->name;
  return found == operand;
}

Truth compare_values(const ConditionNode& node, const std::optional<Value>& found) {
  if (!found || found->index() != node.operand.index()) return Truth::unknown;
  if (node.op == ConditionOp::eq) return truth_of(matches(*found, node.operand));
  if (node.op == ConditionOp::ne) return truth_of(!matches(*found, node.operand));
  const auto* left = std::get_if<double>(&*found);
  const auto* right = std::get_if<double>(&node.operand);
  if (!left || !right || *left != *left || *right != *right) return Truth::unknown;
  switch (node.op) {
    case ConditionOp::lt:
      return truth_of(*left < *right);
    case ConditionOp::le:
      return truth_of(*left <= *right);
    case ConditionOp::ge:
      return truth_of(*left >= *right);
    default:
      return truth_of(*left > *right);
  }
}

const char* symbol(ConditionOp op) {
  switch (op) {
    case ConditionOp::eq:
      return " = ";
    case ConditionOp::ne:
      return " != ";
    case ConditionOp::lt:
      return " < ";
    case ConditionOp::le:
      return " <= ";
    case ConditionOp::ge:
      return " >= ";
    default:
      return " > ";
  }
}

std::string describe_leaf(const ConditionNode& node) {
  if (node.op == ConditionOp::always) return "always";
  return node.timeline + symbol(node.op) + to_text(node.operand);
}

/// Holds what a subtree says, and what of it does not hold now.
struct Finding {
  Truth truth = Truth::yes;
  std::string text{};
  std::string because{};
  bool compound = false;
};

Finding find_leaf(const ConditionNode& node, const Lookup& lookup) {
  Finding finding{.text = describe_leaf(node)};
  if (node.op == ConditionOp::always) return finding;
  const std::optional<Value> found = lookup(node.timeline);
  finding.truth = compare_values(node, found);
  if (finding.truth != Truth::yes)
    finding.because = finding.text + (found ? " (is " + to_text(*found) + ")" : " (never observed)");
  return finding;
}

Truth join_truth(ConditionOp op, const std::vector<Finding>& children) {
  if (op == ConditionOp::negation) {
    if (children.size() != 1 || children.front().truth == Truth::unknown) return Truth::unknown;
    return truth_of(children.front().truth == Truth::no);
  }
  const Truth deciding = op == ConditionOp::all_of ? Truth::no : Truth::yes;
  Truth joined = op == ConditionOp::all_of ? Truth::yes : Truth::no;
  for (const Finding& child : children) {
    if (child.truth == deciding) return deciding;
    if (child.truth == Truth::unknown) joined = Truth::unknown;
  }
  return joined;
}

std::string bracketed(const Finding& finding) {
  return finding.compound ? "(" + finding.text + ")" : finding.text;
}

Finding join_findings(const ConditionNode& node, const std::vector<Finding>& children) {
  Finding joined{.truth = join_truth(node.op, children), .compound = children.size() > 1};
  if (node.op == ConditionOp::negation) {
    if (!children.empty()) joined.text = "not " + bracketed(children.front());
    if (joined.truth != Truth::yes) joined.because = joined.text;
    return joined;
  }
  const std::string glue = node.op == ConditionOp::all_of ? " and " : " or ";
  for (const Finding& child : children) {
    joined.text += (joined.text.empty() ? "" : glue) + (children.size() > 1 ? bracketed(child) : child.text);
    if (joined.truth == Truth::yes || child.truth == Truth::yes) continue;
    joined.because += (joined.because.empty() ? "" : glue) + child.because;
  }
  return joined;
}

Finding find(const Condition& condition, const Lookup& lookup) {
  if (condition.empty()) return {.text = "always"};
  const auto found = fold<Finding>(
      condition, [&](const ConditionNode& node) { return find_leaf(node, lookup); }, join_findings);
  return found.value_or(Finding{Truth::unknown, "malformed condition", "malformed condition"});
}

Condition joined(ConditionOp op, const std::vector<Condition>& parts) {
  Condition whole;
  whole.nodes.push_back({.op = op, .child_count = static_cast<std::uint32_t>(parts.size())});
  for (const Condition& part : parts) {
    if (part.empty()) whole.nodes.push_back({});
    whole.nodes.insert(whole.nodes.end(), part.nodes.begin(), part.nodes.end());
  }
  return whole;
}

}  // namespace

Condition compare(std::string timeline, ConditionOp op, Value operand) {
  return {{{.op = op, .timeline = std::move(timeline), .operand = std::move(operand)}}};
}

Condition all_of(const std::vector<Condition>& parts) {
  return parts.empty() ? Condition{} : joined(ConditionOp::all_of, parts);
}

Condition any_of(const std::vector<Condition>& parts) { return joined(ConditionOp::any_of, parts); }

Condition negate(const Condition& part) { return joined(ConditionOp::negation, {part}); }

Truth evaluate(const Condition& condition, const Lookup& lookup) {
  if (condition.empty()) return Truth::yes;
  if (condition.nodes.size() == 1 && is_comparison(condition.nodes.front().op))
    return compare_values(condition.nodes.front(), lookup(condition.nodes.front().timeline));
  const auto leaf = [&](const ConditionNode& node) {
    const bool always = node.op == ConditionOp::always;
    return Finding{.truth = always ? Truth::yes : compare_values(node, lookup(node.timeline))};
  };
  const auto join = [](const ConditionNode& node, const std::vector<Finding>& children) {
    return Finding{.truth = join_truth(node.op, children)};
  };
  const auto found = fold<Finding>(condition, leaf, join);
  return found ? found->truth : Truth::unknown;
}

std::string describe(const Condition& condition) {
  return find(condition, [](const std::string&) { return std::nullopt; }).text;
}

std::string explain(const Condition& condition, const Lookup& lookup) {
  return find(condition, lookup).because;
}

std::string check(const Condition& condition) {
  if (condition.empty()) return {};
  if (condition.nodes.size() > kMostConditionNodes)
    return "it has more than " + std::to_string(kMostConditionNodes) + " nodes";
  std::string wrong;
  const auto complain = [&](std::string what) {
    wrong = std::move(what);
  };  // the first in reading order stays last
  const auto leaf = [&](const ConditionNode& node) {
    if (node.child_count != 0) complain("a comparison has no children");
    if (node.op == ConditionOp::always) return true;
    if (node.timeline.empty()) complain("a comparison names no timeline");
    if (std::holds_alternative<std::monostate>(node.operand))
      complain(node.timeline + " is compared with nothing");
    if (is_ordering(node.op) && !std::holds_alternative<double>(node.operand))
      complain(node.timeline + symbol(node.op) + to_text(node.operand) + ": only numbers have an order");
    return true;
  };
  const auto join = [&](const ConditionNode& node, const std::vector<bool>& children) {
    if (node.op == ConditionOp::negation && children.size() != 1) complain("a negation has one child");
    if (children.empty()) complain("all_of and any_of have at least one child");
    return true;
  };
  if (!fold<bool>(condition, leaf, join)) return "child counts do not add up to one tree";
  return wrong;
}

std::vector<std::string> timelines_of(const Condition& condition) {
  std::vector<std::string> names;
  for (const ConditionNode& node : condition.nodes)
    if (is_comparison(node.op)) names.push_back(node.timeline);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace roci::temporal
