#include "tests/architecture/documentation.hpp"

#include <regex>

namespace roci::architecture {
namespace {

using Lines = std::vector<std::string>;

bool is_type(const std::string& line) {
  static const std::regex type(R"((class|struct|union|enum) .*)");
  return std::regex_match(line, type);
}

// The first line behind `template <…>` and `requires …`.
std::size_t behind_template(const Lines& lines, std::size_t from) {
  while (from < lines.size() && (lines[from].starts_with("template") || lines[from].starts_with("requires") ||
                                 lines[from].starts_with(" ")))
    ++from;
  return from;
}

// What is declared from a line on, up to the brace or the semicolon that ends its head, this one included.
std::string head_of(const Lines& lines, std::size_t from) {
  std::string head;
  for (; from < lines.size(); ++from) {
    const auto end = lines[from].find_first_of("{;");
    head += lines[from].substr(0, end == std::string::npos ? end : end + 1) + " ";
    if (end != std::string::npos) break;
  }
  return head;
}

// The name of the type that the head defines; empty for a declaration and for a specialisation.
std::string defined_type(const std::string& head) {
  static const std::regex definition(R"((class|struct|union|enum)( class| struct)? ([\w:]+)( [^;]*)?\{ )");
  std::smatch match;
  return std::regex_match(head, match, definition) ? match[3].str() : "";
}

// The name of the function that the head of a template declares; empty for anything else.
std::string declared_function(const std::string& head) {
  static const std::regex other(R"((using|concept|friend) .*|\w+\(.*\) -> .*)");
  static const std::regex function(R"([^(=]*?(\w+)\(.*)");
  std::smatch match;
  if (std::regex_match(head, other) || !std::regex_match(head, match, function)) return "";
  return match[1] == "fields" ? "" : match[1].str();
}

void check(const SourceFile& file, std::vector<std::string>& out) {
  static const std::regex hides(R"(namespace (detail )?\{.*)");
  static const std::regex hides_no_more(R"(\}  // namespace( detail)?)");
  int hidden = 0;
  const Lines& lines = file.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (std::regex_match(line, hides)) ++hidden;
    if (hidden > 0 && std::regex_match(line, hides_no_more)) --hidden;
    const bool is_template = line.starts_with("template") && !line.starts_with("template <>");
    if (hidden > 0 || (!is_template && !is_type(line))) continue;
    const std::size_t declared = behind_template(lines, i);
    const bool of_type = declared < lines.size() && is_type(lines[declared]);
    const std::string head = head_of(lines, declared);
    const std::string name = of_type ? defined_type(head) : declared_function(head);
    const bool documented = (i > 0 && lines[i - 1].starts_with("///")) ||
                            (declared < lines.size() && lines[declared].find("///<") != std::string::npos);
    if (!name.empty() && !documented)
      out.push_back(file.path + ": " + name + " has no comment above it; say with /// what it guarantees");
    i = declared;
  }
}

}  // namespace

std::vector<std::string> undocumented(const std::vector<SourceFile>& files) {
  std::vector<std::string> out;
  for (const SourceFile& file : files)
    if (file.name().ends_with(".hpp")) check(file, out);
  return out;
}

}  // namespace roci::architecture
