#include "pathplan_svc/map_file.hpp"

#include "core/words/nearest_word.hpp"

namespace roci::pathplan {

MapSettings read_map_settings(const mission::Entry& section) {
  section.allow_only({"tell", "subsystem"});
  MapSettings out;
  const mission::Entry tell = section.at("tell");
  const std::string word = tell.text();
  if (word == "at_once") {
    out.sharing = MapSharing::at_once;
  } else if (word == "on_request") {
    out.sharing = MapSharing::on_request;
  } else {
    tell.fail("a map is told at_once or on_request, not '" + word + "'" +
              words::did_you_mean(word, {"at_once", "on_request"}));
  }
  out.subsystem = section.text_or("subsystem", out.subsystem);
  if (out.subsystem.empty())
    section.at("subsystem").fail("a subsystem has a name; give one, or drop the key");
  return out;
}

}  // namespace roci::pathplan
