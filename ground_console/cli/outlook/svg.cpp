#include "ground_console/cli/outlook/svg.hpp"

#include <array>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <sstream>

#include "ground_console/cli/table.hpp"

namespace roci::console::cli::outlook {
namespace {

std::string number(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.1f", std::isfinite(value) ? value : 0.0);
  return buffer.data();
}

// Returns the bytes of the UTF-8 sequence that begins there; 0: none does.
std::size_t sequence_at(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  const std::size_t length = byte < 0x80                    ? 1
                             : byte >= 0xc2 && byte <= 0xdf ? 2
                             : byte >= 0xe0 && byte <= 0xef ? 3
                             : byte >= 0xf0 && byte <= 0xf4 ? 4
                                                            : 0;
  if (length == 0 || at + length > text.size()) return 0;
  std::uint32_t code = length == 1 ? byte : byte & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[at + i]);
    if ((next & 0xc0U) != 0x80U) return 0;
    code = code << 6U | (next & 0x3fU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool allowed = code >= kLeast[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) &&
                       code != 0xfffe && code != 0xffff;
  return allowed ? length : 0;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_at(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length == 0 || byte < 0x20 || byte == 0x7f) {
      out += '?';
      ++i;
      continue;
    }
    if (byte == '<') {
      out += "&lt;";
    } else if (byte == '>') {
      out += "&gt;";
    } else if (byte == '&') {
      out += "&amp;";
    } else if (byte == '"') {
      out += "&quot;";
    } else {
      out += text.substr(i, length);
    }
    i += length;
  }
  return out;
}

std::string attributes(const Ink& ink) {
  std::string out = " fill=\"" + ink.fill + "\"";
  if (ink.stroke != "none")
    out += " stroke=\"" + ink.stroke + "\" stroke-width=\"" + number(ink.width) + "\"";
  if (!ink.dashes.empty()) out += " stroke-dasharray=\"" + ink.dashes + "\"";
  if (ink.opacity < 1) out += " opacity=\"" + number(ink.opacity) + "\"";
  return out;
}

std::string listed(const std::vector<Svg::Point>& points) {
  std::string out;
  for (const auto& [x, y] : points) out += (out.empty() ? "" : " ") + number(x) + "," + number(y);
  return out;
}

}  // namespace

void Svg::rectangle(double x, double y, double width, double height, const Ink& ink, double corner) {
  body_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(std::max(0.0, width)) +
           "\" height=\"" + number(std::max(0.0, height)) + "\"" +
           (corner > 0 ? " rx=\"" + number(corner) + "\"" : "") + attributes(ink) + "/>\n";
}

void Svg::circle(double x, double y, double radius, const Ink& ink) {
  body_ += "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(radius) + "\"" +
           attributes(ink) + "/>\n";
}

void Svg::line(Point from, Point to, const Ink& ink) { polyline({from, to}, ink); }

void Svg::polyline(const std::vector<Point>& points, const Ink& ink) {
  body_ += "<polyline points=\"" + listed(points) + "\" stroke-linejoin=\"round\"" + attributes(ink) + "/>\n";
}

void Svg::polygon(const std::vector<Point>& points, const Ink& ink) {
  body_ += "<polygon points=\"" + listed(points) + "\"" + attributes(ink) + "/>\n";
}

void Svg::text(double x, double y, std::string_view text, const Letters& letters) {
  body_ +=
      "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-size=\"" + number(letters.size) +
      "\" fill=\"" + letters.colour + "\"" +
      (letters.anchor == "start" ? "" : " text-anchor=\"" + letters.anchor + "\"") +
      (letters.bold ? " font-weight=\"bold\"" : "") +
      (letters.halo ? " paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-opacity=\"0.75\""
                    : "") +
      ">" + escaped(text) + "</text>\n";
}

void Svg::text_within(double x, double y, double width, std::string_view all, const Letters& letters) {
  std::string cut(all);
  while (!cut.empty() && width_of(cut + (cut.size() < all.size() ? "…" : ""), letters.size) > width) {
    cut.pop_back();
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xc0U) == 0xc0U) cut.pop_back();
  }
  if (cut.size() < 3 && cut.size() < all.size()) return;  // nobody reads that
  text(x, y, cut.size() < all.size() ? cut + "…" : cut, letters);
}

void Svg::png(double x, double y, double width, double height, const std::vector<std::uint8_t>& bytes) {
  using Base64 = boost::archive::iterators::base64_from_binary<
      boost::archive::iterators::transform_width<std::vector<std::uint8_t>::const_iterator, 6, 8>>;
  std::string letters(Base64(bytes.begin()), Base64(bytes.end()));
  letters.append((3 - bytes.size() % 3) % 3, '=');
  body_ += "<image x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) +
           "\" height=\"" + number(height) + "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
           letters + "\"/>\n";
}

void Svg::clip(double x, double y, double width, double height) {
  const std::string name = "clip" + std::to_string(++clips_);
  body_ += "<clipPath id=\"" + name + "\">";
  rectangle(x, y, width, height, {.fill = "black"});
  body_ += "</clipPath>\n<g clip-path=\"url(#" + name + ")\">\n";
}

void Svg::open(std::string_view tip) { body_ += "<g><title>" + escaped(tip) + "</title>\n"; }
void Svg::close() { body_ += "</g>\n"; }

std::string Svg::document(double width, double height, std::string_view title) const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
         number(height) + "\" viewBox=\"0 0 " + number(width) + " " + number(height) +
         "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<title>" + escaped(title) +
         "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body_ + "</svg>\n";
}

double width_of(std::string_view text, double size) {
  constexpr double kLetter = 0.58;  // of the size, a mean of sans-serif
  return static_cast<double>(columns_of(text)) * size * kLetter;
}

std::vector<std::string> lines_of(std::string_view text, std::size_t letters) {
  std::vector<std::string> out;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    if (!out.empty() && columns_of(out.back()) + 1 + columns_of(word) <= letters) {
      out.back() += " " + word;
    } else {
      out.push_back(word);
    }
  }
  return out;
}

}  // namespace roci::console::cli::outlook
