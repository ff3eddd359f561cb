// A program of someone else's: converts points to a patch file with the installed libraries.
#include <relief/common/patch_file/patch_file.h>
#include <relief/preprocess/convert.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  relief::Points points;
  for (int i = 0; i < 900; ++i) points.positions.emplace_back(i % 30, i / 30, 0.0);
  relief::Progress silent;
  const auto converted = relief::convert(std::move(points), {}, silent);
  return converted && relief::write_patch_file(argv[1], converted->model) ? 0 : 1;
}
