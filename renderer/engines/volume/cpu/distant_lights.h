// Shading of kLanes kernels at once.
#pragma once

#include "renderer/engines/volume/cpu/lanes.h"
#include "shaders/include/shared.h"

namespace relief::volume::cpu {

/// kLanes vectors.
struct Vectors {
  Floats x, y, z;
};

RELIEF_IN_LANES Floats dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a + s * b
RELIEF_IN_LANES Vectors moved(const Vectors& a, const Floats& s, const Vectors& b) {
  return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// As shared::highlight().
RELIEF_IN_LANES Floats highlight(const Floats& x) {
  const Floats x2 = x * x;
  const Floats x4 = x2 * x2;
  const Floats x8 = x4 * x4;
  const Floats x16 = x8 * x8;
  return x16 * x16 * x8;
}

/// As shared::facing_normal(), of kernels, which have no back.
RELIEF_IN_LANES Vectors facing_normal(const Vectors& normal, const Vectors& ray) {
  const Floats away = dot(normal, ray);
  const Floats sign = away > shared::kBackSide ? all_of(-1.0F) : all_of(1.0F);
  const Floats bend = where(away * sign > 0.0F, away);
  const Vectors bent = moved(normal, -bend, ray);
  const Floats scale = sign / root_of(dot(bent, bent));
  return {scale * bent.x, scale * bent.y, scale * bent.z};
}

/// As shared::lit(), where no light is a point. Nothing is lit whose normal is 0.
RELIEF_IN_LANES Vectors lit(const shared::Frame& frame, int lights, const Vectors& albedo,
                            const Vectors& normal, const Vectors& ray) {
  const Vectors facing = facing_normal(normal, ray);
  const Vectors reflected = moved(ray, -2.0F * dot(facing, ray), facing);
  const glm::vec4& ambient = frame.light_ambient;
  Vectors diffuse{all_of(ambient.x), all_of(ambient.y), all_of(ambient.z)};
  Vectors specular{};
  for (int i = 0; i < lights; ++i) {
    const glm::vec4& toward = frame.light_position[i];
    const glm::vec4& from = frame.light_colour[i];
    const Vectors direction{all_of(toward.x), all_of(toward.y), all_of(toward.z)};
    const Vectors colour{all_of(from.x), all_of(from.y), all_of(from.z)};
    const Floats nothing{};
    diffuse = moved(diffuse, larger(dot(facing, direction), nothing), colour);
    specular = moved(specular, highlight(larger(dot(reflected, direction), nothing)), colour);
  }
  const Ints has_none = dot(normal, normal) == 0.0F;
  const auto channel = [&](const Floats& own, const Floats& d, const Floats& s)
                           RELIEF_INLINED { return has_none ? own : own * d + ambient.w * s; };
  return {channel(albedo.x, diffuse.x, specular.x), channel(albedo.y, diffuse.y, specular.y),
          channel(albedo.z, diffuse.z, specular.z)};
}

}  // namespace relief::volume::cpu
