#include "core/pddl/line_scanner.hpp"

#include <algorithm>

#include "core/pddl/sexpr.hpp"

namespace roci::pddl {

LineScanner::LineScanner(std::string_view text, std::string_view file, int line)
    : text_(text.substr(0, text.find(';'))), file_(file), line_(line) {}

void LineScanner::fail(SourceLocation where, std::string message, std::string_view remedy) const {
  throw ParseError({std::string(file_), where, std::move(message), std::string(remedy)});
}

void LineScanner::skip_blank() {
  while (next_ < text_.size() && (text_[next_] == ' ' || text_[next_] == '\t' || text_[next_] == '\r'))
    ++next_;
}

bool LineScanner::at_end() {
  skip_blank();
  return next_ == text_.size();
}

bool LineScanner::take(char c) {
  if (at_end() || text_[next_] != c) return false;
  ++next_;
  return true;
}

void LineScanner::expect(char c, std::string_view remedy) {
  if (!take(c)) fail(here(), std::string("'") + c + "' expected", remedy);
}

void LineScanner::expect_end(std::string_view remedy) {
  if (!at_end()) fail(here(), "more text than expected", remedy);
}

std::string LineScanner::take_word() {
  static constexpr std::string_view kEnds = " \t\r()[]:";
  skip_blank();
  const std::size_t end = std::min(text_.find_first_of(kEnds, next_), text_.size());
  std::string word(text_.substr(next_, end - next_));
  next_ = end;
  for (char& c : word) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return word;
}

double LineScanner::expect_number(std::string_view what) {
  skip_blank();
  const SourceLocation where = here();
  if (const auto number = as_number(take_word())) return *number;
  fail(where, std::string(what) + " expected", "write a finite decimal number");
}

Atom LineScanner::expect_ground_atom(std::string_view what) {
  static constexpr std::string_view kRemedy = "write (NAME OBJECT …)";
  Atom atom;
  skip_blank();
  atom.where = here();
  if (!take('(')) fail(here(), std::string(what) + " expected", kRemedy);
  atom.symbol = take_word();
  if (atom.symbol.empty()) fail(here(), std::string(what) + " without a name", kRemedy);
  while (!take(')')) {
    skip_blank();
    Term object;
    object.where = here();
    object.name = take_word();
    if (object.name.empty()) fail(here(), "')' expected", kRemedy);
    if (object.is_variable()) fail(object.where, "a variable in a ground atom", "name the object");
    atom.arguments.push_back(std::move(object));
  }
  return atom;
}

void for_each_line(std::string_view text, std::string_view file,
                   const std::function<void(LineScanner&)>& read) {
  int line = 0;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    LineScanner scanner(text.substr(0, length), file, ++line);
    if (!scanner.at_end()) read(scanner);
    text.remove_prefix(std::min(length + 1, text.size()));
  }
}

}  // namespace roci::pddl
