#pragma once
#include <filesystem>

#include "ground_console/cli/map/picture.hpp"

namespace roci::console::cli::map {

/// Writes the picture as PNG with libpng. Throws std::runtime_error that names the file and what is wrong.
void write_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace roci::console::cli::map
