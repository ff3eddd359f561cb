// Embree 3 or 4, whichever is there (Debian 12 has 3, Debian 13 has 4): what differs between them,
// and what releases their handles.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <memory>

namespace relief::raytrace {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
inline void init_context(EmbreeContext& context) {
  rtcInitRayQueryContext(&context);
}
inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
#else
using EmbreeContext = RTCIntersectContext;
inline void init_context(EmbreeContext& context) {
  rtcInitIntersectContext(&context);
}
inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}
#endif

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, ReleaseEmbree>;
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;
using GeometryHandle = std::unique_ptr<RTCGeometryTy, ReleaseEmbree>;

}  // namespace relief::raytrace
