#include "clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "clock_service.h"
#include "health.h"

// A clocked sample that is held back until a step announces it.
struct Held {
  const struct Input* input;
  void* sample;
  const roci_v1_SampleHeader* header;
};
struct Stream {
  char topic[128], sender[64];
  uint32_t incarnation;
  uint64_t delivered;
};

static const struct Service* service;
static struct Output ready, done, heartbeat;
static struct Input steps;
static roci_v1_ClockStep* step;  // the newest of this run
static roci_v1_ClockDone answered;
static struct Held held[4096];
static int held_count;
static struct Stream streams[512];
static int stream_count;
static bool admitted, joined, has_answered, has_asked, master_gone;
static int64_t simulated_us;

static double wall_s(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + (double)time.tv_nsec / 1e9;
}

int64_t now_us(void) {
  if (options.simulated) return simulated_us;
  struct timespec time;
  clock_gettime(CLOCK_REALTIME, &time);
  return (int64_t)(((double)time.tv_sec - options.epoch_s + (double)time.tv_nsec / 1e9) * options.scale *
                   1e6);
}

// A sign of life for everybody, and one for the launcher, from the loop itself.
static void beat(roci_v1_ServiceState state) {
  static roci_v1_Heartbeat beat;
  static double next;
  static char host[256];
  ++beat.progress;
  if (state == roci_v1_SERVICE_RUNNING && wall_s() < next) return;
  next = wall_s() + 0.25;
  gethostname(host, sizeof host - 1);
  beat.run = (char*)options.run;
  beat.service = (char*)options.name;
  beat.mission = (char*)options.mission;
  beat.robot = (char*)options.robot;
  beat.incarnation = options.incarnation;
  beat.state = state;
  beat.dds = "cyclonedds";
  beat.host = host;
  beat.process_id = getpid();
  dds_write(heartbeat.writer, &beat);

  const char* address = getenv("NOTIFY_SOCKET");
  struct sockaddr_un name = {.sun_family = AF_UNIX};
  if (address == NULL || strlen(address) >= sizeof name.sun_path) return;
  memcpy(name.sun_path, address, strlen(address));
  if (address[0] == '@') name.sun_path[0] = '\0';
  const int notify = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const char alive[] = "READY=1\nWATCHDOG=1";
  sendto(notify, alive, strlen(alive), MSG_NOSIGNAL, (struct sockaddr*)&name,
         (socklen_t)(offsetof(struct sockaddr_un, sun_path) + strlen(address)));
  close(notify);
}

static bool listed(const char* name, uint32_t incarnation) {
  for (uint32_t i = 0; i < step->roster._length; ++i)
    if (strcmp(step->roster._buffer[i].service, name) == 0 &&
        step->roster._buffer[i].incarnation == incarnation)
      return true;
  return false;
}

static bool asks_me(void) {
  if (has_answered && answered.time_us == step->time_us && answered.micro_step == step->micro_step)
    return false;
  for (uint32_t i = 0; i < step->participants._length; ++i)
    if (strcmp(step->participants._buffer[i], options.name) == 0)
      return listed(options.name, options.incarnation);
  return false;
}

static bool newer(const roci_v1_ClockStep* a, const roci_v1_ClockStep* b) {
  if (a->time_us != b->time_us) return a->time_us > b->time_us;
  if (a->micro_step != b->micro_step) return a->micro_step > b->micro_step;
  return a->revision > b->revision;
}

static void take_steps(void) {
  dds_sample_info_t info;
  for (roci_v1_ClockStep* next; (next = take_sample(&steps, &info)) != NULL;) {
    const bool own_run = strcmp(next->run, options.run) == 0;
    if (own_run && step != NULL && info.instance_state != DDS_IST_ALIVE) master_gone = true;
    if (own_run && info.valid_data && (step == NULL || newer(next, step))) {
      if (step != NULL) free_sample(&steps, step);
      step = next;
    } else {
      free_sample(&steps, next);
    }
  }
}

// The streams of a topic: "roci/command" of senders without a robot, "roci/command@miner" of our robot's.
static bool is_stream(const char* stream, const char* topic, const char* robot) {
  const size_t length = strlen(topic);
  if (strncmp(stream, topic, length) != 0) return false;
  return robot[0] == '\0' ? stream[length] == '\0'
                          : stream[length] == '@' && strcmp(stream + length + 1, robot) == 0;
}

