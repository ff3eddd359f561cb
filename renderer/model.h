// A model in the forms that engines draw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "common/patch.h"
#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/volume/volume_parts.h"

namespace relief {

/// A form that a model comes in. A new form is a new enumerator, and a new alternative of
/// RenderModel::Form at the same position.
enum class ModelForm : std::uint8_t { Patches, Splats, Mesh, Volume, Gaussians, VolumeParts };

/// One model in one or several forms, which it borrows: they must outlive the rendering. Each form
/// is there at most once.
class RenderModel {
 public:
  using Form = std::variant<const PatchModel*, const SplatCloud*, const TriangleMesh*,
                            const ScalarVolume*, const GaussianCloud*, const VolumeParts*>;

  /// A model without any form, for add().
  RenderModel() = default;

  [[nodiscard]] static RenderModel of(const PatchModel& patches) { return with(&patches); }
  [[nodiscard]] static RenderModel of(const SplatCloud& splats) { return with(&splats); }
  [[nodiscard]] static RenderModel of(const TriangleMesh& mesh) { return with(&mesh); }

  /// Adds a form, in place of one of the same kind.
  template <class T>
  void add(const T& form) {
    std::erase_if(forms_, [](const Form& f) { return std::holds_alternative<const T*>(f); });
    forms_.emplace_back(&form);
  }

  /// Whether both borrow the same forms.
  bool operator==(const RenderModel&) const = default;

  [[nodiscard]] bool has(ModelForm form) const {
    for (const Form& f : forms_) {
      if (f.index() == static_cast<std::size_t>(form)) return true;
    }
    return false;
  }

  /// The form of that type, or null.
  template <class T>
  [[nodiscard]] const T* find() const {
    for (const Form& f : forms_) {
      if (const auto* const found = std::get_if<const T*>(&f)) return *found;
    }
    return nullptr;
  }

 private:
  static RenderModel with(Form form) {
    RenderModel model;
    model.forms_.push_back(form);
    return model;
  }

  std::vector<Form> forms_;
};

}  // namespace relief
