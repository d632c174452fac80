// This is a picture as an SVG document: shapes and texts in the order in which they are drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace roci::console::cli::outlook {

/// Says how a shape is drawn.
struct Ink {
  std::string fill = "none";
  std::string stroke = "none";
  double width = 1;
  std::string dashes{};  ///< e.g. "4 3"; empty: a whole line
  double opacity = 1;
};

/// Says how a text is drawn.
struct Letters {
  double size = 12;
  std::string colour = "#1d2733";
  std::string anchor = "start";  ///< or "middle", "end"
  bool bold = false;
  bool halo = false;  ///< they stand on a light rim
};

/// Collects shapes and texts, and writes them as an SVG document.
class Svg {
 public:
  using Point = std::pair<double, double>;

  void rectangle(double x, double y, double width, double height, const Ink& ink, double corner = 0);
  void circle(double x, double y, double radius, const Ink& ink);
  void line(Point from, Point to, const Ink& ink);
  void polyline(const std::vector<Point>& points, const Ink& ink);
  void polygon(const std::vector<Point>& points, const Ink& ink);
  /// Whatever bytes the text holds, the document stays well-formed: "?" stands for what is no text.
  void text(double x, double y, std::string_view text, const Letters& letters = {});
  /// The same, cut with "…" where it would be wider.
  void text_within(double x, double y, double width, std::string_view text, const Letters& letters = {});
  /// A picture of pixels, as the bytes of a PNG file, stretched over this rectangle.
  void png(double x, double y, double width, double height, const std::vector<std::uint8_t>& bytes);
  /// What is drawn until close() is cut at this rectangle. Close it like open().
  void clip(double x, double y, double width, double height);
  /// Shown by a browser where the pointer rests: of all that is drawn until close().
  void open(std::string_view tip);
  void close();

  /// Returns the document, on white, so large.
  std::string document(double width, double height, std::string_view title) const;

 private:
  std::string body_;
  std::size_t clips_ = 0;
};

/// Returns about how wide a text is in pixels.
double width_of(std::string_view text, double size);

/// Returns the lines of a text of at most so many letters, broken between words; a longer word stands alone.
std::vector<std::string> lines_of(std::string_view text, std::size_t letters);

}  // namespace roci::console::cli::outlook
