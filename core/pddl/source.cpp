#include "core/pddl/source.hpp"

#include <sstream>
#include <utility>

namespace roci::pddl {

std::string to_string(const Diagnostic& diagnostic) {
  std::ostringstream text;
  text << diagnostic.file;
  if (diagnostic.where.line > 0) text << ':' << diagnostic.where.line << ':' << diagnostic.where.column;
  text << ": error: " << diagnostic.message;
  if (!diagnostic.remedy.empty()) text << " (" << diagnostic.remedy << ')';
  return text.str();
}

ParseError::ParseError(Diagnostic diagnostic)
    : std::runtime_error(to_string(diagnostic)), diagnostic_(std::move(diagnostic)) {}

}  // namespace roci::pddl
