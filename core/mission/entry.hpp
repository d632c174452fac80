// Mission files (YAML) are read with errors that name file, line, column and remedy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace YAML {
class Node;
}

namespace roci::mission {

class Findings;

/// Says in what(): "file:line:column: what is wrong; remedy".
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds one value of a mission file with its place in it. Every accessor throws FileError when the value is
/// not of the kind asked for.
///
/// A file that was loaded with `findings` is read to its end: each(), each_field(), attempt(), complain() and
/// allow_only() note a fault there and go on, so that one reader serves who flies (the first fault ends it) and
/// who checks (all of them).
class Entry {
 public:
  /// Reads the root of a file. Throws FileError if it cannot be read, is not YAML, or is not a mapping.
  static Entry load(const std::filesystem::path& file, Findings* findings = nullptr);
  /// Reads a text from elsewhere; `name` replaces the file's name in reported places. Throws FileError as
  /// load() does.
  static Entry parse(const std::string& text, const std::string& name, Findings* findings = nullptr);

  /// Returns this mapping, with the keys that it lacks taken from another one. A key that is present here counts
  /// even if its value is empty; nested mappings are not merged. Each value keeps the place and the file that it
  /// came from. Throws FileError where one of the two is no mapping.
  Entry with_base(const Entry& base) const;

  /// Returns the value of a key of a mapping; throws FileError if it is missing.
  Entry at(std::string_view key) const;
  std::optional<Entry> find(std::string_view key) const;
  /// Returns the items of a sequence.
  std::vector<Entry> items() const;
  /// Returns the fields of a mapping, in the order of the file; those of its base come last.
  std::vector<std::pair<std::string, Entry>> fields() const;
  /// Reads the items of a sequence one by one.
  void each(const std::function<void(const Entry&)>& read) const;
  /// Reads the fields of a mapping one by one.
  void each_field(const std::function<void(const std::string& key, const Entry& value)>& read) const;
  /// Reads a part without which reading can go on.
  void attempt(const std::function<void()>& read) const;
  bool is_mapping() const;
  bool is_sequence() const;

  std::string text() const;
  double number() const;  ///< is finite
  std::int64_t integer() const;
  bool truth() const;
  std::vector<std::string> texts() const;

  std::string text_or(std::string_view key, std::string fallback) const;
  double number_or(std::string_view key, double fallback) const;
  bool truth_or(std::string_view key, bool fallback) const;

  /// Rejects keys outside `known`, so that a misspelt key is an error and not a silent default.
  void allow_only(std::initializer_list<std::string_view> known) const;

  [[noreturn]] void fail(const std::string& what) const;
  /// Fails, or where findings are collected notes it and returns: for faults after which reading goes on.
  void complain(const std::string& what) const;
  std::string place() const;  ///< "file:line:column"
  const std::filesystem::path& file() const;
  /// Resolves a name relative to the file's folder.
  std::filesystem::path resolve(const std::string& relative) const;

 private:
  struct Document {
    std::filesystem::path file;
    Findings* findings = nullptr;  ///< null: the first fault is thrown
  };

  Entry(std::shared_ptr<const Document> document, const YAML::Node& node);
  const YAML::Node& node() const { return *node_; }

  std::shared_ptr<const Document> document_;
  std::shared_ptr<const YAML::Node> node_;
  std::shared_ptr<const Entry> base_;  ///< null: the mapping is whole
};

}  // namespace roci::mission
