// Patches that end where others begin: their borders are joined, and nothing else is.
#include "common/seams/make_seams.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>

#include "common/octahedral.h"
#include "common/seams/border_parts.h"
#include "common/seams/planes.h"
#include "common/seams/seam_vertices.h"
#include "common/seams/stitching/fill_loops.h"
#include "common/seams/stitching/front.h"
#include "tests/common/seams/joined_mesh.h"

namespace relief {
namespace {

/// A flat patch of spacing 1 in the plane z = 0 whose first node is at (x, y). `hole`: nodes
/// without a sample.
Patch flat_patch(
    double x, double y, std::uint32_t width, std::uint32_t height,
    const std::function<bool(std::uint32_t, std::uint32_t)>& hole = [](auto, auto) {
      return false;
    }) {
  Patch patch;
  patch.origin = {x, y, 0.0};
  patch.height_step = 0.05;
  patch.width = width;
  patch.height = height;
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i) patch.heights.push_back(hole(i, j) ? kHole : 0);
  }
  patch.normals = {width, height, 1,
                   std::vector<glm::i16vec2>(patch.heights.size(), snorm16_from_unit({0, 0, 1}))};
  return patch;
}

/// Every triangle faces +z, and no edge belongs to two triangles on the same side.
void expect_sheet(const test::JoinedMesh& mesh) {
  for (const Triangle& t : mesh.triangles) EXPECT_GT(mesh.normal_of(t).z, 0.0);
  for (const auto& [edge, count] : mesh.edges()) EXPECT_EQ(count, 1);
}

/// Patches in a chequered field, of which each ends half a step from the next, at an angle.
std::vector<Patch> field_of_patches() {
  std::vector<Patch> patches;
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 12; ++i)
      patches.push_back(flat_patch(10.4 * i + 0.03 * j, 10.3 * j - 0.05 * i, 10, 10));
  }
  return patches;
}

TEST(Seams, AreTheSameOnAnyNumberOfThreads) {
  const std::vector<Patch> patches = field_of_patches();
  const auto on_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_seams(patches).triangles;
  };
  const auto one = on_threads(1);
  EXPECT_EQ(on_threads(2), one);
  EXPECT_EQ(on_threads(4), one);
  // So many candidates wait that rounds are large.
  std::size_t count = 0;
  for (const std::vector<Triangle>& own : one) count += own.size();
  EXPECT_GT(count, 4000U);
  expect_sheet(test::joined_mesh(patches));
}

TEST(Seams, CloseTheGapBetweenTwoPatches) {
  // The second is shifted along the gap, so that no sample faces another.
  for (const double gap : {0.5, 1.0, 1.4, 2.0}) {
    const std::vector<Patch> patches{flat_patch(0, 0, 10, 10), flat_patch(9 + gap, 0.37, 10, 10)};
    const test::JoinedMesh mesh = test::joined_mesh(patches);
    expect_sheet(mesh);
    for (const auto& [from, to] : mesh.open_edges()) {
      const glm::dvec3 middle = 0.5 * (mesh.positions[from] + mesh.positions[to]);
      // What stays open is the outside: left, right, or within one step of the upper and lower end.
      EXPECT_TRUE(middle.x == 0.0 || middle.x == 18 + gap || middle.y < 0.4 || middle.y > 8.9)
          << gap << ": " << middle.x << " " << middle.y;
    }
    // Two squares and the gap between them. At each end a step of 0.37 may be filled, from one
    // sample before the gap to one beyond.
    EXPECT_NEAR(mesh.area(), 2 * 81 + 9 * gap, 0.37 * (gap + 2.0)) << gap;
  }
}

