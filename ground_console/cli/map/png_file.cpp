#include "ground_console/cli/map/png_file.hpp"

#include <png.h>

#include <stdexcept>

namespace roci::console::cli::map {

void write_png(const Picture& picture, const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  const std::vector<std::uint8_t> bytes = picture.bytes();
  if (png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(file.string() + ": cannot be written (" + image.message +
                             "); check the folder and its permissions");
  }
}

}  // namespace roci::console::cli::map
