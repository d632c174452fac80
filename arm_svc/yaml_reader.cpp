#include "arm_svc/yaml_reader.hpp"

#include <algorithm>
#include <cmath>

namespace roci::arm::yaml {
namespace {

double finite(const YAML::Node& node, const std::string& what) {
  double value = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    throw Failure{node.Mark(), what + " must be a finite number"};
  }
  return value;
}

}  // namespace

void require_map(const YAML::Node& node, const std::string& what, std::initializer_list<const char*> known) {
  if (!node.IsMap()) throw Failure{node.Mark(), what + " must be a map of keys and values"};
  for (const auto& entry : node) {
    const std::string key = text(entry.first, "a key of " + what);
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const char* name : known) list += (list.empty() ? "" : ", ") + std::string(name);
    throw Failure{entry.first.Mark(), what + " has no key '" + key + "'; it takes " + list};
  }
}

double number(const YAML::Node& node, const std::string& what, double low, double high) {
  const double value = finite(node, what);
  if (value >= low && value <= high) return value;
  throw Failure{node.Mark(),
                what + " must be between " + std::to_string(low) + " and " + std::to_string(high)};
}

std::string text(const YAML::Node& node, const std::string& what) {
  if (!node.IsScalar() || node.Scalar().empty()) throw Failure{node.Mark(), what + " must be a name"};
  return node.Scalar();
}

std::vector<double> numbers(const YAML::Node& node, const std::string& what) {
  if (!node.IsSequence()) throw Failure{node.Mark(), what + " must be a list of numbers"};
  std::vector<double> values;
  for (const auto& entry : node) values.push_back(finite(entry, "each entry of " + what));
  return values;
}

Eigen::Vector3d vector3(const YAML::Node& node, const std::string& what) {
  const std::vector<double> values = numbers(node, what);
  if (values.size() != 3) throw Failure{node.Mark(), what + " must have three numbers"};
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d direction(const YAML::Node& node, const std::string& what) {
  const Eigen::Vector3d vector = vector3(node, what);
  if (!(vector.norm() > 1e-9)) throw Failure{node.Mark(), what + " must not be zero"};
  return vector.stableNormalized();
}

}  // namespace roci::arm::yaml
