// This file answers a word that is no verb of roci with the verb that may have been meant.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace roci::console::cli {

/// What is said of a command line whose verb the program does not know: the word and the nearest verb. Empty if every
/// word that should be a verb is one. `with_value`: options of the program that take a value, which is no verb.
std::string words_on_verb(const CLI::App& app, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& with_value);

}  // namespace roci::console::cli
