#include "drill_service.hpp"
#include "services/process/service_program.hpp"

ROCI_SERVICE_PROGRAM("drill_svc", borehole::make_drill)
