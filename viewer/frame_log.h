// A record of the frames that a window has shown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "common/error.h"

namespace relief {

/// What a frame shows.
enum class FrameKind : std::uint8_t {
  Empty,   ///< no model
  Moving,  ///< the whole picture, coarsely
  Band,    ///< a part of the picture at rest
  Panels   ///< the picture as it was
};

/// Writes a CSV file with a line for each frame, for whoever measures how fast a window is. Each
/// line is written at once, so that the file is complete whatever ends the program.
class FrameLog {
 public:
  FrameLog() = default;  ///< writes nothing
  static Result<FrameLog> open(const std::filesystem::path& path);

  /// `ms`: from the events that led to the frame until it was in the window. The line begins with
  /// the seconds of the machine's monotonic clock, then.
  void add(FrameKind kind, double ms, double scale);

 private:
  std::ofstream file_;
};

}  // namespace relief
