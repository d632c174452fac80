// The owner's side of commands, as docs/protocol-commands.md has it: each key is taken once,
// and says how it ended for good.
#ifndef BOREHOLE_COMMANDS_H
#define BOREHOLE_COMMANDS_H

#include <stdbool.h>

#include "command.h"
#include "participant.h"

struct Command;  // one that was taken

// What the owner does: begins a new command, or breaks one off and says `why` (a stage and its words) about it.
struct Driver {
  void (*carry_out)(struct Command*, const roci_v1_Command*);
  void (*break_off)(struct Command*, roci_v1_CommandStage, const char* code, const char* reason);
};

// `acks` is the topic roci/command/ack.
void serve_commands(const struct Driver*, struct Output* acks);
void receive_command(const void* command);

// A word on a command, with its energy if it is the last one and that was measured (else NaN).
void say(struct Command*, roci_v1_CommandStage, const char* code, const char* reason, double energy_j);
// The owner tries again by itself. False: the step's time is over, and the owner fails it.
bool repair(struct Command*, const char* reason);
// When a repaired command must have ended; -1: none is limited. overrun() breaks it off then.
int64_t next_overrun_us(void);
void overrun(void);

#endif
