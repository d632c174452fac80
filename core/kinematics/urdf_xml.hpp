// Reading numbers out of URDF elements, with errors that name the element and its line.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "core/kinematics/urdf.hpp"

namespace roci::kinematics::xml {

/// Thrown inside the URDF reader only; check_urdf() turns it into its return value.
struct Failure {
  int line;
  std::string element;
  std::string message;
};

/// "joint 'elbow'" for a named element, "limit" for another.
std::string label(const tinyxml2::XMLElement& element);

[[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& message);

/// The attribute, which must be there and not be empty.
std::string required_text(const tinyxml2::XMLElement& element, const char* attribute);

/// Exactly `count` finite numbers from an attribute; `fallback` where the attribute is missing.
std::vector<double> numbers(const tinyxml2::XMLElement& element, const char* attribute, std::size_t count,
                            const std::vector<double>& fallback);

/// One finite number; the attribute must be there.
double required_number(const tinyxml2::XMLElement& element, const char* attribute);

}  // namespace roci::kinematics::xml
