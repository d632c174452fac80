// Grey images are the files in which layers of a site are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace roci::terrain {

/// Holds a grey image as the netpbm PGM format has it (netpbm.sourceforge.net/doc/pgm.html): rows from the
/// top (north) down, values 0 … max_value, max_value 1 … 65535.
struct GreyImage {
  int width = 0;
  int height = 0;
  int max_value = 255;
  std::vector<std::uint16_t> pixels;
};

/// Parses PGM, plain (P2) or raw (P5; two bytes per pixel, the higher first, when max_value > 255). `name` is
/// how errors call the text. Throws MapError with line (header, P2) or the number of missing bytes (P5).
GreyImage parse_pgm(std::string_view bytes, const std::string& name);

/// Reads an image. Throws MapError when the file cannot be read or parsed.
GreyImage read_pgm(const std::filesystem::path& file);

/// Writes raw PGM (P5). `comment` becomes one line of the header, unless it is empty.
std::string to_pgm(const GreyImage& image, const std::string& comment);

}  // namespace roci::terrain