TEST(Seams, ShareAVertexOnEachEdgeBetweenPatches) {
  const std::vector<Patch> patches{flat_patch(0, 0, 4, 4), flat_patch(4.2, 0, 4, 4),
                                   flat_patch(0, 4.2, 8, 4)};
  const Seams seams = make_seams(patches);
  std::vector<std::vector<bool>> used(seams.vertices.size(), std::vector<bool>(patches.size()));
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const Triangle& t : seams.triangles[p]) {
      for (const std::uint32_t corner : t) {
        if ((corner & kSeamVertexBit) != 0) used[corner & ~kSeamVertexBit][p] = true;
      }
    }
  }
  int junctions = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    const auto sharing = std::ranges::count(used[v], true);
    EXPECT_GE(sharing, 2) << v;
    EXPECT_TRUE(used[v][seams.vertices[v].patch]) << v;
    junctions += sharing == 3 ? 1 : 0;
  }
  EXPECT_EQ(junctions, 1);
  expect_sheet(test::joined_mesh(patches));
}

TEST(Seams, LeaveWideGapsOpen) {
  const std::vector<Patch> patches{flat_patch(0, 0, 10, 10), flat_patch(9 + 4, 0, 10, 10)};
  EXPECT_TRUE(make_seams(patches).vertices.empty());
  EXPECT_NEAR(test::joined_mesh(patches).area(), 2 * 81, 1e-9);
}

TEST(Seams, LeaveHolesOfAPatchOpen) {
  const auto hole = [](std::uint32_t i, std::uint32_t j) {
    return i >= 4 && i <= 8 && j >= 4 && j <= 8;
  };
  const std::vector<Patch> patches{flat_patch(0, 0, 13, 13, hole)};
  // The hole is 6 x 6 less the halves of its four corner cells, which have three samples.
  EXPECT_NEAR(test::joined_mesh(patches).area(), 144 - 36 + 2, 1e-9);
}

TEST(Seams, FillSlitsWhereCellsAreTooSteep) {
  // A step that grows to 4 spacings and shrinks again; cells rise by 3 at most.
  const std::vector<double> steps{0, 0, 0, 1.5, 3, 4, 4, 4, 3, 1.5, 0, 0, 0};
  Patch patch = flat_patch(0, 0, 13, 13);
  for (std::uint32_t j = 0; j < 13; ++j) {
    for (std::uint32_t i = 6; i < 13; ++i)
      patch.heights[j * 13 + i] = static_cast<std::int32_t>(std::lround(steps[j] / 0.05));
  }
  const auto open_inside = [](const Patch& from) {
    const test::JoinedMesh mesh = test::joined_mesh(std::vector<Patch>{from});
    return std::ranges::count_if(mesh.open_edges(), [&](const auto& edge) {
      const glm::dvec3 middle = 0.5 * (mesh.positions[edge.first] + mesh.positions[edge.second]);
      return middle.x > 0.0 && middle.x < 12.0 && middle.y > 0.0 && middle.y < 12.0;
    });
  };
  EXPECT_EQ(open_inside(patch), 0);
  // A hole of the scan beside it may be its cause.
  patch.heights[6 * 13 + 6] = kHole;
  EXPECT_GT(open_inside(patch), 6);
}

TEST(Seams, LeaveNoHoleInAClosedSurface) {
  const auto hole = [](std::uint32_t i, std::uint32_t j) {
    return i >= 4 && i <= 8 && j >= 4 && j <= 8;
  };
  // Its outside is longer than any loop that is filled.
  const std::vector<Patch> patches{flat_patch(0, 0, 20, 20, hole)};
  const test::JoinedMesh mesh = test::joined_mesh(patches, true);
  expect_sheet(mesh);
  EXPECT_NEAR(mesh.area(), 19 * 19, 1e-9);
}

TEST(Seams, GiveAnIslandNoBack) {
  const std::vector<Patch> patches{flat_patch(0, 0, 20, 20), flat_patch(30, 0, 4, 4)};
  EXPECT_NEAR(test::joined_mesh(patches, true).area(), 19 * 19 + 9, 1e-9);
}

