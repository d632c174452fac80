#include "exec_svc/trace/renaming.hpp"

#include <optional>
#include <utility>

namespace roci::exec::trace {
namespace {

bool in_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
         byte == '_' || byte == '-' || byte == '.' || byte >= 0x80;
}

/// Returns the end of the word that begins here, or `from` itself where none does.
std::size_t end_of_word(std::string_view text, std::size_t from) {
  std::size_t end = from;
  while (end < text.size() && in_word(text[end])) ++end;
  while (end > from && (text[end - 1] == '.' || text[end - 1] == '-')) --end;
  return end;
}

std::string with_new_words(std::string_view text, const TraceMap& map, Uses& uses) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_word(text, at);
    if (end == at) {
      out += text[at++];
      continue;
    }
    const std::string_view word = text.substr(at, end - at);
    const bool is_key = end < text.size() && text[end] == '=';
    const NewNames& names = at == 0 ? map.kinds : is_key ? map.keys : map.names;
    const auto found = names.find(word);
    if (found != names.end()) ++uses[found->second.place];
    out += found == names.end() ? word : std::string_view(found->second.to);
    at = end;
  }
  return out;
}

bool is_of(const std::optional<std::string>& kind, std::string_view text) {
  return !kind || text.substr(0, text.find(' ')) == *kind;
}

/// Takes out of the line what was added. Returns whether the line stays.
bool strip(std::string& text, const TraceMap& map, Uses& uses) {
  for (const Addition& addition : map.additions) {
    if (!is_of(addition.kind, text) || !addition.pattern.found_in(text)) continue;
    ++uses[addition.place];
    if (addition.whole_line) return false;
    text = addition.pattern.replaced(text, "");
  }
  return true;
}

}  // namespace

bool is_word(std::string_view text) { return !text.empty() && end_of_word(text, 0) == text.size(); }

std::string renamed(const std::string& text, const TraceMap& map, Uses& uses) {
  std::string out = with_new_words(text, map, uses);
  for (const Rewrite& rewrite : map.rewrites) {
    if (!is_of(rewrite.kind, out) || !rewrite.pattern.found_in(out)) continue;
    ++uses[rewrite.place];
    out = rewrite.pattern.replaced(out, rewrite.replacement);
  }
  return out;
}

std::vector<Line> without_additions(std::vector<Line> lines, const TraceMap& map, Uses& uses) {
  std::erase_if(lines, [&](Line& line) { return !strip(line.text, map, uses); });
  return lines;
}

}  // namespace roci::exec::trace
