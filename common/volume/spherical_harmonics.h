// Real spherical harmonics, with the signs that 3D Gaussian files have.
#pragma once

#include <cassert>
#include <glm/vec3.hpp>
#include <span>

#include "common/volume/gaussian_cloud.h"

namespace relief {

/// The basis functions up to a degree (0 to 4) of a direction d of length 1, by degree and order:
/// those of [Kerbl 2023] (degrees 0 to 3) and of gsplat and spz (degree 4). `out` has
/// harmonics_of(degree) elements.
inline void harmonics_basis(glm::dvec3 d, int degree, std::span<double> out) {
  assert(out.size() >= harmonics_of(degree) && "an element for each basis function");
  const double x = d.x;
  const double y = d.y;
  const double z = d.z;
  out[0] = 0.28209479177387814;
  if (degree < 1) return;
  out[1] = -0.4886025119029199 * y;
  out[2] = 0.4886025119029199 * z;
  out[3] = -0.4886025119029199 * x;
  if (degree < 2) return;
  const double xx = x * x;
  const double yy = y * y;
  const double zz = z * z;
  out[4] = 1.0925484305920792 * x * y;
  out[5] = -1.0925484305920792 * y * z;
  out[6] = 0.31539156525252005 * (2.0 * zz - xx - yy);
  out[7] = -1.0925484305920792 * x * z;
  out[8] = 0.5462742152960396 * (xx - yy);
  if (degree < 3) return;
  out[9] = -0.5900435899266435 * y * (3.0 * xx - yy);
  out[10] = 2.890611442640554 * x * y * z;
  out[11] = -0.4570457994644658 * y * (4.0 * zz - xx - yy);
  out[12] = 0.3731763325901154 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy);
  out[13] = -0.4570457994644658 * x * (4.0 * zz - xx - yy);
  out[14] = 1.445305721320277 * z * (xx - yy);
  out[15] = -0.5900435899266435 * x * (xx - 3.0 * yy);
  if (degree < 4) return;
  out[16] = 2.5033429417967046 * x * y * (xx - yy);
  out[17] = -1.7701307697799304 * y * z * (3.0 * xx - yy);
  out[18] = 0.9461746957575601 * x * y * (7.0 * zz - 1.0);
  out[19] = -0.6690465435572892 * y * z * (7.0 * zz - 3.0);
  out[20] = 0.10578554691520431 * (zz * (35.0 * zz - 30.0) + 3.0);
  out[21] = -0.6690465435572892 * x * z * (7.0 * zz - 3.0);
  out[22] = 0.47308734787878004 * (xx - yy) * (7.0 * zz - 1.0);
  out[23] = -1.7701307697799304 * x * z * (xx - 3.0 * yy);
  out[24] = 0.6258357354491761 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy));
}

}  // namespace relief
