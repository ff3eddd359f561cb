// Measurements over the picture: points, lines and labels, all in front of the surface.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "viewer/measuring/seen_segment.h"
#include "viewer/navigation/projection.h"
#include "viewer/panels/panels.h"

namespace relief {
namespace {

constexpr ImU32 kDark = IM_COL32(20, 21, 24, 215);
constexpr ImU32 kLight = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kOpen = IM_COL32(255, 217, 128, 255);

/// Draws in an image's pixels.
class Pen {
 public:
  explicit Pen(const Session& session)
      : camera_(session.navigator.camera()),
        size_(session.window),
        origin_(ImGui::GetMainViewport()->Pos),
        density_(ImGui::GetIO().DisplayFramebufferScale.x),
        em_(ImGui::GetFontSize()),
        list_(*ImGui::GetBackgroundDrawList()) {
    list_.PushClipRect(origin_, at(size_));
  }
  ~Pen() { list_.PopClipRect(); }
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  /// A line with a dark outline.
  void line(glm::dvec3 from, glm::dvec3 to, ImU32 colour, float width) {
    const double margin = 4.0 * em_ * density_;
    const auto seen = seen_segment(camera_, from, to, size_, margin);
    if (!seen) return;
    list_.AddLine(at(seen->from), at(seen->to), kDark, (width + 0.13F) * em_);
    list_.AddLine(at(seen->from), at(seen->to), colour, width * em_);
  }

  void lines(const std::vector<glm::dvec3>& points, ImU32 colour, float width) {
    for (std::size_t k = 1; k < points.size(); ++k) line(points[k - 1], points[k], colour, width);
  }

  void point(glm::dvec3 world, ImU32 colour) {
    const auto seen = project(camera_, world, size_);
    if (!seen || !is_near(*seen)) return;
    list_.AddCircleFilled(at(*seen), 0.3F * em_, kDark, 20);
    list_.AddCircleFilled(at(*seen), 0.2F * em_, colour, 20);
  }

  /// A text above or below a position that is in the image; left out where others are already.
  void label(glm::dvec3 world, const std::string& text, ImU32 colour) {
    const auto seen = project(camera_, world, size_);
    if (!seen || !is_in(*seen)) return;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 anchor = at(*seen);
    const ImVec2 end = at(size_);
    const float margin = 0.35F * em_;
    const float left = std::clamp(anchor.x - 0.5F * size.x, origin_.x + 2.0F * margin,
                                  std::max(end.x - size.x - 2.0F * margin, origin_.x));
    for (const float top : {anchor.y - size.y - 0.8F * em_, anchor.y + 0.8F * em_}) {
      const ImVec4 box{left - margin, top - 0.5F * margin, left + size.x + margin,
                       top + size.y + 0.5F * margin};
      if (box.y < origin_.y || !is_free(box)) continue;
      taken_.push_back(box);
      list_.AddRectFilled({box.x, box.y}, {box.z, box.w}, kDark, 0.35F * em_);
      list_.AddText({left, top}, colour, text.c_str());
      return;
    }
  }

 private:
  [[nodiscard]] ImVec2 at(glm::dvec2 pixel) const {
    return {origin_.x + static_cast<float>(pixel.x) / density_,
            origin_.y + static_cast<float>(pixel.y) / density_};
  }
  [[nodiscard]] bool is_in(glm::dvec2 pixel) const {
    return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= size_.x && pixel.y <= size_.y;
  }
  /// Single precision holds the pixel.
  [[nodiscard]] bool is_near(glm::dvec2 pixel) const { return is_in(0.5 * (pixel + 0.5 * size_)); }

  [[nodiscard]] bool is_free(const ImVec4& box) const {
    return std::none_of(taken_.begin(), taken_.end(), [&box](const ImVec4& other) {
      return box.x < other.z && other.x < box.z && box.y < other.w && other.y < box.w;
    });
  }

  const Camera& camera_;
  glm::dvec2 size_;
  ImVec2 origin_;
  float density_;
  float em_;
  ImDrawList& list_;
  std::vector<ImVec4> taken_;  ///< boxes of labels: left, top, right, bottom
};

constexpr float kWide = 0.13F;  ///< of the text's height
constexpr float kThin = 0.07F;

void draw(const Measurement& measurement, const Session& session, ImU32 colour, Pen& pen) {
  const glm::dvec3 up = session.navigator.stance().up;
  const double spacing = session.scene == nullptr ? 0.0 : session.scene->patches.spacing;
  std::vector<glm::dvec3> points;
  for (const SurfacePoint& point : measurement.points) points.push_back(point.position);
  glm::dvec3 anchor = label_anchor(measurement);
  if (measurement.kind == MeasurementKind::Height) {
    const glm::dvec3 corner = height_corner(points.front(), points.back(), up);
    pen.line(points.front(), corner, colour, kWide);
    pen.line(corner, points.back(), colour, kThin);
    anchor = 0.5 * (points.front() + corner);
  } else {
    pen.lines(points, colour, kWide);
  }
  if (measurement.kind == MeasurementKind::Angle) {
    const std::vector<glm::dvec3> arc = angle_arc(points[0], points[1], points[2]);
    pen.lines(arc, colour, kThin);
    if (!arc.empty()) anchor = arc[arc.size() / 2];
  }
  for (const glm::dvec3 point : points) pen.point(point, colour);
  pen.label(anchor, label_of(measurement, up, spacing), colour);
}

/// What is measured just now, and on to the cursor.
void draw_open(const Session& session, Pen& pen) {
  const MeasuringTool& tool = session.measuring;
  const auto& open = tool.open_points();
  if (session.hovered) {
    if (const auto preview = tool.preview(session.hovered->point))
      return draw(*preview, session, kOpen, pen);
  }
  std::vector<glm::dvec3> points;
  points.reserve(open.size() + 1);
  for (const SurfacePoint& point : open) points.push_back(point.position);
  if (session.hovered && !open.empty()) points.push_back(session.hovered->point.position);
  pen.lines(points, kOpen, kWide);
  for (const SurfacePoint& point : open) pen.point(point.position, kOpen);
  if (tool.chosen() && session.hovered) pen.point(session.hovered->point.position, kOpen);
}

}  // namespace

void show_measurements(const Session& session) {
  if (session.window.x <= 0 || session.window.y <= 0) return;
  Pen pen(session);
  // Those that come first keep their labels.
  draw_open(session, pen);
  const auto& list = session.measuring.list();
  for (auto newest = list.rbegin(); newest != list.rend(); ++newest)
    draw(*newest, session, kLight, pen);
}

}  // namespace relief
