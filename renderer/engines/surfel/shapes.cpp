#include "renderer/engines/surfel/shapes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>

#include "shaders/surfel/layout.h"

namespace relief::surfel {
namespace {

/// So much larger than the disc that no pixel of it misses the polygon for rounding.
constexpr double kSlack = 1.001;

/// Surfels that one call draws: their elements take 16 KB times the triangles of one.
constexpr std::uint32_t kSurfelsPerDraw = 4096;

/// The corners of the regular polygon about a disc. The first lies on the first axis.
std::vector<glm::vec2> ring(int sides, double radius) {
  std::vector<glm::vec2> corners;
  const double reach = kSlack * radius / std::cos(std::numbers::pi / sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    corners.emplace_back(reach * std::cos(angle), reach * std::sin(angle));
  }
  return corners;
}

std::uint32_t bits_for(std::size_t corners) {
  return static_cast<std::uint32_t>(std::bit_width(corners - 1));
}

/// The elements of kSurfelsPerDraw surfels, of which each has 2^bits numbers.
std::vector<std::uint32_t> repeated(const ShapeOutline& outline, std::uint32_t bits) {
  std::vector<std::uint32_t> elements;
  elements.reserve(outline.triangles.size() * kSurfelsPerDraw);
  for (std::uint32_t surfel = 0; surfel < kSurfelsPerDraw; ++surfel) {
    for (const std::uint16_t corner : outline.triangles)
      elements.push_back((surfel << bits) + corner);
  }
  return elements;
}

}  // namespace

ShapeOutline polygon_outline(int sides) {
  ShapeOutline outline{ring(sides, 1.0), {}};
  for (int k = 1; k + 1 < sides; ++k) {
    for (const int corner : {0, k, k + 1})
      outline.triangles.push_back(static_cast<std::uint16_t>(corner));
  }
  return outline;
}

// The shape is its own mirror image about both axes: a quad's diagonal depends on its quadrant. So
// a mirrored scan looks mirrored.
ShapeOutline curved_outline() {
  static_assert(kCurvedSides % 4 == 0, "quads lie in one quadrant each");
  ShapeOutline outline{{glm::vec2(0.0F)}, {}};
  const auto add = [&outline](std::initializer_list<int> corners) {
    for (const int corner : corners)
      outline.triangles.push_back(static_cast<std::uint16_t>(corner));
  };
  for (int r = 1; r <= kCurvedRings; ++r) {
    const auto corners = ring(kCurvedSides, static_cast<double>(r) / kCurvedRings);
    outline.corners.insert(outline.corners.end(), corners.begin(), corners.end());
    const int outer = 1 + (r - 1) * kCurvedSides;
    const int inner = outer - kCurvedSides;
    for (int k = 0; k < kCurvedSides; ++k) {
      const int next = (k + 1) % kCurvedSides;
      const bool even_quadrant = (4 * k / kCurvedSides) % 2 == 0;
      if (r == 1) {
        add({0, outer + k, outer + next});
      } else if (even_quadrant) {
        add({inner + k, outer + k, outer + next, inner + k, outer + next, inner + next});
      } else {
        add({inner + k, outer + k, inner + next, outer + k, outer + next, inner + next});
      }
    }
  }
  return outline;
}

Shape::Shape(const Gl& gl, const ShapeOutline& outline)
    : gl_(&gl),
      corners_(
          make_table(gl, "surfel corners", GL_RG32F, std::span<const glm::vec2>(outline.corners))),
      elements_(gl, "surfel elements"),
      vertices_(gl, "surfels"),
      surfel_indices_(static_cast<std::uint32_t>(outline.triangles.size())) {
  if (outline.corners.size() == 3) return;
  corner_bits_ = bits_for(outline.corners.size());
  per_draw_ = kSurfelsPerDraw;
  const std::vector<std::uint32_t> elements = repeated(outline, corner_bits_);
  elements_ = make_buffer(gl, "surfel elements", std::span<const std::uint32_t>(elements));
  gl.VertexArrayElementBuffer(vertices_.id(), elements_.id());
}

void Shape::draw(const Program& program, std::uint32_t first, std::uint32_t count) const {
  if (count == 0) return;
  gl_->UseProgram(program.id());
  gl_->BindVertexArray(vertices_.id());
  gl_->BindTextureUnit(RELIEF_SURFEL_TEXTURE_CORNERS, corners_.texture.id());
  gl_->ProgramUniform1i(program.id(), RELIEF_SURFEL_UNIFORM_CORNER_BITS,
                        static_cast<GLint>(corner_bits_));
  const auto begin_at = [&](std::uint32_t at) {
    gl_->ProgramUniform1i(program.id(), RELIEF_SURFEL_UNIFORM_FIRST, static_cast<GLint>(at));
  };
  if (per_draw_ == 0) {
    begin_at(first);
    gl_->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * count));
    return;
  }
  for (std::uint32_t done = 0; done < count; done += per_draw_) {
    begin_at(first + done);
    const std::uint32_t now = std::min(per_draw_, count - done);
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(now * surfel_indices_), GL_UNSIGNED_INT,
                      nullptr);
  }
}

}  // namespace relief::surfel
