// All of a patch file, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "common/patch_file/patch_file.h"

namespace relief::test {

inline PatchModel read_whole(const std::filesystem::path& path) {
  const auto file = PatchFile::open(path);
  EXPECT_TRUE(file) << file.error().message;
  Progress progress;
  auto model = file->read_all(progress);
  EXPECT_TRUE(model) << model.error().message;
  return *std::move(model);
}

}  // namespace relief::test
