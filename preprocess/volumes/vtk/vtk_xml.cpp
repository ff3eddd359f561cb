#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/volumes/volume_grid.h"
#include "preprocess/volumes/volume_readers.h"
#include "preprocess/volumes/vtk/vtk_array.h"

namespace relief {
namespace {

/// First and last index of the nodes along each axis.
struct VtkExtent {
  glm::dvec3 first{0.0};
  std::array<std::int64_t, 3> size{};
};

Status check_vtk_document(const std::string& name, const VtkDocument& document) {
  if (document.kind != "ImageData" && document.kind != "RectilinearGrid" &&
      document.kind != "StructuredGrid") {
    return make_error(
        "{}: holds {}, but a volume is VTK's ImageData, RectilinearGrid or StructuredGrid", name,
        document.kind.empty() ? "no VTKFile" : relief::quoted(document.kind));
  }
  if (document.pieces != 1) {
    return make_error("{}: has {} pieces, but only files of one can be read; save it as one", name,
                      document.pieces);
  }
  if (!document.compressor.empty() && document.compressor != "vtkZLibDataCompressor") {
    return make_error("{}: is compressed by {}; only vtkZLibDataCompressor can be read", name,
                      relief::quoted(document.compressor));
  }
  if (document.byte_order != "LittleEndian" && document.byte_order != "BigEndian") {
    return make_error("{}: its byte order is {}; expected LittleEndian or BigEndian", name,
                      relief::quoted(document.byte_order));
  }
  if (!document.header_type.empty() && document.header_type != "UInt32" &&
      document.header_type != "UInt64") {
    return make_error("{}: its header type is {}; expected UInt32 or UInt64", name,
                      relief::quoted(document.header_type));
  }
  return {};
}

Result<VtkExtent> parse_vtk_extent(const std::string& name, std::string_view text) {
  VtkExtent extent;
  TextCursor cursor(text);
  bool good = true;
  for (std::size_t axis = 0; axis < 3 && good; ++axis) {
    std::int64_t first = 0;
    std::int64_t last = 0;
    constexpr std::int64_t most = std::int64_t{1} << 31U;  // VTK's indices have 32 bits
    good =
        cursor.integer(first, -most) && cursor.integer(last, -most) && first < most && last < most;
    extent.first[static_cast<glm::length_t>(axis)] = static_cast<double>(first);
    extent.size[axis] = good ? last - first + 1 : 0;
  }
  if (good && cursor.at_line_end()) return extent;
  return make_error("{}: its piece has the extent {}; expected six whole numbers", name,
                    relief::quoted(text));
}

/// Reads all numbers of an attribute; keeps them as they are if it is empty.
Status parse_vtk_numbers(const std::string& name, std::string_view attribute, std::string_view text,
                         std::span<double> numbers) {
  if (text.empty()) return {};
  TextCursor cursor(text);
  const bool good = std::ranges::all_of(numbers, [&](double& n) { return cursor.number(n); });
  if (good && cursor.at_line_end()) return {};
  return make_error("{}: its {} is {}; expected {} numbers", name, attribute, relief::quoted(text),
                    numbers.size());
}

/// Whether an array has this number of numbers a node; one if it does not say.
bool has_components(const VtkArray& array, std::string_view count) {
  return array.components == count || (array.components.empty() && count == "1");
}

/// The active scalars, or else the first array that has a number a node and is not a mark of VTK's.
Result<const VtkArray*> find_scalars(const std::string& name, const VtkDocument& document) {
  const VtkArray* found = nullptr;
  for (const VtkArray& array : document.point_data) {
    if (!has_components(array, "1")) continue;
    if (!array.name.empty() && array.name == document.active_scalars) return &array;
    if (found == nullptr && array.name != "vtkGhostType" && array.name != "vtkValidPointMask")
      found = &array;
  }
  if (found != nullptr) return found;
  if (document.point_data.empty() && !document.cell_data.empty()) {
    return make_error(
        "{}: has values at cells only; convert them to point data (ParaView: Cell Data to Point "
        "Data)",
        name);
  }
  return make_error("{}: has no array with one number for each point; extract a component", name);
}

Result<ScalarVolume> place_image(const std::string& name, const VtkDocument& document,
                                 const VtkExtent& extent) {
  glm::dvec3 origin(0.0);
  glm::dvec3 spacing(1.0);
  glm::dmat3 rows(1.0);
  RELIEF_TRY(parse_vtk_numbers(name, "origin", document.origin, std::span(&origin.x, 3)));
  RELIEF_TRY(parse_vtk_numbers(name, "spacing", document.spacing, std::span(&spacing.x, 3)));
  RELIEF_TRY(parse_vtk_numbers(name, "direction", document.direction, std::span(&rows[0][0], 9)));
  RegularGrid grid{origin, scaled_axes(glm::transpose(rows), spacing)};
  grid.origin += grid.step * extent.first;
  return make_volume(name, extent.size, grid, {});
}

/// Makes coordinates ascend by turning the axis. Returns false if they neither rise nor fall.
bool make_ascending(std::vector<double>& coordinates, glm::dvec3& axis) {
  if (coordinates.front() > coordinates.back()) {
    for (double& c : coordinates) c = -c;
    axis = -axis;
  }
  // Also false for NaN.
  for (std::size_t k = 1; k < coordinates.size(); ++k) {
    if (!(coordinates[k - 1] < coordinates[k])) return false;
  }
  return std::isfinite(coordinates.front()) && std::isfinite(coordinates.back());
}

Result<ScalarVolume> place_rectilinear(const VolumeSource& source, const VtkDocument& document,
                                       const VtkExtent& extent) {
  if (document.coordinates.size() != 3) {
    return make_error("{}: has {} arrays of coordinates; a rectilinear grid has 3", source.name,
                      document.coordinates.size());
  }
  RELIEF_TRY_ASSIGN(auto volume, make_volume(source.name, extent.size, {}, {}));
  RectilinearGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto count = static_cast<std::uint64_t>(extent.size[axis]);
    RELIEF_TRY_ASSIGN(grid.coordinates[axis],
                      read_vtk_array<double>(source, document, document.coordinates[axis], count));
    if (!make_ascending(grid.coordinates[axis], grid.axes[static_cast<glm::length_t>(axis)])) {
      return make_error("{}: its coordinates along axis {} neither rise nor fall all the way",
                        source.name, axis);
    }
  }
  volume.placement = std::move(grid);
  return volume;
}

Result<ScalarVolume> place_structured(const VolumeSource& source, const VtkDocument& document,
                                      const VtkExtent& extent) {
  if (document.points.size() != 1 || !has_components(document.points[0], "3")) {
    return make_error("{}: lacks one array of points with three coordinates each", source.name);
  }
  ScalarVolume volume;
  // The value, and the position as the file's numbers and as a vector.
  constexpr std::uint64_t bytes_each = sizeof(float) + 2 * sizeof(glm::dvec3);
  RELIEF_TRY_ASSIGN(volume.size, checked_size(source.name, extent.size, bytes_each));
  RELIEF_TRY_ASSIGN(const auto numbers, read_vtk_array<double>(source, document, document.points[0],
                                                               3 * nodes_of(volume)));
  CurvilinearGrid grid;
  grid.positions.reserve(nodes_of(volume));
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    grid.positions.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    if (!std::isfinite(numbers[k] + numbers[k + 1] + numbers[k + 2])) {
      return make_error("{}: point {} is ({}, {}, {}), which is not a position", source.name, k / 3,
                        numbers[k], numbers[k + 1], numbers[k + 2]);
    }
  }
  volume.placement = std::move(grid);
  return volume;
}

Result<ScalarVolume> place_vtk(const VolumeSource& source, const VtkDocument& document) {
  RELIEF_TRY_ASSIGN(const auto extent, parse_vtk_extent(source.name, document.extent));
  if (document.kind == "ImageData") return place_image(source.name, document, extent);
  if (document.kind == "RectilinearGrid") return place_rectilinear(source, document, extent);
  return place_structured(source, document, extent);
}

}  // namespace

Result<ScalarVolume> read_vtk_xml(const VolumeSource& source) {
  RELIEF_TRY_ASSIGN(const auto document, parse_vtk_document(source));
  RELIEF_TRY(check_vtk_document(source.name, document));
  RELIEF_TRY_ASSIGN(const VtkArray* const scalars, find_scalars(source.name, document));
  RELIEF_TRY_ASSIGN(auto volume, place_vtk(source, document));
  RELIEF_TRY_ASSIGN(volume.values,
                    read_vtk_array<float>(source, document, *scalars, nodes_of(volume)));
  return volume;
}

}  // namespace relief
