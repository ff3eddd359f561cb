#include "renderer/frame/targets/targets.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/frame/targets/attachments.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// A channel of an attachment: its name and how EXR keeps it.
struct ChannelName {
  const char* name;
  ChannelType type;
};

/// Reads an attachment of `names.size()` interleaved components, bottom row first, into channels.
template <class Number>
void read_channels(const Gl& gl, const Texture& texture, GLenum format, GLenum type,
                   std::initializer_list<ChannelName> names, Image& image) {
  const std::size_t components = names.size();
  const std::size_t pixels = std::size_t{image.width} * image.height;
  std::vector<Number> values(pixels * components);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.GetTextureImage(texture.id(), 0, format, type,
                     static_cast<GLsizei>(std::min<std::size_t>(
                         values.size() * sizeof(Number), std::numeric_limits<GLsizei>::max())),
                     values.data());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  std::size_t component = 0;
  for (const ChannelName& name : names) {
    Channel channel{name.name, name.type, std::vector<float>(pixels)};
    for (std::size_t y = 0; y < image.height; ++y) {
      const Number* row = values.data() + (image.height - 1 - y) * image.width * components;
      float* out = channel.values.data() + y * image.width;
      for (std::size_t x = 0; x < image.width; ++x)
        out[x] = static_cast<float>(row[x * components + component]);
    }
    image.channels.push_back(std::move(channel));
    ++component;
  }
}

}  // namespace

std::uint32_t largest_target(const Gl& gl) {
  return static_cast<std::uint32_t>(
      std::min(get_limit(gl, GL_MAX_TEXTURE_SIZE), get_limit(gl, GL_MAX_FRAMEBUFFER_WIDTH)));
}

Result<Targets> make_targets(const Gl& gl, std::uint32_t width, std::uint32_t height,
                             const Outputs& outputs) {
  const std::uint32_t largest = largest_target(gl);
  if (width == 0 || height == 0 || width > largest || height > largest) {
    return make_error("an image of {}x{} pixels can't be drawn: this OpenGL allows 1 to {} a side",
                      width, height, largest);
  }
  const auto make = [&](const char* label, GLenum format) {
    return make_attachment(gl, label, format, width, height);
  };
  const auto make_if = [&](bool needed, const char* label, GLenum format) {
    return needed ? std::optional<Texture>(make(label, format)) : std::nullopt;
  };
  Texture colour = make("colour", GL_RGBA16F);
  Texture z_buffer = make("depth buffer", GL_DEPTH_COMPONENT32F);
  std::optional<Texture> normal = make_if(outputs.normal, "normal", GL_RGBA16F);
  std::optional<Texture> depth = make_if(outputs.depth, "depth", GL_R32F);
  std::optional<Texture> uv = make_if(outputs.uv, "uv", GL_RG32F);
  std::optional<Texture> patch_id = make_if(outputs.patch_id, "patch id", GL_R32UI);
  std::optional<Texture> clip = make_if(outputs.clip, "clip", GL_R8UI);
  Framebuffer framebuffer = make_framebuffer(gl, "image", &z_buffer,
                                             {{RELIEF_OUT_COLOUR, &colour},
                                              {RELIEF_OUT_NORMAL, address(normal)},
                                              {RELIEF_OUT_DEPTH, address(depth)},
                                              {RELIEF_OUT_UV, address(uv)},
                                              {RELIEF_OUT_PATCH, address(patch_id)},
                                              {RELIEF_OUT_CLIP, address(clip)}});
  RELIEF_TRY(check_errors(gl, "the image"));
  if (gl.CheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return make_error("this OpenGL can't draw an image of {}x{} pixels with these outputs", width,
                      height);
  return Targets{width,
                 height,
                 std::move(framebuffer),
                 std::move(colour),
                 std::move(z_buffer),
                 std::move(normal),
                 std::move(depth),
                 std::move(uv),
                 std::move(patch_id),
                 std::move(clip)};
}

void clear_targets(const Gl& gl, const Targets& targets, const glm::vec3& background) {
  const GLuint id = targets.framebuffer.id();
  const std::array<GLfloat, 4> colour{background.x, background.y, background.z, 0.0F};
  const std::array<GLfloat, 4> zero{};
  const std::array<GLuint, 4> no_patch{};
  const std::array<GLfloat, 4> infinite{std::numeric_limits<GLfloat>::infinity()};
  gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_OUT_COLOUR, colour.data());
  gl.ClearNamedFramebufferfv(id, GL_DEPTH, 0, zero.data());
  if (targets.normal) gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_OUT_NORMAL, zero.data());
  if (targets.depth) gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_OUT_DEPTH, infinite.data());
  if (targets.uv) gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_OUT_UV, zero.data());
  if (targets.patch_id)
    gl.ClearNamedFramebufferuiv(id, GL_COLOR, RELIEF_OUT_PATCH, no_patch.data());
  if (targets.clip) gl.ClearNamedFramebufferuiv(id, GL_COLOR, RELIEF_OUT_CLIP, no_patch.data());
}

Image read_colour(const Gl& gl, const Texture& colour, std::uint32_t width, std::uint32_t height) {
  Image image{width, height, {}};
  constexpr ChannelType kHalf = ChannelType::Half;
  read_channels<float>(gl, colour, GL_RGBA, GL_FLOAT,
                       {{"R", kHalf}, {"G", kHalf}, {"B", kHalf}, {"A", kHalf}}, image);
  return image;
}

Image read_targets(const Gl& gl, const Targets& targets) {
  Image image = read_colour(gl, targets.colour, targets.width, targets.height);
  constexpr ChannelType kHalf = ChannelType::Half;
  constexpr ChannelType kFloat = ChannelType::Float;
  if (targets.normal)
    read_channels<float>(gl, *targets.normal, GL_RGB, GL_FLOAT,
                         {{"N.X", kHalf}, {"N.Y", kHalf}, {"N.Z", kHalf}}, image);
  if (targets.depth)
    read_channels<float>(gl, *targets.depth, GL_RED, GL_FLOAT, {{"Z", kFloat}}, image);
  if (targets.uv)
    read_channels<float>(gl, *targets.uv, GL_RG, GL_FLOAT, {{"UV.U", kFloat}, {"UV.V", kFloat}},
                         image);
  if (targets.patch_id)
    read_channels<std::uint32_t>(gl, *targets.patch_id, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                 {{"patch", ChannelType::Uint}}, image);
  if (targets.clip)
    read_channels<std::uint32_t>(gl, *targets.clip, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                 {{"clip", ChannelType::Uint}}, image);
  return image;
}

}  // namespace relief
