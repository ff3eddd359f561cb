#include "renderer/engines/raytrace/embree_scene.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace relief::raytrace {
namespace {

/// How far single precision may move a box or a ray at a distance of 1 from Embree's origin: the
/// box, the ray's start and its direction are rounded by 6e-8 of that each. Neither the start nor
/// the path is longer than that distance (twice that along a diagonal), because the origin is the
/// position of the mesh's box that is nearest to the eye. Rays that start anywhere enter the box
/// far from there: for them the distance is that of the box's other end.
constexpr double kSlack = 1e-6;

double largest(glm::dvec3 v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The box of the positions that are numbers, relative to the eye.
Bounds box_about(const std::vector<glm::dvec3>& positions, glm::dvec3 eye) {
  Bounds box{glm::dvec3(std::numeric_limits<double>::max()),
             glm::dvec3(std::numeric_limits<double>::lowest())};
  for (const glm::dvec3& p : positions) {
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    box.min = glm::min(box.min, p - eye);
    box.max = glm::max(box.max, p - eye);
  }
  return box;
}

/// How far along `direction` from `start` a box begins, in lengths of it; nothing if it is not
/// there.
std::optional<double> enter(const Bounds& whole, glm::dvec3 start, glm::dvec3 direction) {
  const Bounds box{whole.min - start, whole.max - start};
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (glm::length_t k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (box.min[k] > 0.0 || box.max[k] < 0.0) return std::nullopt;
      continue;
    }
    const double a = box.min[k] / direction[k];
    const double b = box.max[k] / direction[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return std::nullopt;
  return first;
}

/// Whether a ray meets a triangle from the other side than its vertices' normals point to.
bool is_leaving(const TriangleMesh& mesh, const Triangle& t, glm::dvec3 direction) {
  const glm::dvec3 across = glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                       mesh.positions[t[2]] - mesh.positions[t[0]]);
  const glm::vec3 outward = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
  const double side = glm::dot(across, direction);
  return glm::dot(across, glm::dvec3(outward)) < 0.0 ? side < 0.0 : side > 0.0;
}

Status check_device(RTCDevice device, std::size_t triangles) {
  switch (const RTCError error = rtcGetDeviceError(device)) {
    case RTC_ERROR_NONE:
      return {};
    case RTC_ERROR_CANCELLED:
      return interrupted_error();
    case RTC_ERROR_OUT_OF_MEMORY:
      return make_error("the ray tracer has not enough memory for {} triangles; use a coarser mesh",
                        triangles);
    default:
      return make_error("the ray tracer (Embree) can't work on this machine: its error {}",
                        static_cast<int>(error));
  }
}

}  // namespace

/// The mesh as rays see it.
struct EmbreeScene::Corners {
  const TriangleMesh* mesh = nullptr;
  std::vector<glm::dvec3> positions;  ///< relative to the eye, in Embree's unit
  glm::dvec3 anchor{0.0};             ///< Embree's origin there
  double scale = 1.0;                 ///< Embree's units per world unit, a power of two
  double least_distance = 0.0;        ///< from the anchor, that rounding counts for

  [[nodiscard]] double set_back(std::uint32_t triangle) const {
    return mesh->set_backs.empty() ? 0.0 : scale * mesh->set_backs[triangle];
  }
};

/// A ray, and what it has met so far.
struct EmbreeScene::Query : EmbreeContext {
  Query(glm::dvec3 from, glm::dvec3 towards) : start(from), direction(towards) {
    init_context(*this);
  }

  glm::dvec3 start;  ///< relative to the eye, in Embree's unit
  glm::dvec3 direction;
  double entry = 0.0;  ///< depth at which it enters the mesh's box, Embree's unit
  std::optional<Hit> nearest;
  double counted = 0.0;             ///< its depth, set back
  std::vector<Hit>* all = nullptr;  ///< takes all of them, instead of the nearest
  bool leaving = false;             ///< none but those that it leaves a body through
};

void EmbreeScene::bound(const RTCBoundsFunctionArguments* asked) {
  const auto& corners = *static_cast<const Corners*>(asked->geometryUserPtr);
  const Triangle& t = corners.mesh->triangles[asked->primID];
  const glm::dvec3 a = corners.positions[t[0]] - corners.anchor;
  const glm::dvec3 b = corners.positions[t[1]] - corners.anchor;
  const glm::dvec3 c = corners.positions[t[2]] - corners.anchor;
  const double slack =
      kSlack * std::max({largest(a), largest(b), largest(c), corners.least_distance});
  const glm::vec3 low(glm::min(glm::min(a, b), c) - slack);
  const glm::vec3 high(glm::max(glm::max(a, b), c) + slack);
  RTCBounds& box = *asked->bounds_o;
  box.lower_x = low.x;
  box.lower_y = low.y;
  box.lower_z = low.z;
  box.upper_x = high.x;
  box.upper_y = high.y;
  box.upper_z = high.z;
}

void EmbreeScene::meet(const RTCIntersectFunctionNArguments* asked) {
  assert(asked->N == 1 && "rays are traced one by one");
  if (asked->valid[0] == 0) return;
  const auto& corners = *static_cast<const Corners*>(asked->geometryUserPtr);
  auto& query = *static_cast<Query*>(asked->context);
  const Triangle& t = corners.mesh->triangles[asked->primID];
  const std::optional<Hit> hit =
      meet_triangle(asked->primID,
                    {corners.positions[t[0]] - query.start, corners.positions[t[1]] - query.start,
                     corners.positions[t[2]] - query.start},
                    query.direction);
  if (!hit) return;
  if (query.leaving && !is_leaving(*corners.mesh, t, query.direction)) return;
  if (query.all != nullptr) {
    query.all->push_back(*hit);
    return;
  }
  const double counted = hit->depth + corners.set_back(hit->triangle);
  if (query.nearest &&
      std::tie(query.counted, query.nearest->triangle) <= std::tie(counted, hit->triangle))
    return;
  query.nearest = hit;
  query.counted = counted;
  // Embree need not look behind it; but what is as near must still be asked about.
  auto* const ray = reinterpret_cast<RTCRayHit*>(asked->rayhit);
  const glm::dvec3 hit_position = query.start + counted * query.direction;
  const double slack =
      kSlack * std::max(largest(hit_position - corners.anchor), corners.least_distance);
  ray->ray.tfar = static_cast<float>(counted - query.entry + slack);
}

void EmbreeScene::attach() {
  const GeometryHandle geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(),
                                   static_cast<unsigned>(corners_->mesh->triangles.size()));
  rtcSetGeometryUserData(geometry.get(), corners_.get());
  rtcSetGeometryBoundsFunction(geometry.get(), bound, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), meet);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
}

