#include "planner_svc/utility_htn/reading/expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace roci::planner::utility_htn::reading {

namespace {

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool goes_on(char c) {
  return starts_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
}

class Sum {
 public:
  explicit Sum(std::string_view text) : whole_(text), rest_(text) {}

  Expression parse() {
    skip_spaces();
    if (rest_.empty()) fail("expected a number");
    double sign = 1;
    if (!rest_.empty() && rest_.front() == '-') {
      sign = -1;
      drop();
    }
    while (out_.fault.empty()) {
      product(sign);
      if (rest_.empty() || !out_.fault.empty()) break;
      if (rest_.front() != '+' && rest_.front() != '-') {
        fail("expected '+', '-' or '*' before '" + std::string(rest_) + "'");
        break;
      }
      sign = rest_.front() == '-' ? -1 : 1;
      drop();
    }
    if (out_.fault.empty() && (!std::isfinite(out_.constant) || !std::isfinite(out_.factor)))
      fail("expected a finite number");
    return out_;
  }

 private:
  void product(double value) {
    std::string name;
    while (true) {
      skip_spaces();
      double factor = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), factor);
      const bool number = error == std::errc() && !rest_.empty() && !starts_name(rest_.front());
      if (number) {
        value *= factor;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        if (!rest_.empty() && goes_on(rest_.front()))
          return fail("'" + std::string(whole_) + "' is no number and no name");
      } else if (!rest_.empty() && starts_name(rest_.front())) {
        if (!name.empty() || !out_.name.empty())
          return fail("two names in '" + std::string(whole_) +
                      "'; only one may stand in a sum, and with factors that are numbers");
        const auto stop = std::ranges::find_if_not(rest_, goes_on);
        name.assign(rest_.begin(), stop);
        rest_.remove_prefix(name.size());
      } else {
        return fail("expected a finite number or a parameter, not '" + std::string(whole_) + "'");
      }
      skip_spaces();
      if (rest_.empty() || rest_.front() != '*') break;
      drop();
    }
    if (name.empty()) {
      out_.constant += value;
    } else {
      out_.name = name;
      out_.factor = value;
    }
  }

  void drop() {
    rest_.remove_prefix(1);
    skip_spaces();
  }
  void skip_spaces() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  void fail(std::string what) {
    if (out_.fault.empty()) out_.fault = std::move(what);
  }

  std::string_view whole_, rest_;
  Expression out_;
};

std::string trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

Expression parse_expression(std::string_view text) { return Sum(text).parse(); }

Comparison parse_comparison(std::string_view text) {
  static constexpr std::array<std::string_view, 6> relations{" in ", "!=", ">=", "<=", "==", "="};
  Comparison out;
  std::size_t at = std::string_view::npos;
  std::string_view relation;
  for (const std::string_view one : relations) {
    const std::size_t found = text.find(one);
    if (found >= at) continue;
    at = found;
    relation = one;
  }
  if (at == std::string_view::npos) {
    const bool strict = text.find_first_of("<>") != std::string_view::npos;
    out.fault =
        "'" + std::string(text) + "' compares nothing; write " +
        (strict ? "'<=' or '>=': bounds are included"
                : "e.g. \"phase = sampling\", \"phase in a, b\", \"battery >= 5000\", \"heat in 10 .. 20\"");
    return out;
  }
  out.timeline = trimmed(text.substr(0, at));
  out.relation = relation == "==" ? "=" : trimmed(relation);
  std::string_view operands = text.substr(at + relation.size());
  const std::size_t dots = operands.find("..");
  out.range = out.relation == "in" && dots != std::string_view::npos;
  if (out.range) {
    out.operands = {trimmed(operands.substr(0, dots)), trimmed(operands.substr(dots + 2))};
  } else if (out.relation == "in") {
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
      comma = operands.find(',');
      out.operands.push_back(trimmed(operands.substr(0, comma)));
      if (comma != std::string_view::npos) operands.remove_prefix(comma + 1);
    }
  } else {
    out.operands = {trimmed(operands)};
  }
  if (out.timeline.empty() || std::ranges::count(out.operands, std::string{}) > 0)
    out.fault = "a side of '" + std::string(text) + "' is empty; write both";
  return out;
}

}  // namespace roci::planner::utility_htn::reading
