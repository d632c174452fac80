// This error belongs to every reader of maps and sites.
#pragma once

#include <stdexcept>
#include <string>

namespace roci::terrain {

/// Reports a map that cannot be used. what() reads "file:line:column: what is wrong; remedy" (line and column
/// only where the fault has a place in a text).
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace roci::terrain
