#include "renderer/render.h"

#include <cassert>
#include <memory>
#include <utility>
#include <vector>

#include "common/transform.h"
#include "renderer/engines/ewa/render_ewa.h"
#include "renderer/engines/ewa/splats_of_samples.h"
#include "renderer/engines/multipass/render_multipass.h"
#include "renderer/engines/onepass/render_onepass.h"
#include "renderer/engines/raytrace/render_raytrace.h"
#include "renderer/geometry/mesh_of_patches.h"
#include "renderer/gl/open_gl.h"
#include "renderer/prepared.h"
#include "renderer/shading/materials.h"
#include "renderer/shading/split_view.h"

namespace relief {
namespace {

/// The views of one engine.
struct EngineViews {
  EngineKind engine = EngineKind::Onepass;
  std::vector<RenderSettings> settings;
  std::vector<std::size_t> places;  ///< in the list of all views
};

std::vector<EngineViews> group_by_engine(std::span<const RenderSettings> views) {
  std::vector<EngineViews> groups;
  for (const EngineKind engine :
       {EngineKind::Onepass, EngineKind::Multipass, EngineKind::Ewa, EngineKind::Raytrace}) {
    EngineViews group{engine, {}, {}};
    for (std::size_t place = 0; place < views.size(); ++place) {
      if (views[place].engine != engine) continue;
      group.settings.push_back(views[place]);
      group.places.push_back(place);
    }
    if (!group.places.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

/// Splats of one surface overlap, so that only cells can be blended once.
Status check_opacity(const RenderSettings& settings) {
  const bool cells =
      settings.engine == EngineKind::Onepass && settings.primitive == Primitive::Cell;
  const bool on_gpu =
      settings.engine == EngineKind::Onepass || settings.engine == EngineKind::Multipass;
  if (on_gpu && !cells && is_transparent(settings)) {
    return make_error(
        "a material's opacity is below 1, which engine onepass with primitive cell, engine ewa "
        "and engine raytrace draw; choose one of them");
  }
  return {};
}

/// What leaves a body is known where one surface of it is in front and one behind.
Status check_interfaces(const RenderSettings& settings) {
  if (!has_two_interfaces(settings)) return {};
  const bool cells =
      settings.engine == EngineKind::Onepass && settings.primitive == Primitive::Cell;
  if (!cells && settings.engine != EngineKind::Raytrace) {
    return make_error(
        "a glass has two interfaces, which engine onepass with primitive cell and engine raytrace "
        "draw; choose one of them, or one interface");
  }
  if (is_transparent(settings)) {
    return make_error(
        "glass with two interfaces and a material whose opacity is below 1 can't be in one "
        "picture; choose one interface, or an opacity of 1");
  }
  return {};
}

/// An engine on OpenGL, in a context of its own.
Result<std::unique_ptr<PreparedModel>> prepare_on_opengl(const RenderModel& model,
                                                         const EngineViews& views) {
  assert(model.patches != nullptr && "the engines on OpenGL draw patches");
  const RenderSettings& first = views.settings.front();
  for (const RenderSettings& settings : views.settings)
    assert(settings.platform == first.platform && settings.debug == first.debug &&
           settings.explain == first.explain);
  auto opengl = OpenGl::create(first.platform, first.debug, first.explain);
  if (!opengl) return opengl.error();
  auto prepared = views.engine == EngineKind::Onepass
                      ? onepass::prepare(std::move(*opengl), *model.patches, views.settings)
                      : multipass::prepare(std::move(*opengl), *model.patches, views.settings);
  if (!prepared) return prepared.error();
  return std::unique_ptr<PreparedModel>(std::move(*prepared));
}

/// Rays' triangles of patches, each in each of its places.
Result<TriangleMesh> triangulate(const PatchModel& patches) {
  if (patches.placements.empty()) return mesh_of_patches(patches);
  auto mesh = mesh_of_patches(bake(patches));
  if (mesh) mesh->bodies = bodies_of(patches);
  return mesh;
}

/// Their samples as splats.
SplatCloud splat(const PatchModel& patches) {
  return patches.placements.empty() ? ewa::splats_of_samples(patches)
                                    : ewa::splats_of_samples(bake(patches));
}

Result<std::unique_ptr<PreparedModel>> prepare(const RenderModel& model, const EngineViews& views) {
  switch (views.engine) {
    case EngineKind::Onepass:
    case EngineKind::Multipass:
      return prepare_on_opengl(model, views);
    case EngineKind::Ewa:
      if (model.splats != nullptr) return ewa::prepare(*model.splats);
      assert(model.patches != nullptr && "there are points or patches");
      return ewa::prepare(splat(*model.patches));
    case EngineKind::Raytrace:
      break;
  }
  if (model.mesh != nullptr) return raytrace::prepare(*model.mesh);
  assert(model.patches != nullptr && "there is a mesh or patches");
  auto mesh = triangulate(*model.patches);
  if (!mesh) return mesh.error();
  return raytrace::prepare(std::move(*mesh));
}

/// Draws the views of one engine after each other.
Status render_group(PreparedModel& prepared, const EngineViews& views, const PictureSink& sink,
                    Progress& outer, Progress& inner) {
  for (std::size_t i = 0; i < views.settings.size(); ++i) {
    if (outer.cancelled()) return interrupted_error();
    auto picture = prepared.render(views.settings[i], inner);
    if (!picture) return picture.error();
    if (outer.cancelled()) return interrupted_error();
    Status taken = sink(views.places[i], std::move(*picture));
    if (!taken) return taken;
    if (&outer != &inner) outer.advance(1);  // alone, the engine has told its own progress
  }
  return {};
}

/// A single view.
Result<RenderResult> render_one(const RenderModel& model, const RenderSettings& settings,
                                Progress& progress) {
  RenderResult result;
  const Status drawn = render_views(
      model, {&settings, 1},
      [&result](std::size_t /*view*/, RenderResult picture) {
        result = std::move(picture);
        return Status();
      },
      progress);
  if (!drawn) return drawn.error();
  return result;
}

}  // namespace

Status render_views(const RenderModel& model, std::span<const RenderSettings> views,
                    const PictureSink& sink, Progress& progress) {
  for (const RenderSettings& settings : views) {
    if (Status possible = check_opacity(settings); !possible) return possible;
    if (Status possible = check_interfaces(settings); !possible) return possible;
    const bool traces_mesh = settings.engine == EngineKind::Raytrace && model.mesh != nullptr;
    if (Status possible = check_split_view(settings, !traces_mesh); !possible) return possible;
  }
  const bool several = views.size() > 1;
  QuietProgress quiet(progress);
  progress.begin_stage("render", several ? views.size() : 0);
  for (const EngineViews& group : group_by_engine(views)) {
    const auto prepared = prepare(model, group);
    if (!prepared) return prepared.error();
    Status drawn = render_group(**prepared, group, sink, progress, several ? quiet : progress);
    if (!drawn) return drawn;
  }
  return {};
}

Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& progress) {
  return render_one({&model, nullptr, nullptr}, settings, progress);
}

Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress) {
  RenderSettings traced = settings;
  traced.engine = EngineKind::Raytrace;
  return render_one({nullptr, &mesh, nullptr}, traced, progress);
}

Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress) {
  RenderSettings splatted = settings;
  splatted.engine = EngineKind::Ewa;
  return render_one({nullptr, nullptr, &splats}, splatted, progress);
}

}  // namespace relief
