// A program of someone else's: points to a patch file with the installed libraries.
#include <common/patch_file.h>
#include <preprocess/convert.h>
#include <renderer/render.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  relief::Points points;
  for (int i = 0; i < 900; ++i) points.positions.emplace_back(i % 30, i / 30, 0.0);
  relief::Progress silent;
  const auto converted = relief::convert(std::move(points), {}, silent);
  if (!converted || !relief::write_patch_file(argv[1], converted->model)) return 1;
  // Linked, not run: a picture needs OpenGL, and other tests make pictures.
  return argc > 99 ? static_cast<int>(relief::render(converted->model, {}, silent)->covered_pixels)
                   : 0;
}
