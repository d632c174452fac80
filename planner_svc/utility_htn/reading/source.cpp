#include "planner_svc/utility_htn/reading/source.hpp"

#include <cmath>

#include "core/words/nearest_word.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/reading/expression.hpp"

namespace roci::planner::utility_htn::reading {

Source::Source(mission::Entry entry, std::shared_ptr<const Bindings> bindings)
    : entry_(std::move(entry)),
      bindings_(bindings ? std::move(bindings) : std::make_shared<const Bindings>()) {}

Source Source::with(const Bindings& more) const {
  auto all = std::make_shared<Bindings>(more);
  all->insert(bindings_->begin(), bindings_->end());
  return Source(entry_, std::move(all));
}

std::optional<Source> Source::find(std::string_view key) const {
  const auto found = entry_.find(key);
  return found ? std::optional(Source(*found, bindings_)) : std::nullopt;
}

Source Source::at(std::string_view key) const { return Source(entry_.at(key), bindings_); }

std::vector<Source> Source::items() const {
  std::vector<Source> out;
  for (const mission::Entry& item : entry_.items()) out.emplace_back(item, bindings_);
  return out;
}

std::vector<Source> Source::one_or_more() const {
  return entry_.is_sequence() ? items() : std::vector<Source>{*this};
}

std::vector<std::pair<std::string, Source>> Source::raw_fields() const {
  std::vector<std::pair<std::string, Source>> out;
  for (const auto& [key, value] : entry_.fields()) out.emplace_back(key, Source(value, bindings_));
  return out;
}

std::vector<std::pair<std::string, Source>> Source::fields() const {
  auto out = raw_fields();
  for (auto& [key, value] : out) key = value.filled(key);
  return out;
}

std::string Source::text() const {
  if (entry_.is_mapping()) {
    const auto fields = entry_.fields();
    if (fields.size() == 1 && !entry_.find(fields.front().first))
      fail("'{" + fields.front().first + "}' without quotes is 'key: value' pairs; write \"{" +
           fields.front().first + "}\"");
  }
  return filled(entry_.text());
}

std::string Source::text_or(std::string_view key, std::string fallback) const {
  const auto found = find(key);
  return found ? found->text() : fallback;
}

double Source::number() const {
  const Expression expression = parse_expression(text());
  if (!expression.fault.empty()) fail(expression.fault);
  if (!expression.name.empty()) {
    const bool has_value = bindings_->contains(expression.name);
    fail("'" + expression.name + "' stands where only a number can; write " +
         (has_value ? "\"{" + expression.name + "}\"" : "its value"));
  }
  return expression.constant;
}

double Source::number_or_none(double none) const { return text() == "none" ? none : number(); }

double Source::number_or(std::string_view key, double fallback) const {
  const auto found = find(key);
  return found ? found->number() : fallback;
}

std::uint64_t Source::count(std::uint64_t most) const {
  const double value = number();
  if (!(value >= 0) || value != std::floor(value) || value > static_cast<double>(most))
    fail("expected a whole number from 0 to " + std::to_string(most));
  return static_cast<std::uint64_t>(value);
}

bool Source::truth() const {
  const std::string word = text();
  if (word != "true" && word != "false") fail("expected true or false");
  return word == "true";
}

bool Source::truth_or(std::string_view key, bool fallback) const {
  const auto found = find(key);
  return found ? found->truth() : fallback;
}

temporal::Duration Source::seconds() const {
  if (text() == "none") return temporal::no_bound;
  const double value = number();
  if (std::abs(value) > temporal::to_seconds(model::kLongestDuration))
    fail("expected a time of at most " + temporal::to_text(model::kLongestDuration) + ", in seconds");
  return temporal::seconds(value);
}

std::string Source::filled(const std::string& text) const {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
      out += c;
      ++i;
    } else if (c == '{') {
      const std::size_t end = text.find('}', i);
      if (end == std::string::npos) fail("'{' without '}' in '" + text + "'; close it, or write '{{'");
      const std::string word = text.substr(i + 1, end - i - 1);
      const auto found = bindings_->find(word);
      if (found == bindings_->end()) {
        std::vector<std::string> known;
        for (const auto& [name, value] : *bindings_) known.push_back(name);
        std::string listed;
        for (const std::string& name : known) listed += (listed.empty() ? "" : ", ") + name;
        fail("nothing stands for '{" + word + "}'; " +
             words::nearest(word, known)
                 .remedy(known.empty() ? "say so with 'for' or under 'constants'" : "known here: " + listed));
      }
      out += found->second;
      if (out.size() > model::kLongestText * 4)
        fail("the text becomes too long; shorten what stands in braces");
      i = end;
    } else if (c == '}') {
      fail("'}' without '{' in '" + text + "'; open it, or write '}}'");
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace roci::planner::utility_htn::reading
