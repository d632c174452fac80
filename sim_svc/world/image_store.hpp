// The image store holds the images of one robot, and remembers which of them it has sent.
#pragma once
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim_svc/world/values.hpp"

namespace roci::sim::world {

/// Holds images by id. What is not sent stays on board with its picture, and while kStored images wait to be sent there
/// is no room for another. Of a sent image the store keeps a record without the picture, so that an executive that has
/// lost its journal observes what was sent and does not ask for it again. The newest kSent records stay; older ones are
/// forgotten, as if those images had never been taken.
class ImageStore {
 public:
  /// Bounds the records of sent images: four images a day for 500 days.
  static constexpr std::size_t kSent = 2'000;
  /// Bounds the images that wait to be sent: many times those of one plan, so that it leaves room to spare when goals
  /// are taken back whose images nobody sends any more.
  static constexpr std::size_t kStored = 200;

  enum class State : std::uint8_t { stored, sent, forgotten, missing };
  struct Change {
    std::string id;
    State state = State::stored;
    bool operator==(const Change&) const = default;
  };

  /// Returns whether an image of that id may be taken now: it may take the place of an earlier one.
  bool has_room_for(const std::string& id) const;
  /// Takes in an image that is not sent, in the place of an earlier one of its id.
  void add(Image);
  /// Returns the image of that id, or null when none is on board or remembered.
  const Image* find(const std::string& id) const;
  /// Notes that the image was sent. Returns it as it was sent, with its picture unless that was sent before, or nothing
  /// when there is none of that id.
  std::optional<Image> set_sent(const std::string& id);
  /// Notes that this image was asked for and is not here, so that whoever believes in it hears so: a robot that was
  /// started anew may have lost what it had told of.
  void note_missing(const std::string& id);
  /// Returns what has changed since the last call, in the order of the ids, with the states as they are now.
  std::vector<Change> take_changes();

  const std::map<std::string, Image>& images() const { return images_; }
  /// Takes in the images of an earlier process; each of them counts as changed.
  void restore(std::map<std::string, Image>);

 private:
  void forget_oldest_sent();

  std::map<std::string, Image> images_;
  std::list<std::string> sent_;    // ids, the oldest first
  std::set<std::string> changed_;  // ids
  std::set<std::string> missing_;  // of these, those that were asked for in vain
};

}  // namespace roci::sim::world