TEST(Seams, DoNotJoinTheTwoSidesOfAThinSheet) {
  Patch below = flat_patch(0, 0, 10, 10);
  below.origin = {9.0, 0.0, -0.4};
  below.axes = {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};  // seen from below
  const std::vector<Patch> patches{flat_patch(0, 0, 10, 10), below};
  EXPECT_TRUE(make_seams(patches).vertices.empty());
}

/// Half a plane that ends at the y axis, from which it leads `inward`, 8 wide and 16 long; grid
/// lines are turned by an angle to that axis.
Patch half_plane(glm::dvec3 inward, glm::dvec3 normal, double degrees) {
  constexpr std::uint32_t kNodes = 30;
  const double angle = glm::radians(degrees);
  const glm::dvec3 u = std::cos(angle) * inward + std::sin(angle) * glm::cross(normal, inward);
  const glm::dmat3 axes(u, glm::cross(normal, u), normal);
  const glm::dvec3 origin = axes * glm::dvec3(-14.7, -14.7, 0.0);
  Patch patch = flat_patch(0, 0, kNodes, kNodes, [&](std::uint32_t i, std::uint32_t j) {
    const glm::dvec3 p = origin + axes * glm::dvec3(i, j, 0.0);
    const double from_edge = glm::dot(p, inward);
    return from_edge < 0.0 || from_edge > 8.0 || std::abs(p.y) > 8.0;
  });
  patch.origin = origin;
  patch.axes = axes;
  return patch;
}

TEST(Seams, AreSharpAtAcuteEdges) {
  for (const double degrees : {100.0, 90.0, 70.5, 60.0, 45.0, 30.0, 20.0}) {
    const double wedge = glm::radians(degrees);
    const glm::dvec3 inward(-std::cos(wedge), 0.0, -std::sin(wedge));
    const glm::dvec3 normal(std::sin(wedge), 0.0, -std::cos(wedge));
    // Grid lines lead to the edge in other steps on its two sides.
    const std::vector<Patch> patches{half_plane({-1, 0, 0}, {0, 0, 1}, 29.0),
                                     half_plane(inward, normal, 11.0)};
    const test::JoinedMesh mesh = test::joined_mesh(patches);
    // Apart from where both end, by a step of their grids.
    const auto is_inside = [](glm::dvec3 p) { return std::abs(p.y) < 6.5 && glm::length(p) < 6.5; };
    double area = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 n = mesh.normal_of(t);
      const glm::dvec3 middle =
          (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
      area += 0.5 * glm::length(n);
      if (is_inside(middle)) {
        EXPECT_GE(std::max(n.z, glm::dot(n, normal)), 0.999 * glm::length(n)) << degrees;
      }
    }
    EXPECT_GT(area, 2 * 7.0 * 14.0) << degrees;
    for (const auto& [from, to] : mesh.open_edges())
      EXPECT_FALSE(is_inside(0.5 * (mesh.positions[from] + mesh.positions[to]))) << degrees;
  }
}

BorderVertex vertex(glm::dvec3 position, glm::dvec3 normal, double bend) {
  return {.position = position, .normal = normal, .plane_normal = normal, .bend = bend};
}

TEST(Seams, MeetOnTheCurveThroughBothSamples) {
  // On a circle of radius 10, one apart: the chord's middle is 0.0125 inside.
  const double angle = 0.05;
  const auto on_circle = [](double a, double bend) {
    const glm::dvec3 n(std::sin(a), 0.0, std::cos(a));
    return vertex(10.0 * n, n, bend);
  };
  const glm::dvec3 middle = seam_position(on_circle(-angle, 0.1), on_circle(angle, 0.1));
  // The cubic is off by the fourth power of the angle.
  EXPECT_NEAR(glm::length(middle), 10.0, 10.0 * std::pow(angle, 4));
}

