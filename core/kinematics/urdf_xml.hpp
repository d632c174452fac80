// This file reads numbers out of URDF elements, with errors that name the element and its line.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "core/kinematics/urdf.hpp"

namespace roci::kinematics::xml {

/// Carries a fault out of the URDF reader, inside it only; check_urdf() turns it into its return value.
struct Failure {
  int line;
  std::string element;
  std::string message;
};

/// Returns "joint 'elbow'" for a named element, "limit" for another.
std::string label(const tinyxml2::XMLElement& element);

/// Throws Failure for the element, with its line.
[[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& message);

/// Returns the attribute. Throws Failure if it is missing or empty.
std::string required_text(const tinyxml2::XMLElement& element, const char* attribute);

/// Returns exactly `count` finite numbers from an attribute, or `fallback` where the attribute is missing.
/// Throws Failure for anything else.
std::vector<double> numbers(const tinyxml2::XMLElement& element, const char* attribute, std::size_t count,
                            const std::vector<double>& fallback);

/// Returns one finite number. Throws Failure for anything else, and where the attribute is missing.
double required_number(const tinyxml2::XMLElement& element, const char* attribute);

}  // namespace roci::kinematics::xml
