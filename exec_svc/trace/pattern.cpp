#include "exec_svc/trace/pattern.hpp"

#include <regex.h>

#include <array>

namespace roci::exec::trace {
namespace {

using Groups = std::array<regmatch_t, 10>;

std::string expanded(const std::string& replacement, const std::string& text, const Groups& groups) {
  std::string out;
  for (std::size_t i = 0; i < replacement.size(); ++i) {
    if (replacement[i] != '\\') {
      out += replacement[i];
      continue;
    }
    const char escape = replacement[++i];
    if (escape == '\\') {
      out += escape;
      continue;
    }
    const regmatch_t& group = groups[static_cast<std::size_t>(escape - '0')];
    if (group.rm_so >= 0)
      out.append(text, static_cast<std::size_t>(group.rm_so),
                 static_cast<std::size_t>(group.rm_eo - group.rm_so));
  }
  return out;
}

}  // namespace

struct Pattern::Compiled {
  regex_t expression;
  ~Compiled() { regfree(&expression); }

  bool match(const std::string& text, std::size_t from, Groups& groups) const {
    groups[0].rm_so = static_cast<regoff_t>(from);
    groups[0].rm_eo = static_cast<regoff_t>(text.size());
    return regexec(&expression, text.c_str(), groups.size(), groups.data(), REG_STARTEND) == 0;
  }
};

Pattern::Pattern(const std::string& expression) {
  auto compiled = std::make_unique<Compiled>();
  const int status = regcomp(&compiled->expression, expression.c_str(), REG_EXTENDED);
  if (status != 0) {
    std::array<char, 200> reason{};
    regerror(status, &compiled->expression, reason.data(), reason.size());
    throw PatternError(reason.data());
  }
  compiled_ = std::move(compiled);
}

bool Pattern::found_in(const std::string& text) const {
  Groups groups;
  return compiled_->match(text, 0, groups);
}

void Pattern::check_replacement(const std::string& replacement) const {
  for (std::size_t i = 0; i < replacement.size(); ++i) {
    if (replacement[i] != '\\') continue;
    const char escape = ++i < replacement.size() ? replacement[i] : ' ';
    if (escape == '\\') continue;
    if (escape < '0' || escape > '9')
      throw PatternError("a backslash stands before neither a digit nor another one");
    if (static_cast<std::size_t>(escape - '0') > compiled_->expression.re_nsub)
      throw PatternError(std::string("there is no group \\") + escape);
  }
}

std::string Pattern::replaced(const std::string& text, const std::string& replacement) const {
  std::string out;
  Groups groups;
  std::size_t at = 0;
  while (at <= text.size() && compiled_->match(text, at, groups)) {
    const auto begin = static_cast<std::size_t>(groups[0].rm_so);
    const auto end = static_cast<std::size_t>(groups[0].rm_eo);
    out.append(text, at, begin - at);
    out += expanded(replacement, text, groups);
    at = end;
    if (begin != end) continue;
    if (at < text.size()) out += text[at];  // an empty match: the next one begins a character later
    ++at;
  }
  if (at < text.size()) out.append(text, at, std::string::npos);
  return out;
}

}  // namespace roci::exec::trace
