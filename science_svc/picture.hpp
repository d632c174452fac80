// Images come from the wire: they are read with limits, and cut with marks.
#pragma once
#include <string>
#include <string_view>

#include "core/terrain/pgm.hpp"

namespace roci::science {

/// Reads a binary PGM file of 8 bits and 16 … kSidePixels pixels a side (limits.hpp), whoever wrote it. Throws
/// terrain::MapError, which names the image and says what is wrong, for anything else; memory is taken for what is
/// there, not for what a header claims.
terrain::GreyImage read_picture(std::string_view file, const std::string& id);

/// Holds a rectangle of pixels; `left` and `top` are its first ones.
struct Window {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Returns the part of an image that lies in the window, as a binary PGM file.
std::string cut(const terrain::GreyImage&, const Window&);

}  // namespace roci::science
