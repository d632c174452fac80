// A service under the clock of a run, live or simulated, as docs/protocol-clock.md has it.
#ifndef BOREHOLE_CLOCK_SERVICE_H
#define BOREHOLE_CLOCK_SERVICE_H

#include <stdint.h>

#include "participant.h"

int64_t now_us(void);  // mission time

// What a service is for its clock: the clocked topics that it reads and writes, and when it wants to act by itself.
struct Service {
  struct Input* inputs;
  int input_count;
  struct Output* outputs;
  int output_count;
  int64_t (*next_us)(void);  // its earliest timer; -1: none
  void (*wake)(void);        // fires the timers that are due
};

// Runs until the clock ends, or *stop is set. Returns the exit code (docs/exit-codes.md, "Services").
int run_service(const struct Service*, volatile int* stop);

#endif
