#include "preprocess/readers/selection.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "preprocess/points/keep_points.h"

namespace relief {

std::string describe_classes(const PointSelection& selection) {
  std::string text;
  for (std::size_t c = 0; c < selection.classes.size(); ++c) {
    if (selection.classes.test(c))
      text += fmt::format("{}{}", text.empty() ? "--classes " : ",", c);
  }
  std::string returns;
  switch (selection.returns) {
    case ReturnChoice::All:
      return text;
    case ReturnChoice::First:
      returns = "first";
      break;
    case ReturnChoice::Last:
      returns = "last";
      break;
    case ReturnChoice::Single:
      returns = "single";
      break;
    case ReturnChoice::Numbered:
      returns = fmt::format("{}", selection.return_number);
      break;
  }
  return fmt::format("{}{}--returns {}", text, text.empty() ? "" : " ", returns);
}

std::string describe_box(const Bounds& box) {
  const bool has_z = std::isfinite(box.min.z) && std::isfinite(box.max.z);
  return has_z ? fmt::format("{},{},{},{},{},{}", box.min.x, box.min.y, box.max.x, box.max.y,
                             box.min.z, box.max.z)
               : fmt::format("{},{},{},{}", box.min.x, box.min.y, box.max.x, box.max.y);
}

std::uint64_t crop_points(Points& points, const Bounds& box) {
  std::vector<std::uint8_t> dropped(points.size());
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    const glm::dvec3& p = points.positions[i];
    // Negated so that NaN is dropped, too.
    dropped[i] =
        static_cast<std::uint8_t>(!(p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y &&
                                    p.y <= box.max.y && p.z >= box.min.z && p.z <= box.max.z));
  }
  return drop_points(points, dropped);
}

Error nothing_in_crop(std::string_view name, const Bounds& crop, const Bounds& bounds) {
  return make_error("{}: no point lies in --crop {}; its points lie in {}", name,
                    describe_box(crop), describe_box(bounds));
}

}  // namespace relief
