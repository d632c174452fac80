#include <algorithm>
#include <cctype>
#include <string>

#include "core/terrain/geotiff.hpp"

namespace roci::terrain {

bool is_geotiff_name(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".tif" || extension == ".tiff";
}

}  // namespace roci::terrain
