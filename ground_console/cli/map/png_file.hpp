// This file writes the picture of the ground as a PNG file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "ground_console/cli/map/picture.hpp"

namespace roci::console::cli::map {

/// Writes the picture as PNG with libpng. Throws std::runtime_error that names the file and what is wrong.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Returns what such a file holds. Throws std::runtime_error if there is no memory for it.
std::vector<std::uint8_t> png_bytes(const Picture& picture);

}  // namespace roci::console::cli::map
