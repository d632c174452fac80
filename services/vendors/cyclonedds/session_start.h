// Where a reliable volatile reader begins in what a writer of another vendor sends.
//
// Cyclone DDS 0.10 takes the first heartbeat of such a writer for the end of the past and skips all up to
// there, even what was written after the match and is still under way. Other vendors name what is not meant
// for a volatile reader in GAP messages, so nothing needs to be skipped: their first heartbeat is read like
// every other (RTPS 2.3, 8.3.7.5).
#pragma once

#include <dds/ddsi/ddsi_sertype.h>
#include <stdint.h>

// For a writer that a reliable volatile reader of `type` is matched with, best before the match takes effect
// (in the reader's listener). Harmless if repeated, for writers of Cyclone DDS, and for writers that have
// gone. Transient-local readers of the same writer in the same process would lose its past: they share one
// order of samples. No topic here has both; a writer whose past one of them still awaits is left alone.
void roci_keep_what_precedes_first_heartbeat(const struct ddsi_sertype* type, const uint8_t writer_guid[16]);

struct ddsi_domaingv;

// The GUID prefixes of all participants of the domain begin with these four bytes. To be called before the first
// participant is made; the other eight bytes stay the vendor's.
void roci_begin_prefixes_with(struct ddsi_domaingv* domain, const uint8_t start[4]);

// The GUID prefix of the next participant, up to the number that the vendor adds to its last eight bytes.
void roci_take_prefix(struct ddsi_domaingv* domain, const uint8_t prefix[12]);
