// What can be chosen about the engine `multipass`.
#pragma once

namespace relief {

struct MultipassSettings {
  /// Radius of the splats over that of Eq. (1) of [Ochotta 2008]. 1 and 2 are its Table 1's
  /// "standard1" and "standard2"; with 2 a splat reaches its neighbours' centres, which is what
  /// comes near to interpolation.
  double radius_factor = 2.0;
};

}  // namespace relief
