#include "services/process/incarnation.hpp"

#include <fstream>
#include <stdexcept>

namespace roci::services::process {

std::uint32_t next_incarnation(const std::filesystem::path& folder, const std::string& service) {
  const auto file = folder / (service + ".incarnation");
  std::uint32_t last = 0;
  std::ifstream(file) >> last;
  const auto unfinished = std::filesystem::path(file).concat(".new");
  std::ofstream out(unfinished);
  if (!(out << last + 1 << '\n' << std::flush))
    throw std::runtime_error("cannot write " + unfinished.string());
  out.close();
  std::filesystem::rename(unfinished, file);
  return last + 1;
}

}  // namespace roci::services::process
