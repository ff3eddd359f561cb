// The engine `volume-reference`: EWA volume splatting [Zwicker 2002] and 3D Gaussians
// [Kerbl 2023] on the CPU, in double precision. The image does not depend on the number of threads.
#pragma once

#include <memory>

#include "renderer/engine.h"

namespace relief::volume_reference {

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::volume_reference
