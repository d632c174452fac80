#include "core/kinematics/urdf_xml.hpp"

#include <cmath>
#include <locale>
#include <sstream>

namespace roci::kinematics::xml {

std::string label(const tinyxml2::XMLElement& element) {
  const char* name = element.Attribute("name");
  const std::string kind = element.Name();
  return name == nullptr ? kind : kind + " '" + name + "'";
}

void fail(const tinyxml2::XMLElement& element, const std::string& message) {
  throw Failure{element.GetLineNum(), label(element), message};
}

std::string required_text(const tinyxml2::XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr || *text == '\0') fail(element, std::string("needs the attribute '") + attribute + "'");
  return text;
}

std::vector<double> numbers(const tinyxml2::XMLElement& element, const char* attribute, std::size_t count,
                            const std::vector<double>& fallback) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) return fallback;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::vector<double> values;
  double value = 0;
  while (values.size() <= count && stream >> value) values.push_back(value);
  bool good = stream.eof() && values.size() == count;
  for (double v : values) good = good && std::isfinite(v);
  if (!good) {
    fail(element, std::string("attribute '") + attribute + "' must be " + std::to_string(count) +
                      (count == 1 ? " finite number" : " finite numbers") + ", not '" + text + "'");
  }
  return values;
}

double required_number(const tinyxml2::XMLElement& element, const char* attribute) {
  required_text(element, attribute);
  return numbers(element, attribute, 1, {}).front();
}

}  // namespace roci::kinematics::xml
