// generate_scan POINTS > SCAN.ply: the scan that `make demo` takes where no real one can be had.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "models/knot_scan.h"

int main(int argc, char** argv) {
  const long points = argc == 2 ? std::strtol(argv[1], nullptr, 10) : 0;
  if (points < 1) {
    std::fputs("usage: generate_scan POINTS > SCAN.ply\n", stderr);
    return 2;
  }
  const std::string ply = relief::knot_scan_ply(static_cast<std::size_t>(points));
  const bool written =
      std::fwrite(ply.data(), 1, ply.size(), stdout) == ply.size() && std::fflush(stdout) == 0;
  return written ? 0 : 1;
}
