// This is an executive with a journal of its own, which no other one follows.
#include <memory>
#include <string>

#include "exec_svc/exec_service.hpp"
#include "exec_svc/journal/journal.hpp"
#include "exec_svc/run_files_service.hpp"
#include "services/log/log.hpp"
#include "services/node.hpp"

namespace roci::exec {

using journal::Durability;
using journal::Journal;
using services::Node;

namespace {

class LoneExecutive final : public services::Service {
 public:
  LoneExecutive(Node& node, const services::RunSettings& settings)
      : journal_(usable_journal(run_file(settings, node.options().name, journal::kJournalFile),
                                services::process::DiskPause(node)),
                 node.options().clock == services::clock::ClockMode::live ? Durability::power
                                                                          : Durability::process),
        executive_(make_executive(node, settings, journal_, next_epoch(node))) {}

 private:
  // Takes the next epoch, and waits for the disk; later the executive itself does.
  std::uint64_t next_epoch(Node& node) {
    const auto pause = std::make_shared<services::process::DiskPause>(node);
    journal_.wait_for_disk({[pause](const std::string& cause) {
                              if (pause->wait())
                                services::log::error("exec_svc waits for its disk before it begins: " +
                                                     cause);
                            },
                            nullptr});
    journal_.watch_extent();
    return journal_.next_epoch();
  }

  Journal journal_;
  std::unique_ptr<services::Service> executive_;
};

}  // namespace

std::unique_ptr<services::Service> make_service(Node& node, const services::RunSettings& settings) {
  return std::make_unique<LoneExecutive>(node, settings);
}

}  // namespace roci::exec