Result<EmbreeScene> EmbreeScene::build(const TriangleMesh& mesh, glm::dvec3 eye,
                                       const Progress& progress, RayStarts starts) {
  assert(mesh.triangles.size() < RTC_INVALID_GEOMETRY_ID && "triangles have 32-bit numbers");
  EmbreeScene made;
  made.corners_ = std::make_shared<Corners>();
  Corners& corners = *made.corners_;
  corners.mesh = &mesh;
  const Bounds box = box_about(mesh.positions, eye);
  if (!box.empty()) {
    const glm::dvec3 size = box.max - box.min;
    if (largest(size) > 0.0) corners.scale = std::exp2(-std::ilogb(largest(size)));
    made.box_ = {corners.scale * box.min - kSlack, corners.scale * box.max + kSlack};
    corners.anchor = glm::clamp(glm::dvec3(0.0), made.box_.min, made.box_.max);
    if (starts == RayStarts::Anywhere)
      corners.least_distance = 2.0 * largest(made.box_.max - made.box_.min);
  }
  corners.positions.resize(mesh.positions.size());
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(), [&](std::size_t k) {
    corners.positions[k] = corners.scale * (mesh.positions[k] - eye);
  });
  made.device_.reset(rtcNewDevice(nullptr));
  if (made.device_ == nullptr) return check_device(nullptr, mesh.triangles.size()).error();
  made.scene_.reset(rtcNewScene(made.device_.get()));
  rtcSetSceneFlags(made.scene_.get(), RTC_SCENE_FLAG_ROBUST);  // rounds no box away
  if (!mesh.triangles.empty()) made.attach();
  rtcSetSceneProgressMonitorFunction(
      made.scene_.get(),
      [](void* watched, double /*share*/) {
        return !static_cast<const Progress*>(watched)->cancelled();
      },
      const_cast<Progress*>(&progress));  // NOLINT: Embree hands it back as it got it
  rtcCommitScene(made.scene_.get());
  rtcSetSceneProgressMonitorFunction(made.scene_.get(), nullptr, nullptr);
  RELIEF_TRY(check_device(made.device_.get(), mesh.triangles.size()));
  return made;
}

void EmbreeScene::follow(Query& query) const {
  if (box_.empty()) return;
  // From where the ray enters the box: from a far eye single precision would miss by pixels.
  const std::optional<double> entry = enter(box_, query.start, query.direction);
  if (!entry) return;
  query.entry = *entry;
  const glm::vec3 origin(query.start + *entry * query.direction - corners_->anchor);
  const glm::vec3 along(query.direction);
  RTCRayHit ray{};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.dir_x = along.x;
  ray.ray.dir_y = along.y;
  ray.ray.dir_z = along.z;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(scene_.get(), query, ray);
}

std::optional<Hit> EmbreeScene::find_nearest(const SightRay& ray) const {
  return find_first(ray, false);
}

std::optional<Hit> EmbreeScene::find_leaving(const SightRay& ray) const {
  return find_first(ray, true);
}

std::optional<Hit> EmbreeScene::find_first(const SightRay& ray, bool leaving) const {
  const double length = glm::length(ray.direction);
  Query query(corners_->scale * ray.start, ray.direction / length);
  query.leaving = leaving;
  follow(query);
  if (query.nearest) query.nearest->depth /= corners_->scale * length;
  return query.nearest;
}

void EmbreeScene::find_all(const SightRay& ray, std::vector<Hit>& hits) const {
  hits.clear();
  const double length = glm::length(ray.direction);
  Query query(corners_->scale * ray.start, ray.direction / length);
  query.all = &hits;
  follow(query);
  for (Hit& hit : hits) hit.depth /= corners_->scale * length;
}

std::string EmbreeScene::name() const {
  const auto part = [this](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device_.get(), property);
  };
  return fmt::format("Embree {}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

}  // namespace relief::raytrace
