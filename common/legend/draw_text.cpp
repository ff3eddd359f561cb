#include "common/legend/draw_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

namespace relief {
namespace {

#include "common/legend/glyph_outlines.inc"

constexpr double kUnitsPerEm = 2048.0;
constexpr char kFirst = ' ';
constexpr char kLast = '~';
constexpr std::size_t kCharacters = kLast - kFirst + 1;

/// A character's numbers in kGlyphs.
struct Glyph {
  double advance = 0.0;  ///< units
  std::vector<std::vector<glm::dvec2>> contours;
};

std::array<Glyph, kCharacters> unpack_glyphs() {
  std::array<Glyph, kCharacters> glyphs;
  const std::int16_t* next = std::begin(kGlyphs);
  for (Glyph& glyph : glyphs) {
    glyph.advance = *next++;
    glyph.contours.resize(static_cast<std::size_t>(*next++));
    for (auto& contour : glyph.contours) {
      contour.resize(static_cast<std::size_t>(*next++));
      for (glm::dvec2& point : contour) {
        point = {next[0], next[1]};
        next += 2;
      }
    }
  }
  assert(next == std::end(kGlyphs) && "the table ends with its last character");
  return glyphs;
}

const Glyph& glyph_of(char c) {
  static const std::array<Glyph, kCharacters> glyphs = unpack_glyphs();
  const char shown = c >= kFirst && c <= kLast ? c : '?';
  return glyphs[static_cast<std::size_t>(shown - kFirst)];
}

/// Where a line enters and leaves a glyph, from left to right: x and the direction of the outline.
using Crossings = std::vector<std::pair<double, int>>;

/// Finds the crossings of row `y` with outlines whose y points down.
void find_crossings(std::span<const std::vector<glm::dvec2>> contours, double y,
                    Crossings& crossings) {
  crossings.clear();
  for (const auto& contour : contours) {
    for (std::size_t k = 0; k < contour.size(); ++k) {
      const glm::dvec2 a = contour[k];
      const glm::dvec2 b = contour[(k + 1) % contour.size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      crossings.emplace_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), a.y < b.y ? 1 : -1);
    }
  }
  std::sort(crossings.begin(), crossings.end());
}

/// The share of pixel `x` that lies between two positions.
float share_of(double x, double left, double right) {
  return static_cast<float>(std::clamp(std::min(x + 1.0, right) - std::max(x, left), 0.0, 1.0));
}

float* channel_of(Image& image, std::string_view name) {
  const auto found = std::ranges::find(image.channels, name, &Channel::name);
  return found == image.channels.end() ? nullptr : found->values.data();
}

/// Pixels that a range touches, within an image.
std::pair<std::size_t, std::size_t> pixels_of(double from, double to, std::uint32_t size) {
  const double most = size;
  return {static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, most)),
          static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, most))};
}

}  // namespace

Painter::Painter(Image& image)
    : image_(image),
      red_(channel_of(image, "R")),
      green_(channel_of(image, "G")),
      blue_(channel_of(image, "B")),
      alpha_(channel_of(image, "A")) {
  assert(red_ != nullptr && green_ != nullptr && blue_ != nullptr && "an image of colours");
}

void Painter::blend(std::size_t pixel, glm::vec3 colour, float opacity) {
  red_[pixel] += opacity * (colour.r - red_[pixel]);
  green_[pixel] += opacity * (colour.g - green_[pixel]);
  blue_[pixel] += opacity * (colour.b - blue_[pixel]);
  if (alpha_ != nullptr) alpha_[pixel] += opacity * (1.0F - alpha_[pixel]);
}

void Painter::fill(double left, double top, double right, double bottom, glm::vec3 colour,
                   float opacity) {
  const auto [x0, x1] = pixels_of(left, right, image_.width);
  const auto [y0, y1] = pixels_of(top, bottom, image_.height);
  for (std::size_t y = y0; y < y1; ++y) {
    const float row = opacity * share_of(static_cast<double>(y), top, bottom);
    for (std::size_t x = x0; x < x1; ++x)
      blend(y * image_.width + x, colour, row * share_of(static_cast<double>(x), left, right));
  }
}

void Painter::text(std::string_view text, double x, double y, double size, glm::vec3 colour) {
  constexpr int kRows = 5;  // of a pixel; within a row shares are exact
  const double unit = size / kUnitsPerEm;
  Crossings crossings;
  for (const char c : text) {
    const Glyph& glyph = glyph_of(c);
    std::vector<std::vector<glm::dvec2>> contours = glyph.contours;
    for (auto& contour : contours) {
      for (glm::dvec2& point : contour) point = {x + unit * point.x, y - unit * point.y};
    }
    // Descenders and ascenders reach at most so far.
    const auto [y0, y1] = pixels_of(y - 1.2 * size, y + 0.5 * size, image_.height);
    const auto [x0, x1] =
        pixels_of(x - 0.5 * size, x + unit * glyph.advance + 0.5 * size, image_.width);
    std::vector<float> shares(x1 - x0);
    for (std::size_t row = y0; row < y1; ++row) {
      std::ranges::fill(shares, 0.0F);
      for (int part = 0; part < kRows; ++part) {
        find_crossings(contours, static_cast<double>(row) + (part + 0.5) / kRows, crossings);
        int winding = 0;
        for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
          winding += crossings[k].second;
          if (winding == 0) continue;
          for (std::size_t i = 0; i < shares.size(); ++i) {
            shares[i] +=
                share_of(static_cast<double>(x0 + i), crossings[k].first, crossings[k + 1].first) /
                kRows;
          }
        }
      }
      for (std::size_t i = 0; i < shares.size(); ++i) {
        if (shares[i] > 0.0F) blend(row * image_.width + x0 + i, colour, std::min(shares[i], 1.0F));
      }
    }
    x += unit * glyph.advance;
  }
}

double text_width(std::string_view text) {
  double units = 0.0;
  for (const char c : text) units += glyph_of(c).advance;
  return units / kUnitsPerEm;
}

}  // namespace relief
