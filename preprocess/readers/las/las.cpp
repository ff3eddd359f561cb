#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "preprocess/readers/las/airborne.h"
#include "preprocess/readers/las/las_header.h"
#include "preprocess/readers/las/las_point.h"
#include "preprocess/readers/las/las_scalars.h"
#include "preprocess/readers/number_type.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// The contents of a file's 16-bit colour fields. Files do not state it; it follows from the
/// largest value.
enum class Colours {
  None,   ///< the format has none, or all are 0, so unset
  Bytes,  ///< at most 255
  Words   ///< 16 bits
};

/// What one point says of that; of all points the largest holds.
Colours colours_of(const LasPoint& point) {
  const auto largest = std::max({point.colour.x, point.colour.y, point.colour.z});
  return largest > 255 ? Colours::Words : largest > 0 ? Colours::Bytes : Colours::None;
}

Result<LasRecords> open_records(const Source& source, const LasHeader& header) {
  if (header.is_packed) return open_laz_records(source, header);
  return open_las_records(source, header);
}

/// Decides which points are read, and counts the others.
class PointFilter {
 public:
  PointFilter(const PointSelection& selection, bool is_wide)
      : selection_(selection), has_classes_(selection.classes.any()), is_wide_(is_wide) {}

  [[nodiscard]] bool takes(const LasPoint& point) {
    if (point.is_withheld) {
      ++withheld_;
      return false;
    }
    // Class 18, high noise, is only defined in formats with a separate byte for classes.
    const bool is_noise = point.point_class == 7 || (is_wide_ && point.point_class == 18);
    if (!has_classes_ && is_noise) {
      ++noise_;
      return false;
    }
    ++of_class_[point.point_class];
    if ((!has_classes_ || selection_.classes.test(point.point_class)) && takes_return(point))
      return true;
    ++not_selected_;
    return false;
  }

  void add_remarks(const Source& source) const {
    source.remarks.left_out = withheld_ + noise_;
    source.remarks.not_selected = not_selected_;
    if (withheld_ + noise_ == 0) return;
    source.remarks.notes.push_back(
        fmt::format("{}: {} withheld points and {} of noise (class 7 or 18) are left out",
                    source.name, withheld_, noise_));
  }

  /// Returns why no point of a file with points was taken.
  [[nodiscard]] Error no_points(const Source& source) const {
    if (not_selected_ == 0) {
      return make_error("{}: holds no points to use: all {} are marked as withheld or noise",
                        source.name, withheld_ + noise_);
    }
    std::string classes;
    for (std::size_t c = 0; c < of_class_.size(); ++c) {
      if (of_class_[c] > 0) classes += fmt::format("{}{}", classes.empty() ? "" : ", ", c);
    }
    return make_error("{}: no point is selected by {}; its classes are {}", source.name,
                      describe_classes(selection_), classes);
  }

 private:
  [[nodiscard]] bool takes_return(const LasPoint& point) const {
    switch (selection_.returns) {
      case ReturnChoice::All:
        return true;
      case ReturnChoice::First:
        return point.return_number == 1;
      // Some writers count the returns of a pulse too low.
      case ReturnChoice::Last:
        return point.return_number >= point.returns;
      case ReturnChoice::Single:
        return point.return_number == 1 && point.returns == 1;
      case ReturnChoice::Numbered:
        return point.return_number == selection_.return_number;
    }
    return true;
  }

  const PointSelection& selection_;
  bool has_classes_;
  bool is_wide_;
  std::uint64_t withheld_ = 0;
  std::uint64_t noise_ = 0;
  std::uint64_t not_selected_ = 0;
  std::array<std::uint64_t, 256> of_class_{};
};

void note_colours(const Source& source, Colours colours) {
  if (colours == Colours::Bytes) {
    source.remarks.notes.push_back(fmt::format(
        "{}: its colours are at most 255 and taken as 8-bit, though their fields have 16 bits",
        source.name));
  } else if (colours == Colours::Words) {
    source.remarks.notes.push_back(
        fmt::format("{}: its colours have 16 bits, of which the upper 8 are taken", source.name));
  }
}