TEST(Seams, MeetWhereTheTangentPlanesOfACreaseDo) {
  const BorderVertex top = vertex({-0.3, 0.0, 0.0}, {0, 0, 1}, 0.01);
  const BorderVertex side = vertex({0.0, 0.2, -0.5}, {1, 0, 0}, 0.01);
  const glm::dvec3 at = seam_position(top, side);
  EXPECT_NEAR(at.x, 0.0, 1e-12);
  EXPECT_NEAR(at.y, 0.1, 1e-12);
  EXPECT_NEAR(at.z, 0.0, 1e-12);
  // The same turn on a round edge is none.
  BorderVertex round = top;
  round.bend = 0.7;
  EXPECT_LT(seam_position(round, side).z, -0.01);
}

TEST(Seams, MeetAtTheRimOfABore) {
  // Its wall bends along the rim by 0.49 a cell, as a circle of two spacings does.
  const BorderVertex end = vertex({-0.6, 0.0, 0.0}, {0, 0, 1}, 0.01);
  BorderVertex wall = vertex({0.0, 0.0, -0.8}, {1, 0, 0}, 0.49);
  EXPECT_LT(glm::length(seam_position(end, wall)), 1e-12);
  // A sample whose own normal is 15 degrees off its plane is on a round edge.
  const double angle = glm::radians(15.0);
  wall.normal = {std::cos(angle), 0.0, std::sin(angle)};
  EXPECT_GT(glm::length(seam_position(end, wall)), 0.1);
}

TEST(Planes, MeetInALineAndInACorner) {
  const Plane x{{1, 5, 5}, {1, 0, 0}};
  const Plane y{{7, 2, 7}, {0, 1, 0}};
  const Plane z{{9, 9, 3}, {0, 0, 1}};
  const glm::dvec3 from(0.5, 0.25, 0.125);
  EXPECT_LT(glm::distance(from + to_crease(x, y, from), glm::dvec3(1, 2, 0.125)), 1e-15);
  EXPECT_LT(glm::distance(from + to_corner(x, y, z, from), glm::dvec3(1, 2, 3)), 1e-15);
  EXPECT_EQ(volume_of(x, y, z), 1.0);
  // Askew: on both, and straight across their line.
  const Plane askew{{1, 0, 0}, glm::normalize(glm::dvec3(1, 1, 0))};
  const glm::dvec3 way = to_crease(x, askew, from);
  EXPECT_LT(std::abs(x.above(from + way)), 1e-15);
  EXPECT_LT(std::abs(askew.above(from + way)), 1e-15);
  EXPECT_EQ(way.z, 0.0);
  EXPECT_LT(glm::distance(mean(x, y).normal, glm::normalize(glm::dvec3(1, 1, 0))), 1e-15);
}

TEST(Seams, FillALoopWithADentWithoutFoldingOver) {
  // The roundest ear, at the tip, covers the dent.
  BorderMesh mesh;
  for (const glm::dvec3 p : {glm::dvec3(0, 3, 0), {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}})
    mesh.vertices.push_back(vertex(p, {0, 0, 1}, 0.0));
  for (std::uint32_t v = 0; v < 4; ++v) mesh.edges.push_back({v, (v + 1) % 4, {0, 0, 1}});
  Front front(mesh);
  fill_loops(front, false);
  const std::vector<Triangle> triangles = front.take();
  ASSERT_EQ(triangles.size(), 2U);
  for (const Triangle& t : triangles) {
    const TriangleShape shape = shape_of(mesh.vertices[t[0]].position, mesh.vertices[t[1]].position,
                                         mesh.vertices[t[2]].position);
    EXPECT_NEAR(shape.normal.z, -1.0, 1e-9);  // shape_of: of the corners in the opposite order
    EXPECT_NEAR(shape.area, 2.0, 1e-9);
  }
}

/// A square whose triangles, had it any, would be inside it: the outside of an island.
BorderMesh outside_of_square() {
  BorderMesh mesh;
  for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
    mesh.vertices.push_back(vertex(p, {0, 0, 1}, 0.0));
  for (std::uint32_t v = 0; v < 4; ++v) mesh.edges.push_back({v, (v + 1) % 4, {0, 0, 1}});
  return mesh;
}

