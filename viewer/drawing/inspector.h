// Shows outputs of a view in place of its picture.
#pragma once

#include <cstdint>
#include <utility>

#include "common/error.h"
#include "renderer/gl/object.h"
#include "renderer/viewport.h"
#include "viewer/drawing/canvas.h"
#include "viewer/inspecting/inspection.h"

namespace relief {

/// What an inspection counted in the picture that was drawn last.
struct FragmentFigures {
  std::uint64_t fragments = 0;
  std::uint64_t covered = 0;  ///< pixels with one or more
};

/// What turns outputs into colours; exists only while an inspection is chosen.
class Inspector {
 public:
  /// `what` has an inspected_output().
  static Result<Inspector> create(const Gl& gl, Inspection what);

  [[nodiscard]] Inspection what() const { return what_; }

  /// Begins a picture: counts anew.
  void begin() { figures_ = {}; }

  /// Draws a part of a view, which inspected() made the settings of, into the canvas.
  Status draw(const DrawnPart& part, const Canvas& into);

  [[nodiscard]] const FragmentFigures& figures() const { return figures_; }

 private:
  Inspector(const Gl& gl, Inspection what, Program program, Texture colours)
      : gl_(&gl),
        what_(what),
        program_(std::move(program)),
        colours_(std::move(colours)),
        nothing_(gl, "no attributes") {}
  void count(const DrawnPart& part);

  const Gl* gl_;
  Inspection what_;
  Program program_;
  Texture colours_;
  VertexArray nothing_;
  FragmentFigures figures_;
};

}  // namespace relief
