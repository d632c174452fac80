#include "planner_svc/utility_htn/cli/words.hpp"

#include <algorithm>
#include <cstdio>

namespace roci::planner::utility_htn::cli {

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string in_ranks(const temporal::RankVector& utility, const model::Network& network) {
  std::string out;
  for (std::size_t rank = 0; rank < utility.scores().size(); ++rank)
    if (utility[rank] != 0)
      out += (out.empty() ? "" : ", ") + network.ranks.at(rank) + " " + number(utility[rank]);
  return out.empty() ? "0" : out;
}

}  // namespace roci::planner::utility_htn::cli
