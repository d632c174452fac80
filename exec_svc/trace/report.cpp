#include "exec_svc/trace/report.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

namespace roci::exec::trace {
namespace {

std::string in_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Returns the part of the text around `at`.
std::string part(const std::string& text, std::size_t at, std::size_t width) {
  if (text.size() <= width) return in_one_line(text);
  const std::size_t begin = at < width / 2 ? 0 : std::min(at - width / 2, text.size() - width);
  const std::string cut = text.substr(begin, width);
  return (begin > 0 ? "..." : "") + in_one_line(cut) + (begin + width < text.size() ? "..." : "");
}

std::string shown(const Line& line, std::size_t at, std::size_t width) {
  return std::to_string(line.number) + ": " + temporal::to_text(line.time) + " " + part(line.text, at, width);
}

std::size_t first_difference(const Comparison& comparison, const Difference& difference) {
  if (!difference.before || !difference.after) return 0;
  const std::string& a = comparison.before[*difference.before].text;
  const std::string& b = comparison.after[*difference.after].text;
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

/// Returns how many lines of one side stand before a difference.
std::size_t standing_before(const std::vector<Line>& lines, std::optional<std::size_t> at,
                            temporal::Time time) {
  if (at) return *at;
  const auto later = [&](const Line& line) { return line.time > time; };
  return static_cast<std::size_t>(std::ranges::find_if(lines, later) - lines.begin());
}

void show_side(std::ostream& out, char mark, const std::vector<Line>& lines, std::optional<std::size_t> at,
               temporal::Time time, std::size_t column, const ReportOptions& options) {
  const std::size_t end = standing_before(lines, at, time);
  for (std::size_t i = end - std::min(end, options.context); i < end; ++i)
    out << "    " << shown(lines[i], 0, options.width) << "\n";
  if (at) {
    out << "  " << mark << " " << shown(lines[*at], column, options.width) << "\n";
  } else {
    out << "  " << mark << " (no such line)\n";
  }
}

void show(std::ostream& out, const Comparison& comparison, const Difference& difference,
          const ReportOptions& options) {
  const temporal::Time time = difference.before ? comparison.before[*difference.before].time
                                                : comparison.after[*difference.after].time;
  const std::size_t column = first_difference(comparison, difference);
  out << "  OLD, as the map calls it\n";
  show_side(out, '-', comparison.before, difference.before, time, column, options);
  out << "  NEW, without what the map says was added\n";
  show_side(out, '+', comparison.after, difference.after, time, column, options);
}

void add_useless(std::string& out, const Place& place, const Uses& uses, const std::string& what) {
  const auto found = uses.find(place);
  if (found == uses.end() || found->second == 0) out += place + ": " + what + " matches nothing; remove it\n";
}

void add_useless(std::string& out, const NewNames& names, const Uses& uses) {
  for (const auto& [from, name] : names) add_useless(out, name.place, uses, "the name '" + from + "'");
}

}  // namespace

std::string verdict(const Comparison& comparison) {
  const std::string accepted = comparison.accepted == 0
                                   ? ""
                                   : ", " + std::to_string(comparison.accepted) + " differing lines accepted";
  const std::string of = std::to_string(comparison.before.size()) + " lines";
  if (comparison.equal()) return "equal: " + of + accepted;
  return "different: " + std::to_string(comparison.differences.size()) + " of " + of + accepted;
}

std::string differences(const Comparison& comparison, const ReportOptions& options) {
  std::ostringstream out;
  const std::size_t count = std::min(options.shown, comparison.differences.size());
  for (std::size_t i = 0; i < count; ++i) {
    out << "difference " << i + 1 << " of " << comparison.differences.size() << ":\n";
    show(out, comparison, comparison.differences[i], options);
  }
  return out.str();
}

std::string useless_rules(const TraceMap& map, const Uses& uses, const std::string& scenario, bool all) {
  std::string out;
  if (all) {
    add_useless(out, map.names, uses);
    add_useless(out, map.kinds, uses);
    add_useless(out, map.keys, uses);
    for (const Rewrite& rule : map.rewrites) add_useless(out, rule.place, uses, "the rewrite");
    for (const Addition& rule : map.additions)
      add_useless(out, rule.place, uses, "the addition '" + rule.shown + "'");
    for (const FreeOrder& rule : map.free_orders) add_useless(out, rule.place, uses, "the free order");
  }
  for (const Accepted& rule : map.accepted) {
    if (all || rule.scenario.found_in(scenario))
      add_useless(out, rule.place, uses, "the accepted difference '" + rule.reason + "'");
  }
  return out;
}

}  // namespace roci::exec::trace
