#include "viewer/drawing/looks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relief {
namespace {

std::vector<Pane> panes_of(const Looks& looks, std::uint32_t width, std::uint32_t height) {
  const auto pane = [&](const RenderSettings& settings, std::uint32_t left, std::uint32_t right) {
    Pane made{settings, {left, 0, right - left, height}};
    made.settings.width = width;
    made.settings.height = height;
    return made;
  };
  const auto cut =
      looks.second
          ? static_cast<std::uint32_t>(std::lround(std::clamp(looks.divider, 0.0, 1.0) * width))
          : width;
  std::vector<Pane> panes;
  if (cut > 0) panes.push_back(pane(looks.first, 0, cut));
  if (cut < width) panes.push_back(pane(*looks.second, cut, width));
  return panes;
}

std::uint32_t scaled(std::uint32_t side, double scale) {
  return std::max(1U, static_cast<std::uint32_t>(std::lround(side * scale)));
}

}  // namespace

std::vector<RenderSettings> list_of(const Looks& looks) {
  std::vector<RenderSettings> list{looks.first};
  if (looks.second) list.push_back(*looks.second);
  return list;
}

std::vector<Pane> panes_of(const Looks& looks, int samples) {
  std::vector<Pane> panes = panes_of(looks, looks.first.width, looks.first.height);
  for (Pane& pane : panes) pane.settings.samples = std::min(pane.settings.samples, samples);
  return panes;
}

int most_samples(const Looks& looks) {
  return std::max(looks.first.samples, looks.second ? looks.second->samples : 1);
}

std::vector<Pane> panes_of(const Looks& looks, const Quality& quality) {
  std::vector<Pane> panes = panes_of(looks, scaled(looks.first.width, quality.scale),
                                     scaled(looks.first.height, quality.scale));
  for (Pane& pane : panes) {
    pane.settings.samples = 1;
    // Where levels of detail are off, they stay off at full size only.
    const double own = pixels_per_sample_of(pane.settings);
    pane.settings.pixels_per_sample = std::max(own, quality.pixels_per_sample);
    pane.settings.afar_factor = quality.afar_factor;
  }
  return panes;
}

std::vector<RenderSettings> list_of(const Looks& looks, const Quality& quality) {
  std::vector<RenderSettings> list;
  for (Pane& pane : panes_of(looks, quality)) list.push_back(std::move(pane.settings));
  return list;
}

}  // namespace relief
