#include "tests/unit/exec_svc/trace/map_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/mission/entry.hpp"

namespace roci::exec::trace::testing {

namespace fs = std::filesystem;

Folder::Folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  path_ = fs::temp_directory_path() /
          (std::string("roci_trace_") + std::to_string(::getpid()) + "_" + test->name());
  fs::remove_all(path_);
  fs::create_directories(path_);
}

Folder::~Folder() { fs::remove_all(path_); }

fs::path Folder::write(const std::string& name, const std::string& text) const {
  fs::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

TraceMap map_of(const std::string& sections) {
  const Folder folder;
  return read_map(folder.write("a.map.yaml", "format: 1\n" + sections));
}

std::string complaint_about(const std::string& text) {
  const Folder folder;
  try {
    read_map(folder.write("a.map.yaml", text));
  } catch (const mission::FileError& error) {
    return std::string(error.what()).substr(folder.path().string().size() + 1);
  }
  return "";
}

RecordedTrace trace_of(const std::string& lines, const std::string& scenario) {
  RecordedTrace out;
  out.scenario = scenario;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    out.lines.push_back(
        {temporal::seconds(std::stod(line.substr(0, space))), line.substr(space + 1), out.lines.size() + 1});
  }
  return out;
}

}  // namespace roci::exec::trace::testing
