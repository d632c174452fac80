// Typed reads from YAML with errors that carry the place. Used by setup_file.cpp alone.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

namespace roci::arm::yaml {

// Thrown inside the reader only; parse_setup() turns it into its return value.
struct Failure {
  YAML::Mark mark;
  std::string message;
};

// `node` must be a map whose keys are all in `known`.
void require_map(const YAML::Node& node, const std::string& what, std::initializer_list<const char*> known);

double number(const YAML::Node& node, const std::string& what, double low, double high);
std::string text(const YAML::Node& node, const std::string& what);
std::vector<double> numbers(const YAML::Node& node, const std::string& what);
Eigen::Vector3d vector3(const YAML::Node& node, const std::string& what);
Eigen::Vector3d direction(const YAML::Node& node, const std::string& what);  // not zero; made a unit vector

}  // namespace roci::arm::yaml
