#include "preprocess/readers/point_record.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace relief {

Role role_of(std::string_view name) {
  constexpr std::pair<std::string_view, Role> names[] = {{"x", X},
                                                         {"y", Y},
                                                         {"z", Z},
                                                         {"nx", Nx},
                                                         {"ny", Ny},
                                                         {"nz", Nz},
                                                         {"normal_x", Nx},
                                                         {"normal_y", Ny},
                                                         {"normal_z", Nz},
                                                         {"red", Red},
                                                         {"green", Green},
                                                         {"blue", Blue},
                                                         {"r", Red},
                                                         {"g", Green},
                                                         {"b", Blue},
                                                         {"diffuse_red", Red},
                                                         {"diffuse_green", Green},
                                                         {"diffuse_blue", Blue},
                                                         {"s", U},
                                                         {"t", V},
                                                         {"u", U},
                                                         {"v", V},
                                                         {"texture_u", U},
                                                         {"texture_v", V}};
  const auto* const found =
      std::ranges::find(names, name, [](const auto& entry) { return entry.first; });
  return found != std::end(names) ? found->second : Other;
}

Role RecordLayout::add(Role role) {
  if (has_[role]) return Other;
  has_[role] = true;
  return role;
}

Role RecordLayout::add(std::string_view name, const Source& source) {
  const Role role = role_of(name);
  if (role != Other) return add(role);
  std::string scalar = file_scalar_name(name);
  if (!source.takes_scalar(scalar)) return Other;
  scalars_.push_back(std::move(scalar));
  return static_cast<Role>(Other + scalars_.size());
}

PointCollector::PointCollector(RecordLayout layout, ColourNumbers colour_numbers, std::size_t count)
    : layout_(std::move(layout)), colour_numbers_(colour_numbers) {
  points_.positions.reserve(count);
  if (layout_.normals()) points_.normals.reserve(count);
  if (layout_.colours()) colours_.reserve(count);
  if (layout_.texcoords()) points_.texcoords.reserve(count);
  begin_scalars(count);
}

void PointCollector::begin_scalars(std::size_t count) {
  for (const std::string& name : layout_.scalars()) {
    points_.scalars.push_back({name, false, {}});
    points_.scalars.back().values.reserve(count);
  }
}

void PointCollector::add(const PointRecord& record) {
  const auto vec3 = [&record](Role first) {
    return glm::vec3(static_cast<float>(record[first]), static_cast<float>(record[first + 1U]),
                     static_cast<float>(record[first + 2U]));
  };
  points_.positions.emplace_back(record[X], record[Y], record[Z]);
  if (layout_.normals()) points_.normals.push_back(vec3(Nx));
  if (layout_.colours()) colours_.push_back(vec3(Red));
  if (layout_.texcoords()) {
    points_.texcoords.emplace_back(static_cast<float>(record[U]), static_cast<float>(record[V]));
  }
  for (std::size_t k = 0; k < points_.scalars.size(); ++k)
    points_.scalars[k].values.push_back(record[kRoles + k]);
}

Points PointCollector::finish() {
  points_.colours =
      to_colours(colours_, colour_scale_.value_or(find_colour_scale(colours_, colour_numbers_)));
  colours_.clear();
  return std::exchange(points_, {});
}

Status PointCollector::give_block(const Source& source) {
  const float scale = find_colour_scale(colours_, colour_numbers_);
  if (!colour_scale_) colour_scale_ = scale;
  if (scale < *colour_scale_) {
    return make_error(
        "{}: its first {} points have colours up to {:g}, later ones larger; without --memory they "
        "can be read",
        source.name, PointSink::kBlockPoints, 255.0F / *colour_scale_);
  }
  Status taken = source.sink->take(finish());
  begin_scalars(PointSink::kBlockPoints);
  return taken;
}

}  // namespace relief
