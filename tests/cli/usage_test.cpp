// Wrong usage is reported before any work and ends with exit code 2; help and version with 0.
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/version.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

TEST(Usage, WrongUsageIsExitCodeTwo) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"shine"},
      {"convert"},
      {"convert", "scan.ply"},
      {"convert", "scan.ply", "-o"},
      {"convert", "scan.ply", "-o", "x.relief", "--spacing", "0"},
      {"convert", "scan.ply", "-o", "x.relief", "--spacing", "wide"},
      {"convert", "scan.ply", "-o", "x.relief", "--cone-degrees", "90"},
      {"convert", "scan.ply", "-o", "x.relief", "--overlap", "-1"},
      {"convert", "scan.ply", "-o", "x.relief", "--threads", "0"},
      {"convert", "scan.ply", "-o", "x.relief", "--codec", "tiny"},
      {"convert", "scan.ply", "-o", "x.relief", "--height-step", "0"},
      {"convert", "scan.ply", "-o", "x.relief", "--normal-degrees", "0"},
      {"convert", "scan.ply", "-o", "x.relief", "--sparkle"},
      {"export"},
      {"export", "x.relief"},
      {"export", "x.relief", "-o", "x.stl"},
      {"export", "x.relief", "-o", "x"},
      {"export", "x.relief", "-o", "x.ply", "--as", "splats"},
      {"info"},
      {"info", "x.relief", "y.relief"},
      {"render", "x.relief"},
      {"render", "x.relief", "-o", "x.jpg"},
      {"render", "x.relief", "-o", "x"},
      {"render", "x.relief", "-o", "x.png", "--size", "640"},
      {"render", "x.relief", "-o", "x.png", "--size", "0x480"},
      {"render", "x.relief", "-o", "x.png", "--size", "99999x480"},
      {"render", "x.relief", "-o", "x.png", "--orbit", "10"},
      {"render", "x.relief", "-o", "x.png", "--orbit", "10,20,-1"},
      {"render", "x.relief", "-o", "x.png", "--orbit", "10,nan"},
      {"render", "x.relief", "-o", "x.png", "--eye", "1,2"},
      {"render", "x.relief", "-o", "x.png", "--eye", "1,2,3", "--orbit", "0,0"},
      {"render", "x.relief", "-o", "x.png", "--eye", "1,2,3", "--target", "1,2,3"},
      {"render", "x.relief", "-o", "x.png", "--target", "1,2,3"},
      {"render", "x.relief", "-o", "x.png", "--eye", "1,2,3", "--up", "0,0,0"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "100M"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "-1"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "much"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "1G", "--clean"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "1G", "--thin", "1"},
      {"convert", "x.ply", "-o", "x.relief", "--memory", "1G", "--adaptive-spacing"},
      {"convert", "x.ply", "-o", "x.relief", "--even-spacing", "--adaptive-spacing"},
      {"render", "x.relief", "-o", "x.png", "--fov", "180"},
      {"render", "x.relief", "-o", "x.png", "--fov", "nan"},
      {"render", "x.relief", "-o", "x.png", "--orthographic"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "0"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "-1"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "nan"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "inf"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "wide"},
      {"render", "x.relief", "-o", "x.png", "--orthographic", "1", "--fov", "45"},
      {"bench", "x.relief", "--orthographic", "0"},
      {"render", "x.relief", "-o", "x.png", "--engine", "surfels"},
      {"render", "x.relief", "-o", "x.png", "--radius-factor", "2"},
      {"render", "x.relief", "-o", "x.png", "--pixels-per-sample", "-1"},
      {"render", "x.relief", "-o", "x.png", "--pixels-per-sample", "nan"},
      {"render", "x.relief", "-o", "x.png", "--engine", "multipass", "--pixels-per-sample", "2"},
      {"render", "x.relief", "-o", "x.png", "--engine", "multipass", "--radius-factor", "0.9"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--samples", "4"},
      {"render", "x.relief", "-o", "x.png", "--engine", "multipass", "--primitive", "cell"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--filter", "box"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--cutoff", "0"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--layers", "0"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--tau", "nan"},
      {"render", "x.relief", "-o", "x.png", "--engine", "ewa", "--time-budget", "-1"},
      {"render", "x.relief", "-o", "x.png", "--samples", "65537"},
      {"render", "x.relief", "-o", "x.png", "--light", "1,0"},
      {"render", "x.relief", "-o", "x.png", "--light", "0,0,0"},
      {"render", "x.relief", "-o", "x.png", "--light", "1,0,0,1,1,1001"},
      {"render", "x.relief", "-o", "x.png", "--light", "point:1,0,0,1,1"},
      {"render", "x.relief", "-o", "x.png", "--ambient", "1,0,-1"},
      {"render", "x.relief", "-o", "x.png", "--engine", "raytrace", "--samples", "0"},
      {"render", "x.relief", "-o", "x.png", "--engine", "raytrace", "--tau", "0.5"},
      {"render", "x.relief", "-o", "x.png", "--primitive", "disc"},
      {"render", "x.relief", "-o", "x.png", "--material", "gold"},
      {"render", "x.relief", "-o", "x.png", "--ior", "1.5"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--ior", "0.9"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--ior", "nan"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--ior", "4.5"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--absorption", "1,2"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--absorption", "1,-2,0"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--absorption", "1,nan,0"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--roughness", "0.5"},
      {"render", "x.relief", "-o", "x.png", "--absorption", "1,1,1"},
      {"render", "x.relief", "-o", "x.png", "--interfaces", "2"},
      {"render", "x.relief", "-o", "x.png", "--material", "mirror", "--interfaces", "1"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--interfaces", "0"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--interfaces", "1.5"},
      {"render", "x.relief", "-o", "x.png", "--material", "glass", "--interfaces", "3"},
      {"render", "x.relief", "-o", "x.png", "--material", "mirror", "--roughness", "1.1"},
      {"render", "x.relief", "-o", "x.png", "--exposure", "bright"},
      {"render", "x.relief", "-o", "x.png", "--exposure", "21"},
      {"render", "x.relief", "-o", "x.exr", "--exposure", "1"},
      {"render", "x.relief", "-o", "x.png", "--background", "255,0,0"},
      {"render", "x.relief", "-o", "x.png", "--background", "black"},
      {"render", "x.relief", "-o", "x.png", "--outputs", "normal"},
      {"render", "x.relief", "-o", "x.exr", "--outputs", "smell"},
      {"render", "x.relief", "-o", "x.png", "--frames", "0"},
      {"compare"},
      {"compare", "a.png"},
      {"compare", "a.png", "b.png", "c.png"},
      {"compare", "a.png", "b.png", "--heatmap", "c.jpg"},
      {"compare", "a.png", "b.png", "--heatmap"},
      {"compare", "a.png", "b.png", "--flip", "mdr"},
      {"compare", "a.png", "b.png", "--pixels-per-degree", "0"},
      {"compare", "a.png", "b.png", "--pixels-per-degree", "nan"},
      {"compare", "a.png", "b.png", "--fail-below", "psnr_db"},
      {"compare", "a.png", "b.png", "--fail-below", "psnr_db="},
      {"compare", "a.png", "b.png", "--fail-below", "psnr_db=high"},
      {"compare", "a.png", "b.png", "--fail-above", "holes=1e999"},
      {"compare", "a.png", "b.png", "--fail-above", "holes=nan"},
      {"compare", "a.png", "b.png", "--fail-above", "holes=1 "},
      {"compare", "a.png", "b.png", "--fail-above", "beauty=3"},
      {"compare", "a.png", "b.png", "--fail-above", "=3"},
      {"compare", "a.png", "b.png", "--fail-above", "holes=0", "--fail-above", "identical=1"},
  };
  for (const auto& arguments : wrong) {
    const Outcome run = run_relief(arguments);
    std::string line;
    for (const auto& argument : arguments) line += argument + " ";
    EXPECT_EQ(run.exit_code, 2) << line << run.err;
    EXPECT_EQ(run.out, "") << line;
    EXPECT_NE(run.err, "") << line;
  }
}

