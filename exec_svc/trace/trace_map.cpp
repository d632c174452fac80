#include "exec_svc/trace/trace_map.hpp"

#include "core/mission/entry.hpp"
#include "exec_svc/trace/renaming.hpp"

namespace roci::exec::trace {
namespace {

using mission::Entry;

std::vector<Entry> list(const Entry& root, std::string_view section) {
  const auto entry = root.find(section);
  return entry ? entry->items() : std::vector<Entry>{};
}

Pattern pattern_in(const Entry& entry) {
  try {
    return Pattern(entry.text());
  } catch (const PatternError& error) {
    entry.fail("'" + entry.text() + "' is no regular expression (" + error.what() +
               "); mend it, POSIX extended syntax is read here");
  }
}

std::optional<Pattern> pattern_at(const Entry& entry, std::string_view key) {
  const auto found = entry.find(key);
  return found ? std::optional<Pattern>(pattern_in(*found)) : std::nullopt;
}

std::string word_in(const Entry& entry, const std::string& text) {
  if (!is_word(text))
    entry.fail("'" + text + "' is not one word (letters, digits, '_', '-', '.'); put it into rewrites");
  return text;
}

std::optional<std::string> kind_in(const Entry& entry) {
  const auto found = entry.find("kind");
  return found ? std::optional<std::string>(word_in(*found, found->text())) : std::nullopt;
}

std::string reason_in(const Entry& entry) {
  const Entry reason = entry.at("reason");
  if (reason.text().empty()) reason.fail("the reason is empty; say why this difference is right");
  return reason.text();
}

NewNames new_names(const Entry& root, std::string_view section) {
  NewNames out;
  const auto entry = root.find(section);
  if (!entry) return out;
  for (const auto& [from, to] : entry->fields()) {
    word_in(to, from);
    if (from == to.text()) to.fail("'" + from + "' is renamed to itself; remove the line");
    if (!out.try_emplace(from, NewName{word_in(to, to.text()), to.place()}).second)
      to.fail("'" + from + "' is renamed twice; keep one of the lines");
  }
  return out;
}

Rewrite rewrite_in(const Entry& entry) {
  entry.allow_only({"kind", "pattern", "with"});
  Rewrite out{kind_in(entry), pattern_in(entry.at("pattern")), entry.at("with").text(), entry.place()};
  try {
    out.pattern.check_replacement(out.replacement);
  } catch (const PatternError& error) {
    entry.at("with").fail("'" + out.replacement + "' cannot be put in (" + error.what() +
                          "); \\1 to \\9 are the groups of the pattern, \\\\ is a backslash");
  }
  return out;
}

/// A field is ` NAME=VALUE`; a value has no space.
std::string field_pattern(const std::string& name) {
  std::string out = " ";
  for (const char c : name) out += c == '.' ? std::string("\\.") : std::string(1, c);
  return out + "=[^ ;]*";
}

Addition addition_in(const Entry& entry) {
  entry.allow_only({"kind", "field", "pattern", "line"});
  const auto field = entry.find("field");
  const auto pattern = entry.find("pattern");
  const auto line = entry.find("line");
  if (field.has_value() + pattern.has_value() + line.has_value() != 1)
    entry.fail("an added thing is exactly one of 'field', 'pattern' and 'line'; choose one");
  if (field) {
    const std::string name = word_in(*field, field->text());
    return {kind_in(entry), Pattern(field_pattern(name)), false, name, entry.place()};
  }
  const Entry& expression = pattern ? *pattern : *line;
  return {kind_in(entry), pattern_in(expression), line.has_value(), expression.text(), entry.place()};
}

FreeOrder free_order_in(const Entry& entry) {
  entry.allow_only({"kinds", "reason"});
  return {entry.at("kinds").texts(), reason_in(entry), entry.place()};
}

temporal::Time since_in(const Entry& entry) {
  const auto since = entry.find("since");
  if (!since) return temporal::Time{0};
  if (since->number() < 0 || since->number() > 1e9)
    since->fail("'" + since->text() + "' is no mission time; give seconds from 0 to 1e9");
  return temporal::seconds(since->number());
}

Accepted accepted_in(const Entry& entry) {
  entry.allow_only({"scenario", "since", "old", "new", "reason"});
  const auto scenario = pattern_at(entry, "scenario");
  Accepted out{scenario ? *scenario : Pattern(""), since_in(entry),  pattern_at(entry, "old"),
               pattern_at(entry, "new"),           reason_in(entry), entry.place()};
  if (!out.before && !out.after)
    entry.fail("neither 'old' nor 'new' says which lines are accepted; give one or both");
  return out;
}

}  // namespace

TraceMap read_map(const std::filesystem::path& file) {
  const Entry root = Entry::load(file);
  root.allow_only({"format", "names", "kinds", "keys", "rewrites", "added", "free_order", "accepted"});
  const Entry format = root.at("format");
  if (format.integer() != kMapFormat)
    format.fail("a map of format " + format.text() + ", this roci-trace reads format " +
                std::to_string(kMapFormat) + "; write the map in that format");
  TraceMap out;
  out.names = new_names(root, "names");
  out.kinds = new_names(root, "kinds");
  out.keys = new_names(root, "keys");
  for (const Entry& entry : list(root, "rewrites")) out.rewrites.push_back(rewrite_in(entry));
  for (const Entry& entry : list(root, "added")) out.additions.push_back(addition_in(entry));
  for (const Entry& entry : list(root, "free_order")) out.free_orders.push_back(free_order_in(entry));
  for (const Entry& entry : list(root, "accepted")) out.accepted.push_back(accepted_in(entry));
  return out;
}

}  // namespace roci::exec::trace
