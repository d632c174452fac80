#include "logbook_service.hpp"
#include "services/process/service_program.hpp"

ROCI_SERVICE_PROGRAM("logbook_svc", borehole::make_logbook)
