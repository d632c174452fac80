#include "services/process/incarnation.hpp"

#include <fstream>
#include <string>

#include "core/durable/durable_file.hpp"

namespace roci::services::process {

std::uint32_t next_incarnation(const std::filesystem::path& folder, const std::string& service) {
  const auto file = folder / (service + ".incarnation");
  std::uint32_t last = 0;
  std::ifstream(file) >> last;
  durable::replace_file(file, std::to_string(last + 1) + "\n");
  return last + 1;
}

}  // namespace roci::services::process
