// An engine that a test adds: draws each sample of the patches as one pixel of a flat colour.
#pragma once

#include "renderer/engine.h"

namespace relief::toy {

EngineEntry entry();

}  // namespace relief::toy
