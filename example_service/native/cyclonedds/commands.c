#include "commands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clock_service.h"

enum { kCommanders = 64, kKept = 1000, kEpochJump = 1000 };

struct Command {
  char commander[64], activity[128], robot[64], subsystem[64];
  uint64_t epoch;
  uint32_t attempt;
  int64_t accepted_us, latest_end_us;
  bool repaired, cancelling;
  roci_v1_CommandStage stage;
  char code[64], reason[256];
  roci_v1_CommandResult outcome;
};
struct Commander {
  char name[64];
  uint64_t epoch, seq;
  uint32_t incarnation;
};

static const struct Driver* driver;
static struct Output* acks;
static struct Command commands[kKept];
static int command_count;
static struct Commander commanders[kCommanders];
static int commander_count;

static bool is_open(const struct Command* one) { return one->stage == roci_v1_STAGE_ACCEPTED; }

static struct Commander* commander_of(const char* name) {
  for (int i = 0; i < commander_count; ++i)
    if (strcmp(commanders[i].name, name) == 0) return &commanders[i];
  return NULL;
}

static uint64_t newest_epoch(const char* commander) {
  const struct Commander* known = commander_of(commander);
  return known == NULL ? 0 : known->epoch;
}

static struct Command* find(const roci_v1_Command* key) {
  for (int i = 0; i < command_count; ++i)
    if (strcmp(commands[i].commander, key->commander) == 0 && commands[i].epoch == key->epoch &&
        strcmp(commands[i].activity, key->activity) == 0 && commands[i].attempt == key->attempt)
      return &commands[i];
  return NULL;
}

static void acknowledge(const roci_v1_Command* key, roci_v1_CommandStage stage, const char* code,
                        const char* reason, const roci_v1_CommandResult* outcome, uint64_t newest,
                        bool refused_epoch) {
  roci_v1_CommandAck ack = {
      .commander = key->commander, .epoch = key->epoch, .activity = key->activity, .attempt = key->attempt};
  ack.stage = stage;
  ack.owner = (char*)options.name;
  ack.code = (char*)code;
  ack.reason = (char*)reason;
  ack.outcome.duration_us = -1;
  ack.outcome.energy_j = NAN;
  if (outcome != NULL) ack.outcome = *outcome;
  ack.newest_epoch = newest;
  ack.refused_epoch = refused_epoch;
  write_clocked(acks, &ack, &ack.header);
}

static void tell(const struct Command* one) {
  const roci_v1_Command key = {.commander = (char*)one->commander,
                               .epoch = one->epoch,
                               .activity = (char*)one->activity,
                               .attempt = one->attempt};
  acknowledge(&key, one->stage, one->code, one->reason, &one->outcome, newest_epoch(one->commander), false);
}

void say(struct Command* one, roci_v1_CommandStage stage, const char* code, const char* reason,
         double energy_j) {
  if (!is_open(one)) return;  // the last status stays
  if (one->accepted_us < 0) one->accepted_us = now_us();
  one->stage = stage;
  snprintf(one->code, sizeof one->code, "%s", code);
  snprintf(one->reason, sizeof one->reason, "%s", reason);
  const bool ran = stage != roci_v1_STAGE_ACCEPTED && stage != roci_v1_STAGE_REJECTED;
  one->outcome.duration_us = ran ? now_us() - one->accepted_us : -1;
  one->outcome.energy_j = energy_j;
  tell(one);
}

bool repair(struct Command* one, const char* reason) {
  if (one->latest_end_us >= 0 && now_us() >= one->latest_end_us) return false;
  one->repaired = true;
  say(one, roci_v1_STAGE_ACCEPTED, "repairing", reason, NAN);
  return true;
}

int64_t next_overrun_us(void) {
  int64_t first = -1;
  for (int i = 0; i < command_count; ++i) {
    const struct Command* one = &commands[i];
    if (is_open(one) && one->repaired && one->latest_end_us >= 0 && (first < 0 || one->latest_end_us < first))
      first = one->latest_end_us;
  }
  return first;
}

void overrun(void) {
  for (int i = 0; i < command_count; ++i)
    if (is_open(&commands[i]) && commands[i].repaired && commands[i].latest_end_us >= 0 &&
        commands[i].latest_end_us <= now_us())
      driver->break_off(&commands[i], roci_v1_STAGE_FAILED, "repair-overrun",
                        "the step's time was over before the repair was");
}

