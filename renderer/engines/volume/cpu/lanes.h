// Floats that are computed together: vectors of GCC and Clang, which become registers. Loops over
// plain floats were left scalar.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

// GCC makes a function for AVX2 and FMA, whose registers hold eight floats, and one for other
// processors, which take two registers. Clang passes eight to no function that may not be for AVX2.
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__)
#define RELIEF_FOR_EACH_CPU __attribute__((target_clones("arch=x86-64-v3", "default")))
#define RELIEF_LANES 8
// All is inlined: how lanes would be returned does not matter. Parameters are references, because
// GCC has a note about others that nothing silences but an option of its own.
#pragma GCC diagnostic ignored "-Wpsabi"
#else
#define RELIEF_FOR_EACH_CPU
#define RELIEF_LANES 4
#endif
#define RELIEF_INLINED __attribute__((always_inline))
#define RELIEF_IN_LANES [[nodiscard, gnu::always_inline]] inline

namespace relief::volume::cpu {

inline constexpr int kLanes = RELIEF_LANES;
using Floats = float __attribute__((vector_size(4 * RELIEF_LANES)));
using Ints = std::int32_t __attribute__((vector_size(4 * RELIEF_LANES)));

RELIEF_IN_LANES Floats all_of(float value) {
  return Floats{} + value;
}

RELIEF_IN_LANES Floats load(const float* from) {
  Floats lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

[[gnu::always_inline]] inline void store(const Floats& lanes, float* to) {
  std::memcpy(to, &lanes, sizeof(lanes));
}

[[gnu::always_inline]] inline void add_to(float* sums, const Floats& more) {
  store(load(sums) + more, sums);
}

/// `yes` where a comparison holds, 0 elsewhere.
RELIEF_IN_LANES Floats where(const Ints& holds, const Floats& yes) {
  return reinterpret_cast<Floats>(holds & reinterpret_cast<Ints>(yes));
}

RELIEF_IN_LANES Floats root_of(const Floats& squares) {
  Floats roots;
  for (int i = 0; i < kLanes; ++i) roots[i] = std::sqrt(squares[i]);
  return roots;
}

/// 0, 1, 2, ...
RELIEF_IN_LANES Floats steps() {
  Floats steps;
  for (int i = 0; i < kLanes; ++i) steps[i] = static_cast<float>(i);
  return steps;
}

RELIEF_IN_LANES Floats larger(const Floats& a, const Floats& b) {
  return a > b ? a : b;
}

RELIEF_IN_LANES Floats smaller(const Floats& a, const Floats& b) {
  return a < b ? a : b;
}

/// 2^e is a normal number from there on.
inline constexpr float kLeastExponent = -126.0F;

/// 2^e for -126 <= e <= 126, to 3e-7 of it.
RELIEF_IN_LANES Floats exp2_of(const Floats& e) {
  const Ints biased = __builtin_convertvector(e + 127.5F, Ints);
  const Floats f = e - __builtin_convertvector(biased - 127, Floats);  // between -0.5 and 0.5
  Floats p = f * 1.3333558e-3F + 9.6181291e-3F;
  p = p * f + 5.5504109e-2F;
  p = p * f + 2.4022651e-1F;
  p = p * f + 6.9314718e-1F;
  p = p * f + 1.0F;
  return p * reinterpret_cast<Floats>(biased << 23);
}

/// The share of a normal distribution of deviation 1 that lies below x [Abramowitz and Stegun
/// 26.2.17], to 4e-7.
RELIEF_IN_LANES Floats normal_distribution(const Floats& x) {
  constexpr float kHalfLog2E = 0.72134752F;
  const Floats a = smaller(larger(x, -x), all_of(12.0F));
  const Floats t = 1.0F / (1.0F + 0.2316419F * a);
  Floats p = t * 1.330274429F - 1.821255978F;
  p = p * t + 1.781477937F;
  p = p * t - 0.356563782F;
  p = p * t + 0.319381530F;
  const Floats tail = exp2_of(-kHalfLog2E * a * a) * 0.3989422804F * t * p;
  return x < 0.0F ? tail : 1.0F - tail;
}

}  // namespace relief::volume::cpu
