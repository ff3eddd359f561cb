// The engine `volume-truth`: what volumes and 3D Gaussians look like without the approximations of
// splatting, on the CPU, in double precision. The image does not depend on the number of threads.
// Normals are not made.
#pragma once

#include <memory>

#include "renderer/engine.h"

namespace relief::volume_truth {

/// An engine's `prepare`. Images of volumes fail unless their grid is regular, and with
/// Truth::Kernels if an iso surface is wanted, whose kernels are too thin to be integrated.
Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::volume_truth
