// One line of the small languages inside of a model: "navigation.traverse(from, to)", "at(x) -> driving(x, y)",
// "2 * distance(a, b) + 5".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/entry.hpp"

namespace roci::planner::timeline_htn::reading {

/// Holds a name with arguments: "edge(a, b)".
struct Application {
  std::string name;
  std::vector<std::string> arguments;
};

/// Reads the words of an entry's text one after the other. Every fault is FileError with the place of the entry.
class Line {
 public:
  explicit Line(const mission::Entry& entry);

  /// Returns whether nothing is left.
  bool ends() const { return at_ == text_.size(); }
  void expect_end() const;
  /// Takes the symbol if it comes next.
  bool take(std::string_view symbol);
  void expect(std::string_view symbol);
  /// Takes the word if it comes next, whole.
  bool take_word(std::string_view word);
  /// Returns whether a name comes next.
  bool at_name() const;
  /// Takes a name: letters, digits, '_' and '-' within, a letter or '_' at the front.
  std::string name();
  /// Takes a name with its arguments, if it has any.
  Application application();
  /// Takes a number if one comes next.
  std::optional<double> number();

  [[noreturn]] void fail(const std::string& what) const { entry_.fail(what); }
  const mission::Entry& entry() const { return entry_; }
  std::string rest() const { return text_.substr(at_); }

 private:
  std::string_view left() const { return std::string_view(text_).substr(at_); }
  void drop(std::size_t bytes);

  mission::Entry entry_;
  std::string text_;
  std::size_t at_ = 0;
};

/// Returns whether the text is such a name.
bool is_name(std::string_view text);

}  // namespace roci::planner::timeline_htn::reading
