#include "drill.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "function.h"

static const double kSetUpS = 60, kPerMetreS = 400, kDeepestM = 5, kHardBelowM = 1, kAgainS = 30;

enum { ACKS, OBSERVATIONS, OFFERS, REPLIES, OUTPUTS };
static struct Output outputs[OUTPUTS];
static struct Input inputs[2];
static struct Command* running;
static char place[64];
static bool hard, reported_first;
static int64_t due_us;

static double bore_s(double depth_m) { return kSetUpS + kPerMetreS * depth_m; }

static void report(const char* timeline, const char* state) {
  char name[256];
  snprintf(name, sizeof name, "%s.%s", options.robot, timeline);
  roci_v1_Observation seen = {.timeline = name, .sampled_us = now_us()};
  seen.observed.kind = roci_v1_VALUE_STATE;
  seen.observed.state = (char*)state;
  write_clocked(&outputs[OBSERVATIONS], &seen, &seen.header);
}

static void rest(roci_v1_CommandStage stage, const char* code, const char* reason, double energy_j) {
  struct Command* ended = running;
  running = NULL;
  due_us = -1;
  report("drill", "idle");
  say(ended, stage, code, reason, energy_j);
}

static void break_off(struct Command* one, roci_v1_CommandStage stage, const char* code, const char* reason) {
  if (one == running) rest(stage, code, reason, NAN);
}

static const char* argument(const roci_v1_Command* request, const char* name) {
  for (uint32_t i = 0; i < request->arguments._length; ++i)
    if (strcmp(request->arguments._buffer[i].name, name) == 0) return request->arguments._buffer[i].value;
  return "";
}

static void carry_out(struct Command* command, const roci_v1_Command* request) {
  if (strcmp(request->command_name, "bore") != 0) {
    say(command, roci_v1_STAGE_REJECTED, "unknown-command", "it can only bore", NAN);
    return;
  }
  if (running != NULL) {
    say(command, roci_v1_STAGE_REJECTED, "busy", "it still bores", NAN);
    return;
  }
  const double depth_m = atof(argument(request, "depth"));
  running = command;
  snprintf(place, sizeof place, "%s", argument(request, "place"));
  hard = depth_m > kHardBelowM;
  say(command, roci_v1_STAGE_ACCEPTED, "", "", NAN);
  report("drill", "boring");
  due_us = now_us() + (int64_t)(bore_s(depth_m) * 1e6);
}

static void bored(void) {
  if (hard) {
    hard = false;
    if (repair(running, "the bit jammed; it tries again"))
      due_us = now_us() + (int64_t)(kAgainS * 1e6);
    else
      rest(roci_v1_STAGE_FAILED, "jammed", "the rock is hard, and no time is left", NAN);
    return;
  }
  char timeline[128];
  snprintf(timeline, sizeof timeline, "drill.hole.%s", place);
  report(timeline, "bored");
  rest(roci_v1_STAGE_COMPLETED, "done", "", 1200);
}

static int64_t next_us(void) {
  if (!reported_first) return 0;
  const int64_t end = next_overrun_us();
  return due_us < 0 || (end >= 0 && end < due_us) ? end : due_us;
}

static void wake(void) {
  if (!reported_first) {
    reported_first = true;
    report("drill", "idle");
  }
  if (running != NULL && due_us >= 0 && due_us <= now_us()) bored();
  overrun();
}

