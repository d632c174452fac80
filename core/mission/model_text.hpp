// The model that mission.yaml names, as one text that means the same wherever and whenever it is read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// How much one model may be: files, and bytes of all of them together.
inline constexpr std::size_t kMostModelFiles = 64;
inline constexpr std::size_t kMostModelBytes = 8U << 20U;

/// Returns the text of the file that an entry of mission.yaml names (`model`). A YAML file that includes others comes
/// with them: each file once, as a document of a stream, below a line `--- # file: NAME` that names it from the folder
/// of the first one. So what is sent with a request to plan is the whole model as it was when the mission was read, and
/// files that change later change nothing of it. Any other text stays as it is. Throws FileError where a file cannot be
/// read or there is too much.
std::string model_text(const Entry& name);

/// Is one file of a model that came as one text.
struct ModelPart {
  std::string name;  ///< as in its line; of a text that names no files the name that is given
  std::string text;
};

/// Returns the files of such a text, in their order; a text without those lines is one.
std::vector<ModelPart> model_parts(const std::string& text, const std::string& name);

/// Returns the name of what a file of a model includes: both from the folder of the first one.
std::string included_name(const std::string& includer, const std::string& included);

}  // namespace roci::mission
