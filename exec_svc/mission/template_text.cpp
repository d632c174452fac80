#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::mission {

std::string fill_positions(const std::string& text, const std::vector<std::string>& arguments) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool position = text[i] == '?' && i + 1 < text.size() && text[i + 1] >= '1' && text[i + 1] <= '9';
    const std::size_t index = position ? static_cast<std::size_t>(text[i + 1] - '1') : 0;
    if (position && index < arguments.size()) {
      out += arguments[index];
      ++i;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string fill_star(const std::string& text, const std::string& object) {
  std::string out;
  for (char c : text) {
    if (c == '*') {
      out += object;
    } else {
      out += c;
    }
  }
  return out;
}

std::string fill_names(const std::string& text, const std::map<std::string, std::string>& values) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == '{' ? text.find('}', i) : std::string::npos;
    const auto value = end == std::string::npos ? values.end() : values.find(text.substr(i + 1, end - i - 1));
    if (value != values.end()) {
      out += value->second;
      i = end;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::vector<std::string> words_of(const std::string& fact) {
  std::vector<std::string> out;
  std::string word;
  for (char c : fact) {
    if (c == '(' || c == ')' || c == ' ' || c == '\t' || c == '\n') {
      if (!word.empty()) out.push_back(std::move(word));
      word.clear();
    } else {
      word += c;
    }
  }
  if (!word.empty()) out.push_back(std::move(word));
  return out;
}

}  // namespace roci::exec::mission
