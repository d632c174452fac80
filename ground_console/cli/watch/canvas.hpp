// The canvas is a grid of styled characters, to be printed plain or with the terminal's colours.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace roci::console::cli::watch {

/// Names the styles of characters.
enum class Style { plain, dim, title, good, active, warning, bad };

/// Holds a grid of styled characters, and prints it.
class Canvas {
 public:
  Canvas(std::size_t width, std::size_t height) : width_(width), cells_(width * height) {}

  std::size_t width() const { return width_; }
  std::size_t height() const { return width_ == 0 ? 0 : cells_.size() / width_; }

  /// Writes UTF-8 `text`, one column for each code point, from (row, column), control characters as "?"; what
  /// lies outside, or is longer than `limit` columns, is cut. Returns the column after it.
  std::size_t put(std::size_t row, std::size_t column, std::string_view text, Style style = Style::plain,
                  std::size_t limit = std::string_view::npos);

  /// A line for each row; trailing blanks are left out.
  std::string plain() const { return text(false); }
  std::string coloured() const { return text(true); }

 private:
  struct Cell {
    std::string glyph;  // empty: blank
    Style style = Style::plain;
  };

  std::string text(bool colours) const;

  std::size_t width_;
  std::vector<Cell> cells_;
};

}  // namespace roci::console::cli::watch
