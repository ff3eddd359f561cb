# cmake -DOUTPUT=FILE.cpp -DFOLDER=shaders "-DFILES=a;b" -P embed.cmake
# Writes the shader files into a C++ source that defines find_shader (renderer/gl/shader/shader_text.h).
set(text "// Made by shaders/embed.cmake.\n#include \"renderer/gl/shader/shader_text.h\"\n\nnamespace relief {\n\n"
  "std::string_view find_shader(std::string_view path) {\n")
foreach(file IN LISTS FILES)
  file(READ "${FOLDER}/${file}" shader)
  string(APPEND text "  if (path == \"${file}\") return R\"GLSL(${shader})GLSL\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace relief\n")
file(WRITE "${OUTPUT}" "${text}")
