// The participant of a service and its endpoints: settings, QoS and partitions of docs/dds.md.
#ifndef BOREHOLE_PARTICIPANT_H
#define BOREHOLE_PARTICIPANT_H

#include <dds/dds.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "basic.h"

// What the launcher says on the command line (docs/protocol-clock.md, "The command line").
struct Options {
  const char *name, *run, *mission, *robot;
  uint32_t domain, incarnation;
  bool simulated;
  double scale, epoch_s;  // live: mission seconds per second; mission time 0 in seconds since 1970
};
extern struct Options options;

enum Durability { STATE, REQUEST };  // the two QoS of the table that a drill uses

// A topic that we write. Clocked samples are numbered.
struct Output {
  dds_entity_t writer;
  const char* topic;
  uint64_t total, reported;
};

// A topic that we read. A clocked one is handled in the order of the clock; `header` is where its SampleHeader stands.
struct Input {
  dds_entity_t reader;
  const dds_topic_descriptor_t* type;
  const char* topic;
  size_t header;
  void (*handle)(const void* sample);
};

void open_participant(void);
// Wall topics belong to everyone and have no partition; clocked ones are inner topics of the robot.
struct Output open_output(const dds_topic_descriptor_t*, const char* topic, enum Durability, bool clocked);
struct Input open_input(const dds_topic_descriptor_t*, const char* topic, enum Durability, size_t header,
                        void (*handle)(const void*));

// Numbers and writes a clocked sample, whose header is a member of it.
void write_clocked(struct Output*, const void* sample, roci_v1_SampleHeader* header);

// Takes one sample into memory of its own; NULL: there is none. free_sample() gives it back.
void* take_sample(const struct Input*, dds_sample_info_t*);
void free_sample(const struct Input*, void* sample);

_Noreturn void fail(const char* what);

#endif
