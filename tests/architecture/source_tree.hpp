// The project's own source files, read for what they include.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace roci::architecture {

struct SourceFile {
  std::string path;                   // relative to the top of the tree, with /
  std::vector<std::string> includes;  // as written, without quotes or brackets
  std::vector<std::string> lines;

  bool under(const std::string& folder) const { return path.starts_with(folder + "/"); }
  std::string name() const { return path.substr(path.find_last_of('/') + 1); }
};

// Every .hpp and .cpp below `folders` of the tree at `root`. Throws if a folder is missing.
std::vector<SourceFile> read_sources(const std::filesystem::path& root,
                                     const std::vector<std::string>& folders);

// What breaks the house's rules, one line each: "file: what; remedy".
std::vector<std::string> broken_rules(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
