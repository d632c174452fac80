#include "participant.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clock_service.h"
#include "contract.h"

// Loopback; docs/dds.md says what to change for several hosts.
static const char kSettings[] =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"127.0.0.1\" "
    "multicast=\"false\"/>"
    "</Interfaces><AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize></"
    "General><Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>39</MaxAutoParticipantIndex><Peers>"
    "<Peer "
    "address=\"127.0.0.1\"/></Peers><SPDPInterval>1s</SPDPInterval><LeaseDuration>3s</LeaseDuration></"
    "Discovery>"
    "<Internal><GenerateKeyhash>true</GenerateKeyhash></Internal></Domain></CycloneDDS>";

static dds_entity_t participant;

void fail(const char* what) {
  fprintf(stderr, "%s: %s\n", options.name, what);
  exit(1);
}

static dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) fail(dds_strretcode(entity));
  return entity;
}

void open_participant(void) {
  checked(dds_create_domain(options.domain, kSettings));
  dds_qos_t* qos = dds_create_qos();
  dds_qset_userdata(qos, ROCI_ANNOUNCEMENT, strlen(ROCI_ANNOUNCEMENT));  // the types that we know
  participant = checked(dds_create_participant(options.domain, qos, NULL));
  dds_delete_qos(qos);
}

static dds_qos_t* qos_of(enum Durability durability, bool clocked) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  const bool barriered = clocked && options.simulated;  // the clock loses nothing and overwrites nothing
  dds_qset_durability(
      qos, barriered || durability == STATE ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (barriered)
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 512);
  else if (durability == STATE)
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  else
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  if (clocked) {
    char partition[128];
    snprintf(partition, sizeof partition, "roci.inner.%s", options.robot);
    dds_qset_partition1(qos, partition);
  }
  return qos;
}

struct Output open_output(const dds_topic_descriptor_t* type, const char* topic, enum Durability durability,
                          bool clocked) {
  dds_qos_t* qos = qos_of(durability, clocked);
  const dds_entity_t described = checked(dds_create_topic(participant, type, topic, NULL, NULL));
  const struct Output output = {checked(dds_create_writer(participant, described, qos, NULL)), topic, 0, 0};
  dds_delete_qos(qos);
  return output;
}

struct Input open_input(const dds_topic_descriptor_t* type, const char* topic, enum Durability durability,
                        size_t header, void (*handle)(const void*)) {
  dds_qos_t* qos = qos_of(durability, handle != NULL);
  const dds_entity_t described = checked(dds_create_topic(participant, type, topic, NULL, NULL));
  const struct Input input = {checked(dds_create_reader(participant, described, qos, NULL)), type, topic,
                              header, handle};
  dds_delete_qos(qos);
  return input;
}

void write_clocked(struct Output* output, const void* sample, roci_v1_SampleHeader* header) {
  header->run = (char*)options.run;
  header->robot = (char*)options.robot;
  header->sender = (char*)options.name;
  header->incarnation = options.incarnation;
  header->seq = output->total + 1;
  header->stamp_us = now_us();
  if (dds_write(output->writer, sample) != DDS_RETCODE_OK) fail("a sample could not be written");
  ++output->total;
}

void* take_sample(const struct Input* input, dds_sample_info_t* info) {
  void* sample = dds_alloc(input->type->m_size);
  if (dds_take(input->reader, &sample, info, 1, 1) == 1) return sample;
  free_sample(input, sample);
  return NULL;
}

void free_sample(const struct Input* input, void* sample) {
  dds_sample_free(sample, input->type, DDS_FREE_ALL);
}