// The function: one outcome for each place of each batch.
static void answer_call(const void* sample) {
  const roci_v1_FunctionRequest* request = sample;
  const char* asked = request->request.instance_name;
  if (strcmp(request->module_name, "drill") != 0 || (asked[0] != '\0' && strcmp(asked, options.name) != 0))
    return;
  const uint32_t batches = request->batches._length;
  roci_v1_FunctionValues* values = calloc(batches + 1, sizeof *values);
  for (uint32_t b = 0; b < batches; ++b) {
    const roci_v1_FunctionBatch* batch = &request->batches._buffer[b];
    const uint32_t arity = batch->arity == 0 ? 1 : batch->arity,
                   count = (batch->tuples._length + arity - 1) / arity;
    values[b].function = batch->function;
    values[b].numbers._buffer = calloc(count + 1, sizeof(double));
    values[b].outcomes._buffer = calloc(count + 1, sizeof(roci_v1_FunctionOutcome));
    values[b].numbers._length = values[b].outcomes._length = count;
    for (uint32_t t = 0; t < count; ++t) {
      roci_v1_FunctionOutcome* outcome = &values[b].outcomes._buffer[t];
      const uint32_t object = batch->tuples._buffer[t * arity];
      *outcome = strcmp(batch->function, "bore_time") != 0 ? roci_v1_FUNCTION_UNKNOWN_FUNCTION
                 : arity != 1                              ? roci_v1_FUNCTION_WRONG_ARITY
                                                           : roci_v1_FUNCTION_UNKNOWN_OBJECT;
      if (*outcome != roci_v1_FUNCTION_UNKNOWN_OBJECT || object >= request->objects._length) continue;
      const roci_v1_PlanObject* described = &request->objects._buffer[object];
      for (uint32_t p = 0; p < described->properties._length; ++p) {
        if (strcmp(described->properties._buffer[p].name, "depth") != 0) continue;
        const double depth_m = atof(described->properties._buffer[p].value);
        *outcome = depth_m > kDeepestM ? roci_v1_FUNCTION_UNREACHABLE : roci_v1_FUNCTION_VALUE;
        values[b].numbers._buffer[t] = depth_m > kDeepestM ? 0 : bore_s(depth_m);
      }
    }
  }
  roci_v1_FunctionReply reply = {.owner = (char*)options.name, .model_version = 1, .computed_us = now_us()};
  reply.reply.related_request_id = request->request.request_id;
  reply.reply.remote_ex = roci_v1_REMOTE_EX_OK;
  reply.reply.remote_message = "";
  reply.results._length = batches;
  reply.results._buffer = values;
  write_clocked(&outputs[REPLIES], &reply, &reply.header);
  for (uint32_t b = 0; b < batches; ++b) {
    free(values[b].numbers._buffer);
    free(values[b].outcomes._buffer);
  }
  free(values);
}

static void offer(void) {
  char* types[] = {"place"};
  roci_v1_FunctionSignature bore_time = {
      .name = "bore_time", .parameter_types = {1, 1, types, false}, .unit = "s"};
  roci_v1_FunctionOffer says = {.module_name = "drill", .owner = (char*)options.name, .model_version = 1};
  says.functions._length = 1;
  says.functions._buffer = &bore_time;
  write_clocked(&outputs[OFFERS], &says, &says.header);
}

struct Service open_drill(void) {
  static const struct Driver driver = {carry_out, break_off};
  outputs[ACKS] = open_output(&roci_v1_CommandAck_desc, "roci/command/ack", STATE, true);
  outputs[OBSERVATIONS] = open_output(&roci_v1_Observation_desc, "roci/observation", STATE, true);
  outputs[OFFERS] = open_output(&roci_v1_FunctionOffer_desc, "roci/function/offer", STATE, true);
  outputs[REPLIES] = open_output(&roci_v1_FunctionReply_desc, "roci/function/reply", REQUEST, true);
  inputs[0] = open_input(&roci_v1_Command_desc, "roci/command", REQUEST, offsetof(roci_v1_Command, header),
                         receive_command);
  inputs[1] = open_input(&roci_v1_FunctionRequest_desc, "roci/function/request", REQUEST,
                         offsetof(roci_v1_FunctionRequest, header), answer_call);
  due_us = -1;
  serve_commands(&driver, &outputs[ACKS]);
  offer();
  return (struct Service){inputs, 2, outputs, OUTPUTS, next_us, wake};
}
