// What a flight of the Europa lander has really done, from the world's own record in its run folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace roci::scenario {

/// Times are in seconds of mission time.
class Course {
 public:
  struct Deed {
    double at_s = 0;
    std::string kind;
    std::string object;
    std::string activity;
  };
  /// Is data on board and what became of them; a time is -1 where it never was so.
  struct Product {
    std::string id, kind, source, tier;
    double bytes = 0;
    double made_s = -1, sent_s = -1, received_s = -1;
  };

  explicit Course(const std::filesystem::path& run_folder);

  const std::vector<Deed>& deeds() const { return deeds_; }
  const std::vector<Product>& products() const {
    return products_;
  }  ///< in the order in which they were made
  /// Returns "site target" of each sample, in the order of their collection.
  std::vector<std::string> samples() const { return objects("collect"); }
  std::vector<std::string> samples_at(const std::string& site) const;
  /// Returns "site_target" of each sample that was analyzed.
  std::vector<std::string> analyzed() const { return objects("analyze"); }
  std::vector<std::string> sites() const { return objects("excavate"); }
  /// Returns whether some product of that kind is on Earth.
  bool is_home(const std::string& product_kind) const;
  /// Returns the objects of all deeds of that kind.
  std::vector<std::string> objects(const std::string& kind) const;
  /// Returns when the last deed of that kind was; -1: there was none.
  double last(const std::string& kind) const;
  /// Returns how many blocks begin, and how many of them without an uplink since the one before that would have
  /// released the hold.
  std::pair<int, int> blocks_and_those_unreleased() const;

 private:
  void read_products(const std::filesystem::path& file);

  std::vector<Deed> deeds_;
  std::vector<Product> products_;
};

/// Is what was observed of a timeline, as a word.
struct Reading {
  double at_s = 0;
  std::string value;
};
/// Returns what was observed of the timelines whose names begin so, in the flight's own trace.
std::map<std::string, std::vector<Reading>> readings(const std::filesystem::path& run_folder,
                                                     const std::string& prefix);
/// Returns the values of these alone.
std::map<std::string, std::vector<std::string>> observed(const std::filesystem::path& run_folder,
                                                         const std::string& prefix);

/// Returns when the executive took orders of the ground, by its own trace.
std::vector<double> ordered_at(const std::filesystem::path& run_folder);

/// Is a time in which the radio sends without another state between.
struct Session {
  double from_s = 0, to_s = 0;
};
/// Returns all of a flight that have ended, as the radio told of them.
std::vector<Session> sessions(const std::filesystem::path& run_folder);

}  // namespace roci::scenario
