#include "science_svc/watch/watch.hpp"

#include <algorithm>
#include <cctype>

namespace roci::science::watch {
namespace {

std::string with_object(std::string text, const std::string& object) {
  for (std::size_t at = text.find('*'); at != std::string::npos; at = text.find('*', at + object.size()))
    text.replace(at, 1, object);
  return text;
}

// Goal ids have lower-case letters, digits, - and _ alone.
std::string as_name(std::string text) {
  for (char& letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    letter = std::isalnum(byte) != 0 || letter == '_' ? static_cast<char>(std::tolower(byte)) : '-';
  }
  return text;
}

}  // namespace

std::optional<std::string> match(const std::string& pattern, const std::string& name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return pattern == name ? std::optional(std::string()) : std::nullopt;
  const std::string before = pattern.substr(0, star);
  const std::string after = pattern.substr(star + 1);
  if (name.size() <= before.size() + after.size()) return std::nullopt;
  if (!name.starts_with(before) || !name.ends_with(after)) return std::nullopt;
  return name.substr(before.size(), name.size() - before.size() - after.size());
}

std::vector<Wish> Watch::observe(const std::string& timeline, const std::string& state) {
  std::vector<Wish> out;
  const auto is_watched = [&](const Rule& rule) { return match(rule.timeline, timeline).has_value(); };
  if (std::ranges::none_of(rules_, is_watched)) return out;
  const auto before = states_.find(timeline);
  if (before == states_.end() && full()) return out;
  if (before != states_.end() && before->second == state) return out;
  states_[timeline] = state;
  for (const Rule& rule : rules_) {
    const auto object = match(rule.timeline, timeline);
    if (object && rule.state == state) out.push_back(wish_of(rule, *object, timeline));
  }
  return out;
}

Wish Watch::wish_of(const Rule& rule, const std::string& object, const std::string& timeline) {
  Wish out{"", rule.goal_kind, {}, rule.importance, rule.utility, timeline, rule.state};
  const std::string first = "watch-" + as_name(rule.goal_kind + "-" + (object.empty() ? timeline : object));
  const int count = ++raised_[first];
  out.id = count == 1 ? first : first + "-" + std::to_string(count);
  for (const auto& [name, value] : rule.arguments) out.arguments[name] = with_object(value, object);
  return out;
}

}  // namespace roci::science::watch
