#include "core/mission/findings.hpp"

#include <algorithm>
#include <charconv>
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

std::vector<Finding> Findings::sorted() const {
  std::vector<Finding> out = all_;
  std::ranges::stable_sort(out, {},
                           [](const Finding& one) { return std::tie(one.file, one.line, one.column); });
  return out;
}

}  // namespace roci::mission
