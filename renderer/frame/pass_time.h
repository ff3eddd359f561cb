// What one pass of a frame takes.
#pragma once

#include <string>

namespace relief {

struct PassTime {
  std::string name;
  double ms = 0.0;
};

}  // namespace relief
