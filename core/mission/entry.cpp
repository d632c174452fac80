#include "core/mission/entry.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "core/mission/findings.hpp"
#include "core/mission/told_error.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::mission {
namespace {

std::string place_of(const std::filesystem::path& file, const YAML::Mark& mark) {
  if (mark.is_null()) return file.string();
  return file.string() + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

std::string listed(std::initializer_list<std::string_view> names) {
  std::string out;
  for (std::string_view name : names) {
    if (!out.empty()) out += ", ";
    out += name;
  }
  return out;
}

}  // namespace

Entry::Entry(std::shared_ptr<const Document> document, const YAML::Node& node)
    : document_(std::move(document)), node_(std::make_shared<const YAML::Node>(node)) {}

Entry Entry::load(const std::filesystem::path& file, Findings* findings) {
  auto document = std::make_shared<const Document>(Document{file, findings});
  try {
    YAML::Node root = YAML::LoadFile(file.string());
    if (!root.IsMap())
      throw FileError(file.string() + ":1:1: the file holds no 'key: value' pairs; see docs/missions.md");
    return Entry(document, root);
  } catch (const YAML::BadFile&) {
    std::error_code unknown;
    throw FileError(file.string() + (std::filesystem::is_directory(file, unknown)
                                         ? ": is a folder; name the file in it"
                                         : ": cannot be read; check that the file exists"));
  } catch (const YAML::Exception& error) {
    throw FileError(place_of(file, error.mark) + ": not valid YAML (" + error.msg +
                    "); mend the syntax there");
  }
}

Entry Entry::parse(const std::string& text, const std::string& name, Findings* findings) {
  auto document = std::make_shared<const Document>(Document{name, findings});
  try {
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw FileError(name + ":1:1: it holds no 'key: value' pairs; see docs/missions.md");
    return Entry(document, root);
  } catch (const YAML::Exception& error) {
    throw FileError(place_of(document->file, error.mark) + ": not valid YAML (" + error.msg +
                    "); mend the syntax there");
  }
}

Entry Entry::at(std::string_view key) const {
  if (auto entry = find(key)) return *entry;
  fail("'" + std::string(key) + "' is missing; add it");
}

Entry Entry::with_base(const Entry& base) const {
  for (const Entry* one : {this, &base})
    if (!one->is_mapping()) one->fail("expected 'key: value' pairs");
  Entry out = *this;
  out.base_ = std::make_shared<const Entry>(base);
  return out;
}

std::optional<Entry> Entry::find(std::string_view key) const {
  if (!node().IsMap()) fail("expected 'key: value' pairs");
  const YAML::Node child = node()[std::string(key)];
  if (!child.IsDefined() && base_) return base_->find(key);
  if (!child.IsDefined() || child.IsNull()) return std::nullopt;
  return Entry(document_, child);
}

std::vector<Entry> Entry::items() const {
  if (!node().IsSequence()) fail("expected a list");
  std::vector<Entry> out;
  for (const YAML::Node& child : node()) out.push_back(Entry(document_, child));
  return out;
}

std::vector<std::pair<std::string, Entry>> Entry::fields() const {
  if (!node().IsMap()) fail("expected 'key: value' pairs");
  std::vector<std::pair<std::string, Entry>> out;
  for (const auto& child : node())
    out.emplace_back(Entry(document_, child.first).text(), Entry(document_, child.second));
  if (base_)
    for (auto& field : base_->fields())
      if (!node()[field.first].IsDefined()) out.push_back(std::move(field));
  return out;
}

void Entry::each(const std::function<void(const Entry&)>& read) const {
  for (const Entry& item : items()) item.attempt([&] { read(item); });
}

void Entry::each_field(const std::function<void(const std::string&, const Entry&)>& read) const {
  for (const auto& [key, value] : fields())
    value.attempt([&, &key = key, &value = value] { read(key, value); });
}

bool Entry::is_mapping() const { return node().IsMap(); }

bool Entry::is_sequence() const { return node().IsSequence(); }

std::string Entry::text() const {
  if (!node().IsScalar()) fail("expected a single value");
  return node().Scalar();
}

double Entry::number() const {
  double value = 0;
  if (!node().IsScalar() || !YAML::convert<double>::decode(node(), value) || !std::isfinite(value)) {
    fail("expected a finite number" +
         (node().IsScalar() ? ", not '" + node().Scalar() + "'" : std::string()));
  }
  return value;
}

std::int64_t Entry::integer() const {
  std::int64_t value = 0;
  if (!node().IsScalar() || !YAML::convert<std::int64_t>::decode(node(), value))
    fail("expected a whole number");
  return value;
}

bool Entry::truth() const {
  bool value = false;
  if (!node().IsScalar() || !YAML::convert<bool>::decode(node(), value)) fail("expected true or false");
  return value;
}

std::vector<std::string> Entry::texts() const {
  std::vector<std::string> out;
  for (const Entry& item : items()) out.push_back(item.text());
  return out;
}

std::string Entry::text_or(std::string_view key, std::string fallback) const {
  const auto entry = find(key);
  return entry ? entry->text() : fallback;
}

double Entry::number_or(std::string_view key, double fallback) const {
  const auto entry = find(key);
  return entry ? entry->number() : fallback;
}

bool Entry::truth_or(std::string_view key, bool fallback) const {
  const auto entry = find(key);
  return entry ? entry->truth() : fallback;
}

void Entry::allow_only(std::initializer_list<std::string_view> known) const {
  if (!node().IsMap()) fail("expected 'key: value' pairs");
  for (const auto& child : node()) {
    const Entry key(document_, child.first);
    if (std::find(known.begin(), known.end(), key.text()) != known.end()) continue;
    key.complain("unknown key '" + key.text() + "'; known here: " + listed(known) +
                 words::did_you_mean(key.text(), {known.begin(), known.end()}));
  }
  if (base_) base_->allow_only(known);
}

void Entry::fail(const std::string& what) const { throw FileError(place() + ": " + what); }

void Entry::complain(const std::string& what) const {
  attempt([&] { fail(what); });
}

void Entry::attempt(const std::function<void()>& read) const {
  if (document_->findings == nullptr) return read();
  try {
    read();
  } catch (const ToldError&) {
  } catch (const FileError& error) {
    document_->findings->add(error.what());
  }
}

std::string Entry::place() const { return place_of(document_->file, node().Mark()); }

const std::filesystem::path& Entry::file() const { return document_->file; }

std::filesystem::path Entry::resolve(const std::string& relative) const {
  return document_->file.parent_path() / relative;
}

}  // namespace roci::mission
