#include "ground_console/cli/watch/canvas.hpp"

namespace roci::console::cli::watch {
namespace {

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

// One code point as it may go to a terminal: control characters and broken UTF-8 become "?".
std::string printable(std::string_view glyph) {
  const auto lead = static_cast<unsigned char>(glyph.front());
  const std::size_t length = lead < 0x80U ? 1 : lead < 0xC2U ? 0 : lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  const bool control = lead < 0x20U || lead == 0x7FU ||
                       (lead == 0xC2U && glyph.size() > 1 && static_cast<unsigned char>(glyph[1]) < 0xA0U);
  return control || glyph.size() != length || lead > 0xF4U ? "?" : std::string(glyph);
}

const char* code_of(Style style) {
  switch (style) {
    case Style::plain:
      return "\x1b[0m";
    case Style::dim:
      return "\x1b[0;2m";
    case Style::title:
      return "\x1b[0;1m";
    case Style::good:
      return "\x1b[0;32m";
    case Style::active:
      return "\x1b[0;36m";
    case Style::warning:
      return "\x1b[0;33m";
    case Style::bad:
      return "\x1b[0;31m";
  }
  return "";
}

}  // namespace

std::size_t Canvas::put(std::size_t row, std::size_t column, std::string_view text, Style style,
                        std::size_t limit) {
  for (std::size_t begin = 0; begin < text.size() && limit > 0; ++column, --limit) {
    std::size_t end = begin + 1;
    while (end < text.size() && continues(text[end])) ++end;
    if (row < height() && column < width_) {
      cells_[row * width_ + column] = {printable(text.substr(begin, end - begin)), style};
    }
    begin = end;
  }
  return column;
}

std::string Canvas::text(bool colours) const {
  std::string out;
  for (std::size_t row = 0; row < height(); ++row) {
    Style style = Style::plain;
    std::string blanks;
    for (std::size_t column = 0; column < width_; ++column) {
      const Cell& cell = cells_[row * width_ + column];
      if (cell.glyph.empty() || cell.glyph == " ") {
        blanks += ' ';
        continue;
      }
      out += blanks;
      blanks.clear();
      if (colours && cell.style != style) out += code_of(style = cell.style);
      out += cell.glyph;
    }
    if (style != Style::plain) out += code_of(Style::plain);
    out += '\n';
  }
  return out;
}

}  // namespace roci::console::cli::watch
