// This file makes of the model that mission.yaml names one text that means the same wherever and whenever it
// is read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Bound one model: the number of files, and the bytes of all of them together.
inline constexpr std::size_t kMostModelFiles = 64;
inline constexpr std::size_t kMostModelBytes = 8U << 20U;

/// Returns the text of the file that an entry of mission.yaml names (`model`). A YAML file that includes others comes
/// with them: each file once, as a document of a stream, below a line `--- # file: NAME` that names it from the folder
/// of the first one. A request to plan thus carries the whole model as it was when the mission was read, whatever
/// becomes of the files later. Any other text stays as it is. Throws FileError where a file cannot be read or the model
/// is too large.
std::string model_text(const Entry& name);

/// Holds one file of a model that came as one text.
struct ModelPart {
  std::string name;  ///< as its line says; the given name if the text names no files
  std::string text;
};

/// Returns the files of such a text, in their order; a text without those lines is one.
std::vector<ModelPart> model_parts(const std::string& text, const std::string& name);

/// Returns the name of a file that another file of a model includes; both names start from the folder of the
/// first one.
std::string included_name(const std::string& includer, const std::string& included);

}  // namespace roci::mission