/// An option in a help text.
struct ListedOption {
  std::string names;  ///< "-o,--output"
  std::string value;  ///< "FILE (required)"; empty for a flag
  std::string text;
};

bool is_heading(const std::string& line) {
  return line.rfind("Option", 0) == 0 && line.ends_with(':');
}

/// The options of a help text, of all groups. CLI11 begins descriptions in column 31, on the next
/// line if the name is long.
std::vector<ListedOption> options_of(const std::string& help) {
  constexpr std::size_t kColumn = 30;
  std::vector<ListedOption> options;
  std::istringstream lines(help);
  std::string line;
  bool in_group = false;
  while (std::getline(lines, line)) {
    if (line.empty() || is_heading(line)) {
      in_group = !line.empty();
      continue;
    }
    if (!in_group) continue;
    if (line.rfind(std::string(kColumn, ' '), 0) == 0) {
      if (!options.empty()) options.back().text += line.substr(kColumn) + " ";
      continue;
    }
    const bool short_name = line.size() > kColumn && line[kColumn - 1] == ' ';
    std::istringstream name(short_name ? line.substr(0, kColumn) : line);
    ListedOption option;
    name >> option.names;
    std::getline(name >> std::ws, option.value);
    option.value.erase(option.value.find_last_not_of(' ') + 1);
    // What an option needs or excludes stands behind its value.
    for (const char* relation : {"Needs:", "Excludes:"})
      option.value = option.value.substr(0, option.value.find(relation));
    option.value.erase(option.value.find_last_not_of(' ') + 1);
    if (short_name) option.text = line.substr(kColumn) + " ";
    options.push_back(option);
  }
  return options;
}

