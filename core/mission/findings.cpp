#include "core/mission/findings.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

namespace roci::mission {
namespace {

// Reads "12:" at `from` and returns the end of it, or npos if it does not stand there.
std::size_t read_count(std::string_view text, std::size_t from, int& out) {
  const auto [end, error] = std::from_chars(text.data() + from, text.data() + text.size(), out);
  const auto at = static_cast<std::size_t>(end - text.data());
  return error == std::errc() && at < text.size() && text[at] == ':' ? at + 1 : std::string_view::npos;
}

// Takes "error: what (remedy)" apart.
Finding of_a_reader(Finding finding) {
  for (const auto& [word, severity] : {std::pair{"error: ", Severity::error},
                                       {"unsupported: ", Severity::error},
                                       {"warning: ", Severity::warning}}) {
    if (!finding.what.starts_with(word)) continue;
    finding.severity = severity;
    if (!finding.remedy.empty()) finding.what += "; " + std::exchange(finding.remedy, "");
    finding.what.erase(0, std::string_view(word).size());
    int open = 0;
    for (std::size_t at = finding.what.size(); at > 0 && finding.what.ends_with(')'); --at) {
      const char c = finding.what[at - 1];
      open += c == ')' ? 1 : c == '(' ? -1 : 0;
      if (open > 0) continue;
      if (at < 2 || finding.what[at - 2] != ' ') break;
      finding.remedy = finding.what.substr(at, finding.what.size() - at - 1);
      finding.what.erase(at - 2);
      break;
    }
    break;
  }
  return finding;
}

}  // namespace

std::string Finding::text() const {
  std::string out = file;
  if (line > 0) out += ":" + std::to_string(line);
  if (column > 0) out += ":" + std::to_string(column);
  return out + ": " + what;
}

Finding finding_of(const std::string& text, Severity severity) {
  Finding out;
  out.severity = severity;
  std::string_view rest = text;
  for (std::size_t colon = rest.find(':'); colon != std::string_view::npos;
       colon = rest.find(':', colon + 1)) {
    int line = 0;
    int column = 0;
    const std::size_t second = read_count(rest, colon + 1, line);
    if (second == std::string_view::npos) continue;
    const std::size_t third = read_count(rest, second, column);
    out.file = rest.substr(0, colon);
    out.line = line;
    out.column = third == std::string_view::npos ? 0 : column;
    rest.remove_prefix(third == std::string_view::npos ? second : third);
    break;
  }
  if (const std::size_t colon = rest.find(": "); out.file.empty() && colon != std::string_view::npos) {
    out.file = rest.substr(0, colon);
    rest.remove_prefix(colon + 1);
  }
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const std::size_t remedy = rest.find("; ");
  out.what = rest.substr(0, remedy);
  if (remedy != std::string_view::npos) out.remedy = rest.substr(remedy + 2);
  return out;
}

void Findings::add(Finding finding) {
  if (std::ranges::find(all_, finding) == all_.end()) all_.push_back(std::move(finding));
}

void Findings::add(const std::string& text, Severity severity) {
  std::istringstream lines(text);
  std::string so_far;
  for (std::string line; std::getline(lines, line);) {
    if (!so_far.empty() && finding_of(line).line > 0) add(of_a_reader(finding_of(so_far, severity)));
    so_far = so_far.empty() || finding_of(line).line > 0 ? line : so_far + "\n" + line;
  }
  add(of_a_reader(finding_of(so_far, severity)));
}

std::size_t Findings::errors() const {
  return static_cast<std::size_t>(std::ranges::count(all_, Severity::error, &Finding::severity));
}

std::vector<Finding> Findings::sorted() const {
  std::vector<Finding> out = all_;
  std::ranges::stable_sort(out, {},
                           [](const Finding& one) { return std::tie(one.file, one.line, one.column); });
  return out;
}

}  // namespace roci::mission
