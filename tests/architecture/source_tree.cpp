#include "tests/architecture/source_tree.hpp"

#include <algorithm>
#include <fstream>

namespace roci::architecture {
namespace {

// What an #include line names; empty for any other line.
std::string included(const std::string& line) {
  const auto hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) return "";
  const auto open = line.find_first_of("\"<", hash);
  const auto close = open == std::string::npos ? open : line.find_first_of("\">", open + 1);
  return close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

SourceFile read(const std::filesystem::path& root, const std::filesystem::path& file) {
  SourceFile out;
  out.path = std::filesystem::relative(file, root).generic_string();
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (std::string name = included(line); !name.empty()) out.includes.push_back(std::move(name));
    out.lines.push_back(std::move(line));
  }
  return out;
}

}  // namespace

std::vector<SourceFile> read_sources(const std::filesystem::path& root,
                                     const std::vector<std::string>& folders) {
  std::vector<SourceFile> out;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") out.push_back(read(root, entry.path()));
    }
  }
  std::sort(out.begin(), out.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return out;
}

}  // namespace roci::architecture