std::string help_of(const std::string& subcommand) {
  const Outcome run = run_relief({subcommand, "--help"});
  EXPECT_EQ(run.exit_code, 0) << subcommand;
  EXPECT_EQ(run.err, "") << subcommand;
  return run.out;
}

// The number of options is written down here, so that one that is lost or not listed is noticed.
TEST(Usage, HelpListsEveryOptionWithItsDefault) {
  const std::map<std::string, std::size_t> counts{{"bench", 51}, {"compare", 7}, {"convert", 33},
                                                  {"export", 8}, {"info", 6},    {"render", 91}};
  for (const auto& [subcommand, count] : counts) {
    const std::vector<ListedOption> options = options_of(help_of(subcommand));
    EXPECT_EQ(options.size(), count) << subcommand;
    for (const ListedOption& option : options) {
      const std::string where = subcommand + " " + option.names + " " + option.value;
      EXPECT_FALSE(option.text.empty()) << where;
      if (option.value.empty()) continue;
      EXPECT_TRUE(option.value.find("(required)") != std::string::npos ||
                  option.text.find("(default") != std::string::npos ||
                  option.text.find("(off by default)") != std::string::npos)
          << where << ": " << option.text;
    }
  }
}

// A reader finds what an engine has under its name.
TEST(Usage, HelpGroupsTheOptionsOfEngines) {
  const std::string help = help_of("render");
  const auto group = [&help](const std::string& engines) {
    const std::size_t begin = help.find("\nOptions of " + engines + ":\n");
    EXPECT_NE(begin, std::string::npos) << engines << "\n" << help;
    return help.substr(begin, help.find("\n\n", begin + 1) - begin);
  };
  EXPECT_NE(group("onepass").find("--interpolation"), std::string::npos);
  EXPECT_NE(group("onepass, multipass").find("--primitive"), std::string::npos);
  EXPECT_EQ(group("onepass, multipass").find("--radius-factor"), std::string::npos);
  EXPECT_NE(group("multipass").find("--radius-factor"), std::string::npos);
  EXPECT_EQ(group("multipass").find("--interpolation"), std::string::npos);
  EXPECT_EQ(group("multipass").find("--size"), std::string::npos);
}

TEST(Usage, HelpNamesTheSubcommandsAndVersionTheVersion) {
  const Outcome help = run_relief({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* subcommand : {"bench", "compare", "convert", "export", "info", "render"})
    EXPECT_NE(help.out.find(std::string("\n  ") + subcommand + " "), std::string::npos)
        << subcommand;
  const Outcome version = run_relief({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.err, "");
  EXPECT_EQ(version.out, std::string("relief ") + kVersion + "\n");
}

}  // namespace
}  // namespace relief::test
