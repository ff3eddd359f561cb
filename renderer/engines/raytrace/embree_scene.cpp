#include "renderer/engines/raytrace/embree_scene.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace relief::raytrace {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// What a ray has met so far.
struct Query : EmbreeContext {
  float distance = kFar;
  std::uint32_t triangle = RTC_INVALID_GEOMETRY_ID;
  std::vector<Candidate>* all = nullptr;  ///< takes all of them, instead of the nearest
};

/// Embree asks this about each triangle that is no farther than the nearest so far. Of two at the
/// same distance it would take the one that its hierarchy has last, which depends on the number of
/// threads that built it.
void keep_or_reject(const RTCFilterFunctionNArguments* met) {
  assert(met->N == 1 && "rays are traced one by one");
  if (met->valid[0] == 0) return;
  auto& query = *static_cast<Query*>(met->context);
  const std::uint32_t triangle = RTCHitN_primID(met->hit, 1, 0);
  if (query.all != nullptr) {
    query.all->push_back({triangle, RTCHitN_u(met->hit, 1, 0), RTCHitN_v(met->hit, 1, 0)});
    met->valid[0] = 0;
    return;
  }
  const float distance = RTCRayN_tfar(met->ray, 1, 0);
  if (distance == query.distance && triangle > query.triangle) {
    met->valid[0] = 0;
    return;
  }
  query.distance = distance;
  query.triangle = triangle;
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

/// How far along `direction` from 0 a box begins, in lengths of it; nothing if it is not there.
std::optional<double> enter(const Bounds& box, glm::dvec3 direction) {
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

Status EmbreeScene::attach(const TriangleMesh& mesh, glm::dvec3 eye) {
  const GeometryHandle geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* const positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), mesh.positions.size()));
  auto* const corners = static_cast<Triangle*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(Triangle), mesh.triangles.size()));
  if (positions == nullptr || corners == nullptr)
    return check_device(device_.get(), mesh.triangles.size());
  // Embree itself leaves out triangles with a corner that is no number.
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(), [&](std::size_t k) {
    positions[k] = glm::vec3(scale_ * (mesh.positions[k] - eye - anchor_));
  });
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), corners);
  rtcSetGeometryIntersectFilterFunction(geometry.get(), keep_or_reject);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  return {};
}

Result<EmbreeScene> EmbreeScene::build(const TriangleMesh& mesh, glm::dvec3 eye,
                                       const Progress& progress) {
  EmbreeScene made;
  made.box_ = box_about(mesh.positions, eye);
  if (!made.box_.empty()) {
    made.anchor_ = glm::clamp(glm::dvec3(0.0), made.box_.min, made.box_.max);
    const glm::dvec3 size = made.box_.max - made.box_.min;
    const double largest = std::max({size.x, size.y, size.z});
    if (largest > 0.0) made.scale_ = std::exp2(-std::ilogb(largest));
    // Rounding must not move what lies in the box's sides out of it.
    made.box_.min -= 1e-6 * largest;
    made.box_.max += 1e-6 * largest;
  }
  made.device_.reset(rtcNewDevice(nullptr));
  if (made.device_ == nullptr) return check_device(nullptr, mesh.triangles.size()).error();
  made.scene_.reset(rtcNewScene(made.device_.get()));
  // Robust: no ray slips through the edge that two triangles share.
  rtcSetSceneFlags(made.scene_.get(), RTC_SCENE_FLAG_ROBUST);
  if (!mesh.triangles.empty()) {
    const Status attached = made.attach(mesh, eye);
    if (!attached) return attached.error();
  }
  rtcSetSceneProgressMonitorFunction(
      made.scene_.get(),
      [](void* watched, double /*share*/) {
        return !static_cast<const Progress*>(watched)->cancelled();
      },
      const_cast<Progress*>(&progress));  // NOLINT: Embree hands it back as it got it
  rtcCommitScene(made.scene_.get());
  rtcSetSceneProgressMonitorFunction(made.scene_.get(), nullptr, nullptr);
  const Status built = check_device(made.device_.get(), mesh.triangles.size());
  if (!built) return built.error();
  return made;
}

std::optional<RTCRayHit> EmbreeScene::start_ray(glm::dvec3 direction) const {
  if (box_.empty()) return std::nullopt;
  // From where the ray enters the box: from a far eye single precision would miss by pixels.
  const std::optional<double> entry = enter(box_, direction);
  if (!entry) return std::nullopt;
  const glm::vec3 origin(scale_ * (*entry * direction - anchor_));
  const glm::vec3 along(glm::normalize(direction));
  RTCRayHit ray{};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.dir_x = along.x;
  ray.ray.dir_y = along.y;
  ray.ray.dir_z = along.z;
  ray.ray.tfar = kFar;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

std::optional<Candidate> EmbreeScene::find_nearest(glm::dvec3 direction) const {
  std::optional<RTCRayHit> ray = start_ray(direction);
  if (!ray) return std::nullopt;
  Query query;
  init_context(query);
  intersect(scene_.get(), query, *ray);
  if (ray->hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Candidate{ray->hit.primID, ray->hit.u, ray->hit.v};
}

void EmbreeScene::find_all(glm::dvec3 direction, std::vector<Candidate>& candidates) const {
  candidates.clear();
  std::optional<RTCRayHit> ray = start_ray(direction);
  if (!ray) return;
  Query query;
  query.all = &candidates;
  init_context(query);
  intersect(scene_.get(), query, *ray);
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
