#include "core/mission/model_text.hpp"

#include <algorithm>
#include <fstream>
#include <optional>

namespace roci::mission {

namespace {

constexpr std::string_view kHead = "--- # file: ";

// What a text of the size of a model holds; nothing: it cannot be read, or there is more.
std::optional<std::string> contents(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::string out(error ? 0 : std::min<std::uintmax_t>(size, kMostModelBytes) + 1, '\0');
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  out.resize(static_cast<std::size_t>(in.gcount()));
  return out;
}

bool has_line(const std::string& text, std::string_view beginning) {
  return text.starts_with(beginning) || text.find("\n" + std::string(beginning)) != std::string::npos;
}

// The names that a text includes; none where it is no YAML, which its reader tells.
std::vector<Entry> includes(const std::string& text, const std::filesystem::path& file) {
  if (!has_line(text, "include:")) return {};
  std::optional<Entry> root;
  try {
    root = Entry::parse(text, file.string());
  } catch (const FileError&) {
    return {};
  }
  const Entry list = root->at("include");
  return list.is_sequence() ? list.items() : std::vector<Entry>{list};
}

}  // namespace

std::string included_name(const std::string& includer, const std::string& included) {
  return (std::filesystem::path(includer).parent_path() / included).lexically_normal().string();
}

std::string model_text(const Entry& name) {
  const std::filesystem::path first = name.resolve(name.text());
  const auto own = contents(first);
  if (!own) name.fail("cannot read model file '" + name.text() + "'; check the path and its permissions");
  std::vector<ModelPart> parts{{first.filename().string(), *own}};
  std::size_t bytes = own->size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::filesystem::path file = first.parent_path() / parts[i].name;
    for (const Entry& one : includes(parts[i].text, file)) {
      const std::string included = included_name(parts[i].name, one.text());
      if (std::ranges::find(parts, included, &ModelPart::name) != parts.end()) continue;
      auto text = contents(first.parent_path() / included);
      if (!text) one.fail("no file '" + one.text() + "' beside this one; mend the name");
      if (has_line(*text, kHead) || has_line(parts[i].text, kHead))
        one.fail("a file of the model has a line that begins with '" + std::string(kHead) +
                 "', which parts files; write it otherwise");
      bytes += text->size();
      if (parts.size() == kMostModelFiles)
        one.fail("more than " + std::to_string(kMostModelFiles) + " files make up one model; join some");
      parts.push_back({included, std::move(*text)});
    }
  }
  if (bytes > kMostModelBytes)
    name.fail("the model has more than " + std::to_string(kMostModelBytes) + " bytes; make it smaller");
  if (parts.size() == 1) return std::move(parts.front().text);
  std::string out;
  for (const ModelPart& part : parts) {
    out.append(kHead).append(part.name).append("\n").append(part.text);
    if (!part.text.empty() && !part.text.ends_with('\n')) out += '\n';
  }
  return out;
}

std::vector<ModelPart> model_parts(const std::string& text, const std::string& name) {
  if (!text.starts_with(kHead)) return {{name, text}};
  std::vector<ModelPart> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t named = at + kHead.size();
    const std::size_t begins = std::min(text.find('\n', named), text.size() - 1) + 1;
    const std::size_t next = text.find("\n" + std::string(kHead), begins - 1);
    const std::size_t ends = next == std::string::npos ? text.size() : next + 1;
    out.push_back({text.substr(named, begins - named - 1), text.substr(begins, ends - begins)});
    at = ends;
  }
  return out;
}

}  // namespace roci::mission
