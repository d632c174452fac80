#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/terrain/site_generator.hpp"

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  out.close();
  if (!out)
    throw std::runtime_error(file.string() + ": cannot be written; check the folder and its permissions");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Generates a planetary site: map_server YAML with an image of rocks and one of elevation.",
               "roci-site"};
  roci::terrain::SiteRecipe recipe;
  double resolution = 1.0;
  double side = 240.0;
  std::filesystem::path folder;
  app.add_option("--seed", recipe.seed, "the same seed gives the same bytes on every machine")
      ->capture_default_str();
  app.add_option("--side", side, "side of the square site, metres")->capture_default_str();
  app.add_option("--resolution", resolution, "side of a cell, metres")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--rocks", recipe.rock_abundance, "share of the ground that rocks cover, 0 to 0.4")
      ->capture_default_str();
  app.add_option("--craters", recipe.crater_count, "number of scattered craters")->capture_default_str();
  app.add_option("--out", folder, "folder for site.yaml, rocks.pgm and elevation.pgm")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    recipe.resolution = std::llround(resolution * 1000);
    recipe.cells_per_side = static_cast<int>(std::lround(side / resolution));
    const roci::terrain::GeneratedSite site = roci::terrain::generate_site(recipe);
    const std::string comment = "roci-site --seed " + std::to_string(recipe.seed);
    std::filesystem::create_directories(folder);
    write(folder / "site.yaml", site.description);
    write(folder / "rocks.pgm", roci::terrain::to_pgm(site.rocks, comment));
    write(folder / "elevation.pgm", roci::terrain::to_pgm(site.elevation, comment));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "roci-site: %s\n", e.what());
    return 1;
  }
  return 0;
}
