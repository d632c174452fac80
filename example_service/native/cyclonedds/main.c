// drill_svc: reads what the launcher says, and runs the drill.
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "drill.h"

struct Options options = {"drill_svc", "", "", "", 0, 1, false, 1, 0};

static volatile int stop;

static void on_signal(int number) {
  (void)number;
  stop = 1;
}

// The name of the mission is that of its folder.
static const char* folder_name(const char* path) {
  const char* slash = strrchr(path, '/');
  return slash == NULL ? path : slash + 1;
}

int main(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    const char *key = argv[i], *value = argv[i + 1];
    if (strcmp(key, "--name") == 0) options.name = value;
    if (strcmp(key, "--run") == 0) options.run = value;
    if (strcmp(key, "--mission") == 0) options.mission = folder_name(value);
    if (strcmp(key, "--robot") == 0) options.robot = value;
    if (strcmp(key, "--domain") == 0) options.domain = (uint32_t)atoi(value);
    if (strcmp(key, "--incarnation") == 0) options.incarnation = (uint32_t)atoi(value);
    if (strcmp(key, "--clock") == 0) options.simulated = strcmp(value, "live") != 0;
    if (strcmp(key, "--scale") == 0) options.scale = atof(value);
    if (strcmp(key, "--epoch") == 0) options.epoch_s = atof(value);
  }
  signal(SIGTERM, on_signal);
  signal(SIGINT, on_signal);
  open_participant();
  const struct Service drill = open_drill();
  return run_service(&drill, &stop);
}
