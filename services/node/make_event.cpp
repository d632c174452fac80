#include "services/node/make_event.hpp"

namespace roci::services::node {

v1::Event make_event(v1::Severity severity, const std::string& code, const std::string& text,
                     const std::vector<std::pair<std::string, std::string>>& properties) {
  v1::Event event;
  event.severity_level(severity);
  event.code(code);
  event.text(text);
  for (const auto& [name, value] : properties) {
    v1::Property property;
    property.name(name);
    property.value(value);
    event.properties().push_back(std::move(property));
  }
  return event;
}

}  // namespace roci::services::node
