#include "viewer/frame_log.h"

#include <fmt/format.h>

#include <array>
#include <chrono>

namespace relief {
namespace {

constexpr std::array<const char*, 4> kKinds{"empty", "moving", "band", "panels"};

}  // namespace

Result<FrameLog> FrameLog::open(const std::filesystem::path& path) {
  FrameLog log;
  log.file_.open(path);
  if (!log.file_) return make_error("{}: cannot be written", path.string());
  log.file_ << "seconds,kind,ms,scale" << std::endl;
  return log;
}

void FrameLog::add(FrameKind kind, double ms, double scale) {
  if (!file_.is_open()) return;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  file_ << fmt::format("{:.4f},{},{:.2f},{}", seconds, kKinds[static_cast<std::size_t>(kind)], ms,
                       scale)
        << std::endl;
}

}  // namespace relief
