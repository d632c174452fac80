// A folder for a test's files, and trace maps as text.
#pragma once

#include <filesystem>
#include <string>

#include "exec_svc/trace/recorded_trace.hpp"
#include "exec_svc/trace/trace_map.hpp"

namespace roci::exec::trace::testing {

// Named after the running test; empty at first, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

// The map with these sections; its first line is `format: 1`.
TraceMap map_of(const std::string& sections);

// What read_map() says of a whole file; empty when it says nothing.
std::string complaint_about(const std::string& text);

// Lines "SECONDS TEXT", numbered from 1 on.
RecordedTrace trace_of(const std::string& lines, const std::string& scenario = "nominal");

}  // namespace roci::exec::trace::testing
