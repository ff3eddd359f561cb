#include <cmath>
#include <limits>
#include <utility>

#include "preprocess/readers/colours.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

/// Fewest bytes of a point: four numbers of a digit each, with separators.
constexpr std::size_t kMinPoint = 8;

/// As many as 16 bits tell apart.
constexpr std::size_t kMostScanners = 65536;

/// A scanner's frame: the rows of its axes, and its position.
struct ScanFrame {
  glm::dvec3 axes[3];
  glm::dvec3 translation{0.0};

  [[nodiscard]] glm::dvec3 in_world(glm::dvec3 p) const {
    return p.x * axes[0] + p.y * axes[1] + p.z * axes[2] + translation;
  }
};

class PtxReader {
 public:
  explicit PtxReader(const Source& source) : source_(source), line_(source.text), meter_(source) {}

  Result<Points> read() {
    if (source_.takes_scalar("intensity")) points_.scalars.push_back({"intensity", false, {}});
    std::size_t scans = 0;
    std::size_t coloured = 0;
    while (line_.next_line()) {
      const std::size_t before = colours_.size();
      RELIEF_TRY(read_scan());
      ++scans;
      coloured += colours_.size() > before ? 1U : 0U;
    }
    if (scans == 1) points_.viewpoint = frame_.translation;
    if (scans == 1 || scans > kMostScanners) forget_scanners();
    if (colours_.size() == points_.size()) {
      points_.colours = to_colours(colours_, ColourNumbers::Integer);
    } else if (coloured > 0) {
      source_.remarks.notes.push_back(
          fmt::format("{}: only {} of {} scans have colours; they are left out", source_.name,
                      coloured, scans));
    }
    return std::move(points_);
  }

 private:
  Error wrong(std::string_view what) {
    return make_error("{}: {}; the file is truncated or damaged", source_.name,
                      line_.expected(what));
  }

  /// Columns, rows, the scanner's position and axes (which the matrix repeats), the matrix, points.
  Status read_scan() {
    std::int64_t columns = 0;
    std::int64_t rows = 0;
    if (!line_.integer(columns, 0) || !line_.at_line_end()) return wrong("a number of columns");
    if (!line_.next_line() || !line_.integer(rows, 0) || !line_.at_line_end())
      return wrong("a number of rows");
    const auto count = static_cast<std::uint64_t>(columns);
    const std::uint64_t limit = (line_.left() + 1) / kMinPoint;
    if (rows != 0 && count > limit / static_cast<std::uint64_t>(rows)) {
      return make_error(
          "{}: line {}: states {} columns and {} rows, but the {} bytes that are left cannot hold "
          "as many points; the file is truncated or damaged",
          source_.name, line_.line_number(), columns, rows, line_.left());
    }
    RELIEF_TRY(read_frame());
    if (points_.scanners.size() < kMostScanners) points_.scanners.push_back(frame_.translation);
    return read_points(count * static_cast<std::uint64_t>(rows));
  }

  Status read_frame() {
    double numbers[4] = {};
    for (int i = 0; i < 4; ++i) {
      if (!read_line(numbers, 3)) return wrong("three numbers of the scanner's position and axes");
    }
    for (int i = 0; i < 4; ++i) {
      if (!read_line(numbers, 4)) return wrong("four numbers of the scan's matrix");
      const glm::dvec3 row(numbers[0], numbers[1], numbers[2]);
      if (!std::isfinite(row.x + row.y + row.z))
        return wrong("finite numbers in the matrix before");
      // Points are rows that are multiplied from the left, so the translation is the last row.
      (i < 3 ? frame_.axes[i] : frame_.translation) = row;
    }
    return {};
  }

  bool read_line(double* numbers, std::size_t count) {
    if (!line_.next_line()) return false;
    for (std::size_t i = 0; i < count; ++i) {
      if (!line_.number(numbers[i])) return false;
    }
    return line_.at_line_end();
  }

  Status read_points(std::uint64_t count) {
    if (points_.size() + count >= kNoPoint) return too_many_points(source_, points_.size() + count);
    points_.positions.reserve(points_.size() + count);
    bool coloured = false;
    for (std::uint64_t k = 0; k < count; ++k) {
      double n[7] = {};
      if (!line_.next_line()) return wrong("a point of the scan");
      for (std::size_t i = 0; i < 4; ++i) {
        if (!line_.number(n[i])) return wrong("x, y, z and intensity");
      }
      if (k == 0) coloured = !line_.at_line_end();
      for (std::size_t i = 4; coloured && i < 7; ++i) {
        if (!line_.number(n[i])) return wrong("red, green and blue");
      }
      if (!line_.at_line_end()) return wrong("the line's end");
      if (!meter_.advance_to(line_.offset())) return interrupted_error();
      const glm::dvec3 p(n[0], n[1], n[2]);
      // The scanner's own position means a beam without an echo: NaN, as in PCD files.
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      points_.scanner_of.push_back(static_cast<std::uint16_t>(points_.scanners.size() - 1));
      points_.positions.push_back(p == glm::dvec3(0.0) ? glm::dvec3(nan) : frame_.in_world(p));
      if (coloured) colours_.emplace_back(n[4], n[5], n[6]);
      if (!points_.scalars.empty()) points_.scalars.front().values.push_back(n[3]);
    }
    return {};
  }

  void forget_scanners() {
    points_.scanners.clear();
    points_.scanner_of.clear();
  }

  const Source& source_;
  TextCursor line_;
  ReadMeter meter_;
  Points points_;
  ScanFrame frame_;  ///< of the last scan
  std::vector<glm::vec3> colours_;
};

}  // namespace

Result<Points> read_ptx(const Source& source) {
  return PtxReader(source).read();
}

}  // namespace relief
