// In C: the private headers below are no C++.
#include "services/vendors/cyclonedds/session_start.h"

#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsi/ddsi_entity_index.h>
#include <dds/ddsi/ddsi_proxy_endpoint.h>
#include <dds/ddsi/q_bswap.h>
#include <dds/ddsi/q_thread.h>
#include <string.h>

static void expect_from_first_heartbeat(struct ddsi_proxy_writer* writer) {
  ddsrt_mutex_lock(&writer->e.lock);
  if (writer->n_readers_out_of_sync == 0) writer->have_seen_heartbeat = 1;
  ddsrt_mutex_unlock(&writer->e.lock);
}

void roci_keep_what_precedes_first_heartbeat(const struct ddsi_sertype* type, const uint8_t writer_guid[16]) {
  const struct ddsi_domaingv* domain = ddsrt_atomic_ldvoidp(&type->gv);
  ddsi_guid_t guid;
  memcpy(&guid, writer_guid, sizeof guid);
  guid = nn_ntoh_guid(guid);
  // What a thread has looked up is not freed while it is awake.
  struct thread_state* thread = lookup_thread_state();
  thread_state_awake(thread, domain);
  struct ddsi_proxy_writer* found = entidx_lookup_proxy_writer_guid(domain->entity_index, &guid);
  if (found && !vendor_is_eclipse(found->c.vendor)) expect_from_first_heartbeat(found);
  thread_state_asleep(thread);
}

void roci_take_prefix(struct ddsi_domaingv* domain, const uint8_t prefix[12]) {
  for (int part = 0; part < 3; ++part) {
    const uint8_t* bytes = prefix + 4 * part;
    domain->ppguid_base.prefix.u[part] =
        (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
  }
}

void roci_begin_prefixes_with(struct ddsi_domaingv* domain, const uint8_t start[4]) {
  // The vendor keeps prefixes in the byte order of the machine and counts on in their last eight bytes.
  domain->ppguid_base.prefix.u[0] =
      (uint32_t)start[0] << 24 | (uint32_t)start[1] << 16 | (uint32_t)start[2] << 8 | start[3];
}
