#include "renderer/gl/program.h"

#include <cassert>
#include <string>
#include <vector>

#include "renderer/gl/shader/preprocess_shader.h"
#include "renderer/gl/shader/shader_text.h"

namespace relief {
namespace {

class Shader {
 public:
  Shader(const Gl& gl, GLenum stage) : gl_(gl), id_(gl.CreateShader(stage)) {}
  ~Shader() { gl_.DeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const Gl& gl_;
  GLuint id_;
};

void append_file(std::string& out, std::vector<std::string_view>& files, std::string_view path) {
  for (const std::string_view known : files) {
    if (known == path) return;
  }
  std::string_view text = find_shader(path);
  assert(!text.empty() && "a shader file that is listed in renderer/CMakeLists.txt");
  const std::size_t file = files.size();
  files.push_back(path);
  out += fmt::format("#line 1 {}\n", file);
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(row.size() + 1, text.size()));
    constexpr std::string_view kInclude = "#include ";
    if (row.starts_with("#pragma once") || row.starts_with("#include <") ||
        row.starts_with("#include \"shaders/")) {
      out += '\n';  // for the C++ side of a shared header
    } else if (row.starts_with(kInclude)) {
      const std::string_view quoted = row.substr(kInclude.size());
      append_file(out, files, quoted.substr(1, quoted.rfind('"') - 1));
      out += fmt::format("#line {} {}\n", line + 1, file);
    } else {
      out.append(row).append("\n");
    }
  }
}

Status compile(const Gl& gl, const Shader& shader, std::string_view path, Features features) {
  const std::string text = resolve_shader(path, features);
  const GLchar* const begin = text.data();
  const GLint length = static_cast<GLint>(text.size());
  gl.ShaderSource(shader.id(), 1, &begin, &length);
  gl.CompileShader(shader.id());
  GLint done = GL_FALSE;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return {};
  std::string log(4096, '\0');
  GLsizei log_length = 0;
  gl.GetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &log_length, log.data());
  log.resize(static_cast<std::size_t>(log_length));
  return make_error("shaders/{} (features {:#x}) does not compile: {}", path, features.bits, log);
}

}  // namespace

std::string resolve_shader(std::string_view path, Features features) {
  std::string out =
      fmt::format("#version 450 core\n#define RELIEF_FEATURES {}u\n#define RELIEF_LIGHTS {}\n",
                  features.bits, features.lights);
  std::vector<std::string_view> files;
  append_file(out, files, path);
  return out;
}

Result<Program> make_program(const Gl& gl, std::string_view label, std::string_view vertex_path,
                             std::string_view fragment_path, Features features) {
  const Shader vertex(gl, GL_VERTEX_SHADER);
  RELIEF_TRY(compile(gl, vertex, vertex_path, features));
  const Shader fragment(gl, GL_FRAGMENT_SHADER);
  RELIEF_TRY(compile(gl, fragment, fragment_path, features));

  Program program(gl, label);
  gl.AttachShader(program.id(), vertex.id());
  gl.AttachShader(program.id(), fragment.id());
  gl.LinkProgram(program.id());
  GLint done = GL_FALSE;
  gl.GetProgramiv(program.id(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) {
    if (gl.recorder != nullptr) {
      const std::uint64_t lines = count_shader_lines(resolve_shader(vertex_path, features)) +
                                  count_shader_lines(resolve_shader(fragment_path, features));
      gl.recorder->add_program(program.id(), label, vertex_path, fragment_path, features, lines);
    }
    return program;
  }
  std::string log(4096, '\0');
  GLsizei log_length = 0;
  gl.GetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), &log_length, log.data());
  log.resize(static_cast<std::size_t>(log_length));
  return make_error("shaders/{} and {} (features {:#x}) do not link: {}", vertex_path,
                    fragment_path, features.bits, log);
}

}  // namespace relief
