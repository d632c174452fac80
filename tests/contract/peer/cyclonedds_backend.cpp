// The peer on the C API of Cyclone DDS with the C structs of idlc: no line of services/ is in this program.
#include <dds/dds.h>

#include <cstring>
#include <stdexcept>
#include <vector>

#include "goal.h"
#include "motion.h"
#include "tests/contract/peer/backend.hpp"

namespace roci::contract_peer {
namespace {

dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) throw std::runtime_error(dds_strretcode(entity));
  return entity;
}

// Hands each sample to `use(value, info)`.
template <class T, class Use>
void take_all(dds_entity_t reader, Use use) {
  void* samples[1] = {nullptr};
  dds_sample_info_t info;
  while (dds_take(reader, samples, &info, 1, 1) == 1) {
    use(*static_cast<const T*>(samples[0]), info);
    dds_return_loan(reader, samples, 1);
  }
}

template <class T>
T zero() {
  T value;
  std::memset(&value, 0, sizeof value);
  return value;
}

char* lend(const std::string& text) { return const_cast<char*>(text.c_str()); }

// Strings of a sample must not be null on the wire.
void fill(roci_v1_SampleHeader& header) { header.sender = lend("native"); }

std::array<std::uint8_t, 16> guid_of(const roci_v1_SampleIdentity& id) {
  std::array<std::uint8_t, 16> guid;
  std::copy(std::begin(id.writer_guid), std::end(id.writer_guid), guid.begin());
  return guid;
}

roci_v1_SampleIdentity identity(const std::array<std::uint8_t, 16>& guid, std::int64_t sequence) {
  roci_v1_SampleIdentity id;
  std::copy(guid.begin(), guid.end(), std::begin(id.writer_guid));
  id.sequence_number = sequence;
  return id;
}

