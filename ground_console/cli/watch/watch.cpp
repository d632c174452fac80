#include "ground_console/cli/watch/watch.hpp"

#include <sys/ioctl.h>
#include <termios.h>
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

// Single keys without Enter, where there is a keyboard.
class Keys {
 public:
  Keys() : terminal_(isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!terminal_) return;
    termios keys = before_;
    keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C still interrupts
    keys.c_cc[VMIN] = 0;
    keys.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &keys);
  }
  ~Keys() {
    if (terminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool quit() {
    char key = 0;
    while (terminal_ && read(STDIN_FILENO, &key, 1) == 1)
      if (key == 'q' || key == 'Q') quit_ = true;
    return quit_;
  }

 private:
  termios before_{};
  bool terminal_;
  bool quit_ = false;
};

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
  while (!client.over() && interrupted == 0) {
    client.wait([&] { return client.over() || interrupted != 0; }, std::chrono::seconds(1));
    std::cout << json_text(status_json(client.view())) << std::endl;
  }
  return kDone;
}

}  // namespace

int watch(lib::Client& client, const MissionWords& words, bool closing_matters, bool json) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  if (json) return watch_as_json(client);
  const auto draw = [&] {
    const auto [width, height] = Screen::size();
    return Screen::text_of(watch_screen(client.view(), width, height - 1, words));
  };
  std::string last;
  {
    Screen screen;
    Keys keys;
    const auto over = [&] { return interrupted != 0 || client.over() || keys.quit(); };
    while (!over()) {
      client.wait(over, std::chrono::milliseconds(250));
      last = draw();
      Screen::draw(last);
    }
  }
  std::cout << last;  // the last picture stays
  return client.over() || !closing_matters ? kDone : kStillOpen;
}

}  // namespace roci::console::cli::watch
