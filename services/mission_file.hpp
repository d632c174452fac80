// Mission files are YAML; errors name file, line, column and remedy.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace YAML {
class Node;
}

namespace roci::services {

class MissionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws MissionError "file:line:column: what is wrong; remedy".
YAML::Node load_yaml(const std::filesystem::path&);

}  // namespace roci::services