static bool hears(const roci_v1_StreamCount* count) {
  for (int i = 0; i < service->input_count; ++i)
    if (is_stream(count->topic, service->inputs[i].topic, "") ||
        is_stream(count->topic, service->inputs[i].topic, options.robot))
      return true;
  return false;
}

static uint64_t* delivered(const roci_v1_StreamCount* count) {
  for (int i = 0; i < stream_count; ++i)
    if (strcmp(streams[i].topic, count->topic) == 0 && strcmp(streams[i].sender, count->sender) == 0 &&
        streams[i].incarnation == count->incarnation)
      return &streams[i].delivered;
  if (stream_count == sizeof streams / sizeof *streams) fail("more streams than it can count");
  struct Stream* stream = &streams[stream_count++];
  snprintf(stream->topic, sizeof stream->topic, "%s", count->topic);
  snprintf(stream->sender, sizeof stream->sender, "%s", count->sender);
  stream->incarnation = count->incarnation;
  return &stream->delivered;
}

static bool announced(const struct Held* one, const roci_v1_StreamCount* count) {
  return one->header->incarnation == count->incarnation && one->header->seq <= count->total &&
         strcmp(one->header->sender, count->sender) == 0 &&
         is_stream(count->topic, one->input->topic, one->header->robot);
}

// Everything that the step announces is here. In its first step a service waits for the past of STATE topics alone, and
// gets the newest of each key; a drill reads none.
static bool complete(void) {
  for (uint32_t i = 0; joined && i < step->totals._length; ++i) {
    const roci_v1_StreamCount* count = &step->totals._buffer[i];
    if (!hears(count) || !listed(count->sender, count->incarnation)) continue;
    uint64_t here = *delivered(count);
    for (int h = 0; h < held_count; ++h)
      if (announced(&held[h], count) && held[h].header->seq > *delivered(count)) ++here;
    if (here < count->total) return false;
  }
  return true;
}

// (topic, sender, incarnation, number); what observers said comes last, as it came.
static int in_order(const void* left, const void* right) {
  const struct Held *a = left, *b = right;
  const bool outside_a = a->header->incarnation == 0, outside_b = b->header->incarnation == 0;
  if (outside_a || outside_b) return outside_a - outside_b;
  int order = strcmp(a->input->topic, b->input->topic);
  if (order == 0) order = strcmp(a->header->sender, b->header->sender);
  if (order != 0) return order;
  if (a->header->incarnation != b->header->incarnation)
    return a->header->incarnation < b->header->incarnation ? -1 : 1;
  return a->header->seq < b->header->seq ? -1 : a->header->seq > b->header->seq;
}

static void deliver(void) {
  struct Held due[sizeof held / sizeof *held];
  int due_count = 0, kept = 0;
  for (int h = 0; h < held_count; ++h) {
    bool past = false, now = held[h].header->incarnation == 0;
    for (uint32_t i = 0; i < step->totals._length; ++i)
      if (announced(&held[h], &step->totals._buffer[i])) {
        past = held[h].header->seq <= *delivered(&step->totals._buffer[i]);
        now = true;
      }
    if (past || (now && !joined))
      free_sample(held[h].input, held[h].sample);
    else if (now)
      due[due_count++] = held[h];
    else
      held[kept++] = held[h];
  }
  held_count = kept;
  for (uint32_t i = 0; i < step->totals._length; ++i)
    if (hears(&step->totals._buffer[i])) *delivered(&step->totals._buffer[i]) = step->totals._buffer[i].total;
  joined = true;
  qsort(due, (size_t)due_count, sizeof *due, in_order);
  for (int i = 0; i < due_count; ++i) {
    due[i].input->handle(due[i].sample);
    free_sample(due[i].input, due[i].sample);
  }
}

