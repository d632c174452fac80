#include "bench/europa/cycles/sized_network.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::bench::europa {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return out.str();
}

// Replaces what stands between two texts, both included; everywhere where it is found, at least once.
void replace(std::string& text, const std::string& from, const std::string& to, const std::string& by) {
  std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the mission's text has no '" + from + "' any more");
  for (; at != std::string::npos; at = text.find(from, at + by.size())) {
    const std::size_t end = text.find(to, at + from.size());
    if (end == std::string::npos) throw std::runtime_error("'" + from + "' is not followed by '" + to + "'");
    text.replace(at, end + to.size() - at, by);
  }
}

void replace(std::string& text, const std::string& from, const std::string& by) {
  replace(text, from, "", by);
}

std::string numbers(std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + std::to_string(i);
  return "[" + out + "]";
}

// Estimates within [0, 1] that all differ a little, as those of the mission do.
std::string estimate(std::size_t number) {
  return std::to_string(0.4 + 0.5 * static_cast<double>(number * 37 % 101) / 101);
}

std::string site_values(std::size_t sites) {
  std::string out = "for:\n";
  for (std::size_t site = 0; site < sites; ++site)
    out += "      - {site: " + std::to_string(site) + ", value: " + estimate(site) + "}\n";
  return out + "    value: \"{value}\"\n    range";
}

std::string visual_values(std::size_t sites, std::size_t targets) {
  std::string out = "visual_{site}_{target}:\n    for:\n";
  for (std::size_t site = 0; site < sites; ++site)
    for (std::size_t target = 0; target < targets; ++target)
      out += "      - {site: " + std::to_string(site) + ", target: " + std::to_string(target) +
             ", value: " + estimate(site * targets + target + 7) + "}\n";
  return out + "    value: \"{value}\"\n    range";
}

// As the mission has them: four in each view of Earth, twelve hours apart.
std::string uplinks(std::size_t views) {
  std::string out = "for:\n";
  for (std::size_t view = 0; view < views; ++view)
    for (std::size_t i = 0; i < 4; ++i)
      out += "      - {n: " + std::to_string(4 * view + i + 1) +
             ", hour: " + std::to_string(84 * view + 12 * i + 2) + "}\n";
  return out + "    name: Uplink\n    batch: exogenous";
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

// A folder that goes with its owner.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "europa-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

planner::utility_htn::model::Network sized_network(const fs::path& mission, std::size_t sites,
                                                   std::size_t targets) {
  using planner::utility_htn::reading::load_network;
  if (sites == 3 && targets == 3) return load_network(mission / "network-rsm1.yaml");
  std::string network = read(mission / "rsm1.yaml"), model = read(mission / "model.yaml"),
              earth = read(mission / "earth.yaml"), lander = read(mission / "lander.yaml");
  const std::string share = std::to_string(static_cast<double>(sites) / 3);
  const std::size_t views = 7 * sites / 3;
  const std::string last = "to: " + std::to_string(views - 1) + "}";
  replace(network, "sets: {", "}",
          "sets: {sites: " + numbers(sites) + ", targets: " + numbers(targets) + "}");
  replace(network, "for: [{site: 0, value:", "range", site_values(sites));
  replace(network, "visual_{site}_{target}:", "range", visual_values(sites, targets));
  replace(network, "for:\n      - {n: 1, hour: 2}", "batch: exogenous", uplinks(views - 1));
  replace(network, "to: 6}", last);
  replace(earth, "to: 6}", last);
  replace(model, "50 * 3600000", "50 * 3600000 * " + share);
  replace(model, "22 * 86400", "22 * 86400 * " + share);
  replace(model, "range: [86400, 6000000]", "range: [86400, 60000000]");
  const Folder folder;
  write(folder.path() / "rsm1.yaml", network);
  write(folder.path() / "network-rsm1.yaml", read(mission / "network-rsm1.yaml"));
  write(folder.path() / "model.yaml", model);
  write(folder.path() / "earth.yaml", earth);
  write(folder.path() / "lander.yaml", lander);
  write(folder.path() / "targets.yaml", read(mission / "targets.yaml"));
  return load_network(folder.path() / "network-rsm1.yaml");
}

}  // namespace roci::bench::europa
