// How far the tables and queues of services/ may grow by what comes from the wire. What is beyond is refused, counted,
// and told by the event sample.refused (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

namespace roci::services::bounds {

/// Samples of one topic that wait for a node's loop: 256 of one instance in a micro-step (kMicroStepLimit) from each of
/// 256 writers.
inline constexpr std::size_t kInboxSamples = 65'536;
/// Bytes of one topic that wait for a node's loop, where two samples of the largest size that the topic has do not take
/// more: a loop that hangs for ten seconds holds all that a link of 50 Mbit/s brings meanwhile.
inline constexpr std::size_t kInboxBytes = std::size_t{64} << 20;

/// Streams (topic, sender, start of it) that a participant of the simulated clock holds back: 30 topics of 100
/// services, each started five times.
inline constexpr std::size_t kHeldBackStreams = 16'384;
/// Samples of one stream that are held back until the clock announces them;
/// the clock announces them after each micro-step.
inline constexpr std::size_t kHeldBackSamples = 65'536;
/// Samples from outside the run (consoles) that wait for the next micro-step.
inline constexpr std::size_t kOutsideInputs = 4'096;

/// Services that a node knows by their heartbeats, or that take part in the simulated clock:
/// ten times the largest mission's.
inline constexpr std::size_t kPeers = 1'024;
/// Deaths that the simulated clock announces in one run, with each of its steps: 100 services, each dying ten times.
inline constexpr std::size_t kRosterLosses = 1'024;
/// Streams that the simulated clock counts: as many as a participant holds back.
inline constexpr std::size_t kCountedStreams = kHeldBackStreams;

/// Participants whose contract is compared (ContractCheck): as many as a transport knows, four times over.
inline constexpr std::size_t kContractPeers = 4'096;
/// Endpoints that were matched and whose participant is not known yet.
inline constexpr std::size_t kUnjudgedEndpoints = 16'384;
/// Bytes that the gate holds back for participants that are not known yet, beside its bound in samples.
inline constexpr std::size_t kHeldBytes = std::size_t{64} << 20;

/// Requests of one procedure that a server has taken and not answered; the next is answered REMOTE_EX_OUT_OF_RESOURCES.
/// Each of our callers has at most a handful under way.
inline constexpr std::size_t kOpenRequests = 64;
/// Bytes of answers that a server keeps for callers that ask again, beside its bound in number; the oldest go.
inline constexpr std::size_t kCachedReplyBytes = std::size_t{64} << 20;

}  // namespace roci::services::bounds