// The epoch of who sends: refused, and told the newest, is one that is over,
// one that another process has begun, one far ahead.
static bool refused(const roci_v1_Command* request) {
  char reason[256] = "";
  const char* code = NULL;
  const struct Commander* known = commander_of(request->header.sender);
  const uint64_t newest = known == NULL ? 0 : known->epoch, epoch = request->sender_epoch;
  if (epoch < newest) {
    code = "old-epoch";
    snprintf(reason, sizeof reason, "epoch %llu is over; the executive in charge has epoch %llu",
             (unsigned long long)epoch, (unsigned long long)newest);
  } else if (epoch - newest > kEpochJump && request->action != roci_v1_COMMAND_QUERY) {
    code = "epoch-jump";
    snprintf(reason, sizeof reason,
             "epoch %llu is more than %d after the newest, %llu; lead in an earlier one first",
             (unsigned long long)epoch, kEpochJump, (unsigned long long)newest);
  } else if (known != NULL && epoch == newest &&
             (request->header.incarnation != known->incarnation || request->header.seq <= known->seq)) {
    code = "doubled-epoch";
    snprintf(reason, sizeof reason, "epoch %llu was begun by another process; take a later one",
             (unsigned long long)epoch);
  }
  if (code != NULL) acknowledge(request, roci_v1_STAGE_REJECTED, code, reason, NULL, newest, true);
  return code != NULL;
}

static void raise_epoch(const roci_v1_Command* request) {
  struct Commander* known = commander_of(request->header.sender);
  if (known == NULL) {
    if (commander_count == kCommanders) fail("more commanders than it can know");
    known = &commanders[commander_count++];
    snprintf(known->name, sizeof known->name, "%s", request->header.sender);
  }
  known->epoch = request->sender_epoch;
  known->incarnation = request->header.incarnation;
  known->seq = request->header.seq;
}

static struct Command* take(const roci_v1_Command* request) {
  if (command_count == kKept)
    fail("more commands than it can remember; services/owner forgets old ones by rule");
  struct Command* one = &commands[command_count++];
  memset(one, 0, sizeof *one);
  snprintf(one->commander, sizeof one->commander, "%s", request->commander);
  snprintf(one->activity, sizeof one->activity, "%s", request->activity);
  snprintf(one->robot, sizeof one->robot, "%s", request->robot);
  snprintf(one->subsystem, sizeof one->subsystem, "%s", request->subsystem);
  one->epoch = request->epoch;
  one->attempt = request->attempt;
  one->accepted_us = -1;
  one->latest_end_us = request->latest_end_us;
  one->stage = roci_v1_STAGE_ACCEPTED;
  one->outcome.duration_us = -1;
  one->outcome.energy_j = NAN;
  return one;
}

static void stop(const roci_v1_Command* request) {
  char reason[256];
  struct Command* own = take(request);
  snprintf(reason, sizeof reason, "stopped by %s", request->activity);
  for (struct Command* one = commands; one != own; ++one)
    if (is_open(one) && strcmp(one->robot, request->robot) == 0 &&
        strcmp(one->subsystem, request->subsystem) == 0)
      driver->break_off(one, roci_v1_STAGE_CANCELLED, "stopped", reason);
  say(own, roci_v1_STAGE_COMPLETED, "done", "", NAN);
}

static void cancel(const roci_v1_Command* request, struct Command* known) {
  if (is_open(known)) {
    if (known->cancelling) return;  // its outcome is still to come
    known->cancelling = true;
    raise_epoch(request);
    driver->break_off(known, roci_v1_STAGE_CANCELLED, "cancelled", "cancelled on request");
    return;
  }
  char reason[128];
  snprintf(reason, sizeof reason, "it has already ended (%s)", known->code);
  acknowledge(request, roci_v1_STAGE_CANCEL_FAILED, "already-ended", reason, NULL,
              newest_epoch(request->commander), false);
}

void receive_command(const void* sample) {
  const roci_v1_Command* request = sample;
  if (strcmp(request->owner, options.name) != 0) return;
  struct Command* known = find(request);
  const bool executes = request->action == roci_v1_COMMAND_EXECUTE;
  const bool stops = executes && strcmp(request->command_name, "stop") == 0;
  if (!stops && refused(request)) return;  // a stop is never refused
  if (known == NULL && !executes) {
    acknowledge(request, roci_v1_STAGE_UNKNOWN, "unknown-key", "this activity was never commanded here", NULL,
                newest_epoch(request->commander), false);
  } else if (request->action == roci_v1_COMMAND_CANCEL) {
    cancel(request, known);
  } else if (known != NULL) {
    tell(known);  // a repeated command, or a query
  } else if (stops) {
    stop(request);
  } else {
    raise_epoch(request);
    struct Command* taken = take(request);
    if (strcmp(request->command_name, "lead") == 0)
      say(taken, roci_v1_STAGE_COMPLETED, "done", "", NAN);
    else
      driver->carry_out(taken, request);
  }
}

void serve_commands(const struct Driver* its, struct Output* its_acks) {
  driver = its;
  acks = its_acks;
}
