// These limits bound how far the tables and queues of services/ may grow by what comes from the wire. What is beyond
// is refused, counted, and reported by the event sample.refused (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

namespace roci::services::bounds {

/// Bounds the samples of one topic that wait for a node's loop: 256 of one instance in a micro-step (kMicroStepLimit)
/// from each of 256 writers.
inline constexpr std::size_t kInboxSamples = 65'536;
/// Bounds the bytes of one topic that wait for a node's loop, unless two samples of the topic's largest size take more:
/// a loop that hangs for ten seconds holds all that a link of 50 Mbit/s brings meanwhile.
inline constexpr std::size_t kInboxBytes = std::size_t{64} << 20;

/// Bounds the streams (topic, sender, start of the sender) that a participant of the simulated clock holds
/// back: 30 topics of 100 services, each started five times.
inline constexpr std::size_t kHeldBackStreams = 16'384;
/// Bounds the samples of one stream that are held back until the clock announces them, which it does after
/// each micro-step.
inline constexpr std::size_t kHeldBackSamples = 65'536;
/// Bounds the samples from outside the run (consoles) that wait for the next micro-step.
inline constexpr std::size_t kOutsideInputs = 4'096;

/// Bounds the services that a node knows by their heartbeats, or that take part in the simulated clock: ten
/// times the largest mission's.
inline constexpr std::size_t kPeers = 1'024;
/// Bounds the deaths that the simulated clock announces in one run, with each of its steps: 100 services, each dying
/// ten times.
inline constexpr std::size_t kRosterLosses = 1'024;
/// Bounds the streams that the simulated clock counts: as many as a participant holds back.
inline constexpr std::size_t kCountedStreams = kHeldBackStreams;

/// Bounds the participants whose contract is compared (ContractCheck): four times as many as a transport
/// knows.
inline constexpr std::size_t kContractPeers = 4'096;
/// Bounds the endpoints that were matched and whose participant is not known yet.
inline constexpr std::size_t kUnjudgedEndpoints = 16'384;
/// Bounds the bytes that the gate holds back for participants that are not known yet, beside its bound in
/// samples.
inline constexpr std::size_t kHeldBytes = std::size_t{64} << 20;

/// Bounds the requests of one procedure that a server has taken and not answered; the next is answered
/// REMOTE_EX_OUT_OF_RESOURCES. Each of our callers has at most a handful under way.
inline constexpr std::size_t kOpenRequests = 64;
/// Bounds the bytes of answers that a server keeps for callers that ask again, beside its bound in number; the
/// oldest go.
inline constexpr std::size_t kCachedReplyBytes = std::size_t{64} << 20;

}  // namespace roci::services::bounds