/// What a file does not state, and its points tell together.
struct Survey {
  Colours colours = Colours::None;
  bool is_airborne = false;  ///< looks_airborne
};

/// Enough to know how evenly a scan sees the ground.
constexpr std::uint64_t kSampledPoints = 200'000;

Result<Survey> survey(const Source& source, const LasHeader& header) {
  RELIEF_TRY_ASSIGN(const auto reader, open_records(source, header));
  Survey found;
  std::vector<glm::dvec3> sample;
  bool several_returns = false;
  PointFilter filter(source.selection(), header.is_wide());
  const std::uint64_t step = header.points / kSampledPoints + 1;
  const bool has_colours = header.colour_at() != 0;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % PointSink::kBlockPoints == 0) {
      if (source.progress.cancelled()) return interrupted_error();
      if (source.sink != nullptr) source.sink->pass(reader->offset());
    }
    RELIEF_TRY_ASSIGN(const char* const record, reader->next());
    const LasPoint point = read_las_point(record, header);
    if (has_colours) found.colours = std::max(found.colours, colours_of(point));
    if (i % step != 0 || !filter.takes(point)) continue;
    sample.push_back(header.offset + header.scale * glm::dvec3(point.steps));
    several_returns |= point.returns > 1;
  }
  found.is_airborne = looks_airborne(sample, several_returns);
  return found;
}

}  // namespace

Result<Points> read_las(const Source& source) {
  RELIEF_TRY_ASSIGN(const auto header, read_las_header(source));
  RELIEF_TRY_ASSIGN(const Survey found, survey(source, header));
  const Colours colours = found.colours;
  RELIEF_TRY_ASSIGN(const auto reader, open_records(source, header));
  Points points;
  points.is_airborne = found.is_airborne;
  std::uint64_t given = 0;  // to the sink
  // The count of a packed file says little: its points may take next to no bytes.
  const std::uint64_t capacity =
      source.sink != nullptr || header.is_packed
          ? std::min<std::uint64_t>(header.points, PointSink::kBlockPoints)
          : header.points;
  points.positions.reserve(capacity);
  if (colours != Colours::None) points.colours.reserve(capacity);
  const std::vector<LasScalar> scalars = find_las_scalars(source, header);
  const auto begin_scalars = [&] {
    for (const LasScalar& scalar : scalars) points.scalars.push_back({scalar.name, false, {}});
  };
  begin_scalars();
  // The upper byte is right for both scalings of a byte to 16 bits, by 256 and by 257.
  const unsigned shift = colours == Colours::Words ? 8 : 0;
  PointFilter filter(source.selection(), header.is_wide());
  ReadMeter meter(source);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (!meter.advance_to(reader->offset())) return interrupted_error();
    RELIEF_TRY_ASSIGN(const char* const record, reader->next());
    const LasPoint point = read_las_point(record, header);
    if (!filter.takes(point)) continue;
    points.positions.push_back(header.offset + header.scale * glm::dvec3(point.steps));
    if (colours != Colours::None)
      points.colours.emplace_back(point.colour.x >> shift, point.colour.y >> shift,
                                  point.colour.z >> shift);
    for (std::size_t k = 0; k < scalars.size(); ++k)
      points.scalars[k].values.push_back(scalars[k].of(record));
    if (source.sink != nullptr && points.size() == PointSink::kBlockPoints) {
      given += points.size();
      if (Status taken = source.sink->take(std::exchange(points, {})); !taken) return taken.error();
      points.is_airborne = found.is_airborne;
      begin_scalars();
    }
  }
  note_colours(source, colours);
  filter.add_remarks(source);
  if (points.size() + given == 0 && header.points > 0) return filter.no_points(source);
  return points;
}

}  // namespace relief
