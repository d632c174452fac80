#include "ground_console/cli/watch/watch.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"
#include "ground_console/cli/watch/screen.hpp"

namespace roci::console::cli::watch {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// The alternate screen, left again however the view ends.
class Screen {
 public:
  Screen() { std::cout << "\x1b[?1049h\x1b[?25l" << std::flush; }
  ~Screen() { std::cout << "\x1b[?25h\x1b[?1049l" << std::flush; }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  static std::pair<std::size_t, std::size_t> size() {
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return {100, 40};
    return {window.ws_col, window.ws_row};
  }

  // Colours as https://no-color.org asks.
  static std::string text_of(const Canvas& canvas) {
    const char* no_colour = std::getenv("NO_COLOR");
    const bool plain = isatty(STDOUT_FILENO) == 0 || (no_colour != nullptr && *no_colour != '\0');
    return plain ? canvas.plain() : canvas.coloured();
  }

  static void draw(const std::string& text) {
    std::string out = "\x1b[H";
    for (char c : text) {
      if (c == '\n') {
        out += "\x1b[K\r\n";
      } else {
        out += c;
      }
    }
    std::cout << out << "\x1b[J" << std::flush;
  }
};

int watch_as_json(lib::Client& client) {
  while (!client.view().ended() && interrupted == 0) {
    client.wait([&] { return client.view().ended() || interrupted != 0; }, std::chrono::seconds(1));
    std::cout << json_text(status_json(client.view())) << std::endl;
  }
  return kDone;
}

}  // namespace

int watch(lib::Client& client, bool json) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  if (json) return watch_as_json(client);
  const auto draw = [&] {
    const auto [width, height] = Screen::size();
    return Screen::text_of(watch_screen(client.view(), width, height - 1));
  };
  std::string last;
  {
    Screen screen;
    while (!client.view().ended() && interrupted == 0) {
      client.wait([&] { return interrupted != 0 || client.view().ended(); }, std::chrono::milliseconds(250));
      last = draw();
      Screen::draw(last);
    }
  }
  std::cout << last;  // the last picture stays
  return kDone;
}

}  // namespace roci::console::cli::watch
