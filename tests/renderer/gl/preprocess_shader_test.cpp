// What a shader's preprocessor leaves of it.
#include "renderer/gl/shader/preprocess_shader.h"

#include <gtest/gtest.h>

#include <string>

#include "renderer/gl/program.h"
#include "renderer/gl/shader/features.h"

namespace relief {
namespace {

TEST(PreprocessShader, LeavesCodeWithoutCommentsDirectivesAndBlankLines) {
  EXPECT_EQ(preprocess_shader("#version 450 core\n\n  float a;  // why\n// all of it\nfloat b;\n"),
            "float a;\nfloat b;\n");
  EXPECT_EQ(preprocess_shader(""), "");
  EXPECT_EQ(count_shader_lines("float a;\n\nfloat b;"), 2U);
}

/// Which of two parts a condition keeps.
std::string kept(const std::string& condition) {
  return preprocess_shader(
      "#define RELIEF_FEATURES 5u\n#define RELIEF_ONE 1u\n#define RELIEF_FOUR 4u\n"
      "#define RELIEF_BOTH (RELIEF_ONE | \\\n  RELIEF_FOUR)  // together\n"
      "#define RELIEF_HAS_ONE (RELIEF_FEATURES & RELIEF_ONE) != 0u\n#if " +
      condition + "\nyes\n#else\nno\n#endif\n");
}

TEST(PreprocessShader, KnowsOurConditions) {
  for (const char* const condition :
       {"1", "(RELIEF_FEATURES & RELIEF_FOUR) != 0u", "RELIEF_FEATURES & RELIEF_ONE",
        "(RELIEF_FEATURES & RELIEF_BOTH) == RELIEF_BOTH", "RELIEF_HAS_ONE",
        "RELIEF_HAS_ONE || RELIEF_UNKNOWN", "(RELIEF_FEATURES & 2u) == 0u && RELIEF_ONE",
        "!RELIEF_UNKNOWN", "defined(RELIEF_ONE)", "!(RELIEF_FEATURES & 2u)",
        "(RELIEF_FEATURES & (2u | RELIEF_FOUR)) != 0u"})
    EXPECT_EQ(kept(condition), "yes\n") << condition;
  for (const char* const condition :
       {"0", "RELIEF_UNKNOWN", "(RELIEF_FEATURES & 2u) != 0u", "defined(RELIEF_UNKNOWN)",
        "!RELIEF_ONE", "RELIEF_ONE && RELIEF_UNKNOWN",
        "(RELIEF_FEATURES & 2u) != 0u && \\\n  RELIEF_ONE"})
    EXPECT_EQ(kept(condition), "no\n") << condition;
}

TEST(PreprocessShader, NestsGroupsAndKeepsOnePartOfEach) {
  const std::string text =
      "#if 0\na\n#if 1\nb\n#endif\n#define RELIEF_LATE\n#elif 1\nc\n#elif 1\nd\n#else\ne\n#endif\n"
      "#ifdef RELIEF_LATE\nf\n#endif\n#ifndef RELIEF_LATE\ng\n#endif\n";
  EXPECT_EQ(preprocess_shader(text), "c\ng\n");
}

/// A variant has the lines of its features, and no others.
TEST(PreprocessShader, SeesTheFeaturesOfAVariant) {
  const auto text = [](Features features) {
    return preprocess_shader(resolve_shader("onepass/quad.frag", features));
  };
  const std::string unlit = text(0);
  const std::string lit = text({RELIEF_FEATURE_LIT, 3});
  EXPECT_EQ(unlit.find("vec3 shade_lit("), std::string::npos);
  EXPECT_NE(lit.find("vec3 shade_lit("), std::string::npos);
  EXPECT_EQ(lit.find("vec3 shade_mirror("), std::string::npos);
  EXPECT_LT(unlit.size(), lit.size());
  EXPECT_EQ(lit.find("#"), std::string::npos);
}

}  // namespace
}  // namespace relief
