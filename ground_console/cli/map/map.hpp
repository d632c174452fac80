// This is the verb `roci map`: a picture of the ground of a mission, with what is planned and driven on it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ground_console/lib/client.hpp"

namespace roci::console::cli::map {

/// Holds the arguments of `roci map`.
struct MapArguments {
  std::string png;      ///< the file to write; empty: none
  std::string svg;      ///< the same, with timelines and what each robot knows; empty: none
  std::string mission;  ///< folder or name; empty: that of the run
  std::string run;      ///< folder of a run, or its printed trace; empty: the one that flies
};

/// Writes the picture, or both, and says so. With a mission alone it draws the mission, without a run; with neither it
/// joins the one that flies on this machine, and where `connection` says which one, that one. Returns an exit code.
int show_map(const MapArguments& arguments, const services::process::ConnectionFlags& connection, bool json);

}  // namespace roci::console::cli::map
