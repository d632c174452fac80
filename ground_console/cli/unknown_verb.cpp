#include "ground_console/cli/unknown_verb.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/words/nearest_word.hpp"
#include "ground_console/cli/report.hpp"

namespace roci::console::cli {

std::string words_on_verb(const CLI::App& app, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& with_value) {
  const CLI::App* at = &app;
  std::string before = "roci";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word.starts_with('-')) {
      if (std::ranges::count(with_value, word) > 0) ++i;
      continue;
    }
    std::vector<std::string> verbs;
    for (const CLI::App* verb : at->get_subcommands([](const CLI::App*) { return true; }))
      verbs.push_back(verb->get_name());
    if (verbs.empty()) return "";  // an argument
    if (std::ranges::count(verbs, word) == 0)
      return "'" + printable(word) + "' is no verb of " + before + words::did_you_mean(word, verbs) + "; " +
             before + " --help lists them";
    at = at->get_subcommand(word);
    before += " " + word;
  }
  return "";
}

}  // namespace roci::console::cli
