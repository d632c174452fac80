// The drill: the same as ../../drill/drill_service.cpp, on the wire alone.
#ifndef BOREHOLE_DRILL_H
#define BOREHOLE_DRILL_H

#include "clock_service.h"

// Opens the drill's topics.
struct Service open_drill(void);

#endif