TEST(Seams, FillWhatFacesInwardIfCellsConnectItToTheRest) {
  BorderMesh mesh = outside_of_square();
  for (int k = 0; k < 40; ++k) mesh.vertices.push_back(vertex({2.0, k, 0}, {0, 0, 1}, 0.0));
  Front island(mesh);
  fill_loops(island, true);
  EXPECT_TRUE(island.triangles().empty());
  mesh.parts.assign(mesh.vertices.size(), 0);
  Front joined(mesh);
  fill_loops(joined, true);
  EXPECT_EQ(joined.triangles().size(), 2U);
}

TEST(Seams, KnowWhichBordersCellsConnect) {
  // The first has an inner and an outer border, the second two pieces.
  const std::vector<Patch> patches{
      flat_patch(0, 0, 9, 9, [](auto i, auto j) { return i == 4 && j == 4; }),
      flat_patch(20, 0, 9, 9, [](auto i, auto /*j*/) { return i == 4; })};
  const std::vector<CellTriangles> cells = cell_triangles(std::span<const Patch>(patches));
  BorderMesh mesh = find_borders(patches, cells);
  find_parts(patches, cells, mesh);
  ASSERT_EQ(mesh.parts.size(), mesh.vertices.size());
  std::map<double, std::uint32_t> first_of_piece;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const double x = mesh.vertices[v].position.x;
    const double piece = x < 10.0 ? 0.0 : x < 24.0 ? 1.0 : 2.0;
    const auto [known, added] = first_of_piece.emplace(piece, v);
    EXPECT_EQ(mesh.parts[v], known->second) << v;
  }
  EXPECT_EQ(first_of_piece.size(), 3U);
}

TEST(Seams, FillThreeVerticesOnALine) {
  BorderMesh mesh;
  for (const double x : {0.0, 2.0, 1.0}) mesh.vertices.push_back(vertex({x, 0, 0}, {0, 0, 1}, 0.0));
  for (std::uint32_t v = 0; v < 3; ++v) mesh.edges.push_back({v, (v + 1) % 3, {0, 0, 1}});
  Front front(mesh);
  fill_loops(front, true);
  EXPECT_EQ(front.triangles().size(), 1U);
  for (Front::Vertex v = 0; v < 3; ++v) EXPECT_TRUE(front.at(v).empty());
}

TEST(Seams, AreDefinedForAnyPatches) {
  Patch upside_down = flat_patch(0, 0, 5, 5);
  upside_down.origin = {4.0, 0.0, 0.0};
  upside_down.axes = {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  Patch jagged = flat_patch(5.1, 0, 9, 9, [](auto i, auto j) { return (i * 7 + j * 3) % 5 == 0; });
  for (std::size_t k = 0; k < jagged.heights.size(); ++k) {
    if (jagged.heights[k] != kHole) jagged.heights[k] = static_cast<std::int32_t>(k * 37 % 90);
  }
  Patch without_normals = flat_patch(0, 5.2, 6, 3);
  without_normals.normals = {};
  const auto all_holes = [](auto, auto) { return true; };
  const std::vector<Patch> patches{flat_patch(0, 0, 5, 5),
                                   flat_patch(0, 0, 5, 5),
                                   upside_down,
                                   jagged,
                                   flat_patch(14.5, 3, 1, 1),
                                   flat_patch(0, 0, 3, 3, all_holes),
                                   without_normals,
                                   flat_patch(-1.2, 0, 1, 7)};
  const test::JoinedMesh mesh = test::joined_mesh(patches);
  for (const glm::dvec3& p : mesh.positions)
    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const auto& [edge, count] : mesh.edges()) EXPECT_EQ(count, 1);
  EXPECT_TRUE(make_seams({}).vertices.empty());
}

}  // namespace
}  // namespace relief
