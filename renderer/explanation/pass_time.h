// What one pass of a frame takes.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace relief {

struct PassTime {
  std::string name;
  double ms = 0.0;
};

/// Adds a pass's time to that of the same name.
inline void add_pass(std::vector<PassTime>& all, const PassTime& pass) {
  const auto same = std::ranges::find(all, pass.name, &PassTime::name);
  if (same == all.end())
    all.push_back(pass);
  else
    same->ms += pass.ms;
}

}  // namespace relief