static void answer(void) {
  static roci_v1_StreamCount sent[16];
  static char topics[16][160];
  answered.run = (char*)options.run;
  answered.service = (char*)options.name;
  answered.incarnation = options.incarnation;
  answered.time_us = step->time_us;
  answered.micro_step = step->micro_step;
  uint32_t grown = 0;
  for (int i = 0; i < service->output_count; ++i) {
    struct Output* output = &service->outputs[i];
    if (output->total == output->reported) continue;
    output->reported = output->total;
    snprintf(topics[grown], sizeof topics[grown], "%s@%s", output->topic, options.robot);
    sent[grown] =
        (roci_v1_StreamCount){topics[grown], (char*)options.name, options.incarnation, output->total};
    ++grown;
  }
  answered.sent._length = answered.sent._maximum = grown;
  answered.sent._buffer = sent;
  const int64_t next = service->next_us();
  answered.wish_us = next < 0 ? -1 : next < step->time_us ? step->time_us : next;
  dds_write(done.writer, &answered);
  has_answered = true;
  has_asked = false;
}

static void follow(void) {
  if (step == NULL) return;
  const bool is_listed = listed(options.name, options.incarnation);
  if (admitted && !is_listed) fail("the clock's master dropped it from the run");
  admitted = is_listed;
  if (asks_me()) {
    if (!step->last) {
      if (!complete()) return;
      simulated_us = step->time_us;
      deliver();
      service->wake();
    }
    answer();
  } else if (has_answered && !has_asked && held_count > 0 && held[held_count - 1].header->incarnation == 0) {
    has_asked = true;  // an observer said something: ask for a step to act on it
    answered.sent._length = 0;
    answered.wish_us = simulated_us;
    dds_write(done.writer, &answered);
  }
}

static void say_ready(void) {
  static char names[16][160];
  static char* subscriptions[16];
  static double next;
  if (admitted || wall_s() < next) return;
  next = wall_s() + 1;
  uint32_t count = 0;
  for (int i = 0; i < service->input_count; ++i)
    for (int own = 0; own < 2; ++own, ++count) {
      snprintf(names[count], sizeof names[count], own ? "%s@%s" : "%s", service->inputs[i].topic,
               options.robot);
      subscriptions[count] = names[count];
    }
  const roci_v1_ClockReady says = {
      (char*)options.run, (char*)options.name, options.incarnation, {count, count, subscriptions, false}};
  dds_write(ready.writer, &says);
}

// Simulated: holds back. Live: handles at once.
static void take_inputs(void) {
  dds_sample_info_t info;
  for (int i = 0; i < service->input_count; ++i) {
    const struct Input* input = &service->inputs[i];
    for (void* sample; (sample = take_sample(input, &info)) != NULL;) {
      const roci_v1_SampleHeader* header = (const void*)((const char*)sample + input->header);
      const bool obeyed = info.valid_data && strcmp(header->run, options.run) == 0;
      if (obeyed && options.simulated) {
        if (held_count == sizeof held / sizeof *held) fail("more samples than it can hold back");
        held[held_count++] = (struct Held){input, sample, header};
        continue;
      }
      if (obeyed) input->handle(sample);
      free_sample(input, sample);
    }
  }
}

int run_service(const struct Service* its, volatile int* stop) {
  service = its;
  heartbeat = open_output(&roci_v1_Heartbeat_desc, "roci/heartbeat", STATE, false);
  const dds_entity_t waits = dds_create_waitset(DDS_CYCLONEDDS_HANDLE);
  for (int i = 0; i < service->input_count; ++i) {
    dds_set_status_mask(service->inputs[i].reader, DDS_DATA_AVAILABLE_STATUS);
    dds_waitset_attach(waits, service->inputs[i].reader, 0);
  }
  if (options.simulated) {
    ready = open_output(&roci_v1_ClockReady_desc, "roci/clock/ready", STATE, false);
    done = open_output(&roci_v1_ClockDone_desc, "roci/clock/done", STATE, false);
    steps = open_input(&roci_v1_ClockStep_desc, "roci/clock/step", STATE, 0, NULL);
    dds_set_status_mask(steps.reader, DDS_DATA_AVAILABLE_STATUS);
    dds_waitset_attach(waits, steps.reader, 0);
  }
  while (!*stop) {
    dds_waitset_wait(waits, NULL, 0, DDS_MSECS(options.simulated ? 100 : 10));
    take_inputs();
    beat(roci_v1_SERVICE_RUNNING);
    if (options.simulated) {
      take_steps();
      say_ready();
      follow();
      if (step != NULL && step->last) break;
      if (master_gone) return 4;
    } else if (service->next_us() >= 0 && service->next_us() <= now_us()) {
      service->wake();
    }
  }
  beat(roci_v1_SERVICE_STOPPING);
  return 0;
}