// Settings come from CYCLONEDDS_URI.
class CycloneBackend : public Backend {
 public:
  CycloneBackend(const Settings& settings, Handlers handlers)
      : run_(settings.run), partition_(settings.partition), handlers_(std::move(handlers)) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_userdata(qos, settings.announcement.data(), settings.announcement.size());
    participant_ =
        checked(dds_create_participant(static_cast<dds_domainid_t>(settings.domain), qos, nullptr));
    dds_delete_qos(qos);
  }
  ~CycloneBackend() override { dds_delete(participant_); }

  void open_goal_writer() override { writer_ = open_writer(roci_v1_Goal_desc, "roci/goal", true); }
  void open_goal_reader() override {
    open_reader(roci_v1_Goal_desc, "roci/goal", true, &CycloneBackend::on_goal);
  }
  void open_path_server() override {
    writer_ = open_writer(roci_v1_PathReply_desc, "roci/path/reply", false);
    open_reader(roci_v1_PathRequest_desc, "roci/path/request", false, &CycloneBackend::on_call);
  }
  void open_path_client() override {
    writer_ = open_writer(roci_v1_PathRequest_desc, "roci/path/request", false);
    open_reader(roci_v1_PathReply_desc, "roci/path/reply", false, &CycloneBackend::on_answer);
  }
  void open_stranger() override { writer_ = open_writer(roci_v1_Goal_desc, "roci/path/request", false); }

  bool write(const Goal& goal) override {
    const auto value = wire_goal(goal);
    return dds_write(writer_, &value) == DDS_RETCODE_OK;
  }
  bool dispose(const Goal& goal) override {
    const auto value = wire_goal(goal);
    return dds_dispose(writer_, &value) == DDS_RETCODE_OK;
  }
  bool call(const Call& call) override {
    auto request = zero<roci_v1_PathRequest>();
    request.request.request_id = identity(call.client, call.sequence);
    request.request.instance_name = lend("");
    fill(request.header);
    request.goal_pose.x_m = call.x_m;
    request.goal_pose.y_m = call.y_m;
    return dds_write(writer_, &request) == DDS_RETCODE_OK;
  }
  bool answer(const Answer& answer) override {
    std::vector<roci_v1_Pose2> waypoints(answer.waypoints);
    auto reply = zero<roci_v1_PathReply>();
    reply.reply.related_request_id = identity(answer.client, answer.sequence);
    reply.reply.remote_ex = static_cast<roci_v1_RemoteException>(answer.remote_exception);
    reply.reply.remote_message = lend(answer.message);
    fill(reply.header);
    reply.reason = lend("");
    reply.waypoints._length = reply.waypoints._maximum = static_cast<std::uint32_t>(waypoints.size());
    reply.waypoints._buffer = waypoints.data();
    reply.length_m = answer.length_m;
    return dds_write(writer_, &reply) == DDS_RETCODE_OK;
  }

 private:
  roci_v1_Goal wire_goal(const Goal& goal) const {
    auto value = zero<roci_v1_Goal>();
    value.issuer = lend(goal.issuer);
    value.id = lend(goal.id);
    fill(value.header);
    value.header.run = lend(run_);
    value.header.sender = lend(goal.issuer);
    value.goal_kind = lend("");
    value.priority = goal.priority;
    return value;
  }

  // An endpoint that is made straight on the participant takes its partition from the same settings.
  dds_qos_t* qos(bool latched) const {
    dds_qos_t* qos = dds_create_qos();
    if (!partition_.empty()) dds_qset_partition1(qos, partition_.c_str());
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, latched ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, 1);
    return qos;
  }

  dds_entity_t open_writer(const dds_topic_descriptor_t& type, const char* name, bool latched) {
    const auto topic = checked(dds_create_topic(participant_, &type, name, nullptr, nullptr));
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_publication_matched(
        listener, [](dds_entity_t, dds_publication_matched_status_t status, void* self) {
          static_cast<CycloneBackend*>(self)->handlers_.matched(static_cast<int>(status.current_count));
        });
    dds_qos_t* settings = qos(latched);
    const auto writer = checked(dds_create_writer(participant_, topic, settings, listener));
    dds_delete_qos(settings);
    dds_delete_listener(listener);
    return writer;
  }

  void open_reader(const dds_topic_descriptor_t& type, const char* name, bool latched,
                   dds_on_data_available_fn on_data) {
    const auto topic = checked(dds_create_topic(participant_, &type, name, nullptr, nullptr));
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, on_data);
    dds_qos_t* settings = qos(latched);
    checked(dds_create_reader(participant_, topic, settings, listener));
    dds_delete_qos(settings);
    dds_delete_listener(listener);
  }

  static void on_goal(dds_entity_t reader, void* self) {
    auto& handlers = static_cast<CycloneBackend*>(self)->handlers_;
    take_all<roci_v1_Goal>(reader, [&handlers](const roci_v1_Goal& goal, const dds_sample_info_t& info) {
      if (info.valid_data) return handlers.goal({goal.issuer, goal.id, goal.priority});
      handlers.goal_ended(info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED ? "disposed" : "lost",
                          {goal.issuer, goal.id});
    });
  }
  static void on_call(dds_entity_t reader, void* self) {
    auto& handlers = static_cast<CycloneBackend*>(self)->handlers_;
    take_all<roci_v1_PathRequest>(
        reader, [&handlers](const roci_v1_PathRequest& request, const dds_sample_info_t& info) {
          const auto& id = request.request.request_id;
          if (info.valid_data) {
            handlers.call({guid_of(id), id.sequence_number, request.goal_pose.x_m, request.goal_pose.y_m});
          }
        });
  }
  static void on_answer(dds_entity_t reader, void* self) {
    auto& handlers = static_cast<CycloneBackend*>(self)->handlers_;
    take_all<roci_v1_PathReply>(
        reader, [&handlers](const roci_v1_PathReply& reply, const dds_sample_info_t& info) {
          const auto& header = reply.reply;
          if (info.valid_data) {
            handlers.answer({guid_of(header.related_request_id), header.related_request_id.sequence_number,
                             static_cast<int>(header.remote_ex), header.remote_message, reply.length_m,
                             reply.waypoints._length});
          }
        });
  }

  const std::string run_;
  const std::string partition_;
  Handlers handlers_;
  dds_entity_t participant_ = 0;
  dds_entity_t writer_ = 0;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const Settings& settings, Handlers handlers) {
  return std::make_unique<CycloneBackend>(settings, std::move(handlers));
}

}  // namespace roci::contract_peer
