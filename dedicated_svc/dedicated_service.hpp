// This is a dedicated executive as a service, which the program and a rehearsal make.
#pragma once
#include <functional>
#include <memory>

#include "services/service.hpp"

namespace roci::dedicated {

/// Makes a dedicated executive with the methods of its mission file (README.md). Throws mission::FileError when they
/// cannot be read, std::system_error when its ledger cannot be opened.
std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings);

/// The same; `around_write` is called before and after each write of what its next process would go on with.
std::unique_ptr<services::Service> make_watched_service(services::Node& node,
                                                        const services::RunSettings& settings,
                                                        std::function<void()> around_write);

}  // namespace roci::dedicated
