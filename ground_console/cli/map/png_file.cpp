#include "ground_console/cli/map/png_file.hpp"

#include <png.h>

#include <stdexcept>

namespace roci::console::cli::map {

namespace {

png_image image_of(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  return image;
}

}  // namespace

void write_png(const Picture& picture, const std::filesystem::path& file) {
  png_image image = image_of(picture);
  const std::vector<std::uint8_t> bytes = picture.bytes();
  if (png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(file.string() + ": cannot be written (" + image.message +
                             "); check the folder and its permissions");
  }
}

std::vector<std::uint8_t> png_bytes(const Picture& picture) {
  png_image image = image_of(picture);
  const std::vector<std::uint8_t> pixels = picture.bytes();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> out(size);
  if (png_image_write_to_memory(&image, out.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("the ground cannot be drawn (") + image.message +
                             "); ask for a smaller picture");
  out.resize(size);
  return out;
}

}  // namespace roci::console::cli::map
