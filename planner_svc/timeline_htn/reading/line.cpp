#include "planner_svc/timeline_htn/reading/line.hpp"

#include <cctype>
#include <charconv>
#include <cmath>

#include "planner_svc/timeline_htn/model/bounds.hpp"

namespace roci::planner::timeline_htn::reading {

namespace {

bool is_front(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_within(char c) { return is_front(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

// A '-' belongs to the name where one more character of it follows.
std::size_t name_length(std::string_view text) {
  if (text.empty() || !is_front(text.front())) return 0;
  std::size_t length = 1;
  while (length < text.size() &&
         (is_within(text[length]) ||
          (text[length] == '-' && length + 1 < text.size() && is_within(text[length + 1]))))
    ++length;
  return length;
}

}  // namespace

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= model::kLongestText && name_length(text) == text.size();
}

Line::Line(const mission::Entry& entry) : entry_(entry), text_(entry.text()) {
  if (text_.size() > model::kLongestText)
    fail("the line is longer than " + std::to_string(model::kLongestText) + " bytes; shorten it");
  drop(0);
}

// Drops so much and the spaces behind it.
void Line::drop(std::size_t bytes) {
  at_ += bytes;
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t')) ++at_;
}

void Line::expect_end() const {
  if (!ends()) fail("'" + rest() + "' stands where the line should end; take it out");
}

bool Line::take(std::string_view symbol) {
  if (!left().starts_with(symbol)) return false;
  drop(symbol.size());
  return true;
}

void Line::expect(std::string_view symbol) {
  if (!take(symbol))
    fail("expected '" + std::string(symbol) + "' " +
         (ends() ? "at the end; close it, and inside of [ ] and { } put quotes round what has a comma"
                 : "before '" + rest() + "'"));
}

bool Line::take_word(std::string_view word) {
  return left().substr(0, name_length(left())) == word && take(word);
}

bool Line::at_name() const { return name_length(left()) > 0; }

std::string Line::name() {
  const std::size_t length = name_length(left());
  if (length == 0)
    fail("expected a name " + (ends() ? std::string("at the end") : "before '" + rest() + "'") +
         "; names have letters, digits, '_' and '-' within, a letter or '_' at the front");
  std::string out(left().substr(0, length));
  drop(length);
  return out;
}

Application Line::application() {
  Application out{name(), {}};
  if (!take("(") || take(")")) return out;
  do out.arguments.push_back(name());
  while (take(","));
  expect(")");
  return out;
}

std::optional<double> Line::number() {
  if (at_name()) return std::nullopt;  // not "inf"
  double value = 0;
  const std::string_view text = left();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc() || !std::isfinite(value)) fail("expected a finite number before '" + rest() + "'");
  drop(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace roci::planner::timeline_htn::reading
