#include "core/terrain/pgm.hpp"

#include <cctype>
#include <fstream>
#include <iterator>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {
namespace {

constexpr int kMaxSide = 16384;
constexpr int kMaxValue = 65535;

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw MapError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  std::string_view magic() {
    if (bytes_.size() < 2 || bytes_[0] != 'P' || (bytes_[1] != '2' && bytes_[1] != '5')) {
      fail("not a PGM image (it must begin with P2 or P5); convert it, for example with netpbm's anytopnm");
    }
    at_ = 2;
    return bytes_.substr(0, 2);
  }

  int number(const char* what, int low, int high) {
    skip_space_and_comments();
    if (at_ == bytes_.size()) fail(std::string("the file ends where the ") + what + " should stand");
    long value = 0;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[at_])) != 0 &&
           value <= high) {
      value = value * 10 + (bytes_[at_++] - '0');
    }
    if (begin == at_) fail(std::string("the ") + what + " is not a number");
    if (value < low || value > high) {
      fail(std::string("the ") + what + " is out of range " + std::to_string(low) + " … " +
           std::to_string(high));
    }
    return static_cast<int>(value);
  }

  // Returns what follows the single white space after the header of a raw image.
  std::string_view raster() {
    if (at_ == bytes_.size() || std::isspace(static_cast<unsigned char>(bytes_[at_])) == 0) {
      fail("one white space must stand between the largest value and the pixels");
    }
    return bytes_.substr(at_ + 1);
  }

 private:
  void skip_space_and_comments() {
    bool comment = false;
    for (; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') comment = true;
      if (c == '\n') {
        comment = false;
        ++line_;
      }
      if (!comment && std::isspace(static_cast<unsigned char>(c)) == 0) return;
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void read_raw(Reader& reader, GreyImage& image, std::size_t pixel_count) {
  const std::string_view raster = reader.raster();
  const std::size_t bytes_per_pixel = image.max_value > 255 ? 2 : 1;
  if (raster.size() < pixel_count * bytes_per_pixel) {
    reader.fail("truncated: " + std::to_string(pixel_count * bytes_per_pixel) +
                " bytes of pixels are announced, " + std::to_string(raster.size()) +
                " are there; generate or copy the file again");
  }
  for (std::size_t i = 0; i < pixel_count; ++i) {
    const auto byte = [&](std::size_t k) {
      return static_cast<unsigned char>(raster[i * bytes_per_pixel + k]);
    };
    const int value = bytes_per_pixel == 2 ? byte(0) * 256 + byte(1) : byte(0);
    if (value > image.max_value) {
      reader.fail("pixel " + std::to_string(i) + " is " + std::to_string(value) +
                  ", more than the largest value " + std::to_string(image.max_value) + " of the header");
    }
    image.pixels.push_back(static_cast<std::uint16_t>(value));
  }
}

}  // namespace

GreyImage parse_pgm(std::string_view bytes, const std::string& name) {
  Reader reader(bytes, name);
  const bool plain = reader.magic() == "P2";
  GreyImage image;
  image.width = reader.number("width", 1, kMaxSide);
  image.height = reader.number("height", 1, kMaxSide);
  image.max_value = reader.number("largest value", 1, kMaxValue);
  const std::size_t pixel_count =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (plain) {
    for (std::size_t i = 0; i < pixel_count; ++i) {
      image.pixels.push_back(static_cast<std::uint16_t>(reader.number("pixel", 0, image.max_value)));
    }
  } else {
    read_raw(reader, image, pixel_count);
  }
  return image;
}

GreyImage read_pgm(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    throw MapError(file.string() + ": cannot open the image; check the path and the permissions");
  }
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return parse_pgm(bytes, file.string());
}

std::string to_pgm(const GreyImage& image, const std::string& comment) {
  std::string out = "P5\n";
  if (!comment.empty()) out += "# " + comment + "\n";
  out += std::to_string(image.width) + " " + std::to_string(image.height) + "\n" +
         std::to_string(image.max_value) + "\n";
  for (const std::uint16_t value : image.pixels) {
    if (image.max_value > 255) out += static_cast<char>(value >> 8);
    out += static_cast<char>(value & 0xFF);
  }
  return out;
}

}  // namespace roci::terrain
