// relief convert --samples and --error: how many samples there are, and how far off they lie.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;
using SampleBudgets = JsonTest;

TEST_F(SampleBudgets, SamplesAreAsManyAsAskedFor) {
  const std::string scan = write_knot(20000);
  for (const int wanted : {5000, 20000, 60000}) {
    json result =
        run_json({"convert", scan, "-o", path("knot.relief"), "--samples", std::to_string(wanted)});
    // Patches are corrected once for what their ragged borders take.
    EXPECT_NEAR(result["samples"].get<double>(), wanted, 0.07 * wanted);
  }
}

TEST_F(SampleBudgets, TheFewestSamplesReachTheError) {
  const std::string scan = write_knot(20000);
  const json usual = run_json({"convert", scan, "-o", path("knot.relief")});
  const double error = usual["error_rms"];
  for (const double share : {10.0, 4.0}) {
    json result = run_json(
        {"convert", scan, "-o", path("knot.relief"), "--error", std::to_string(share * error)});
    EXPECT_LE(result["error_rms"], share * error);
    EXPECT_GE(result["error_rms"], 0.8 * share * error) << "that many samples are not needed";
    EXPECT_LT(result["samples"], usual["samples"]);
  }
}

TEST_F(SampleBudgets, AnErrorOutOfReachIsNamed) {
  const Outcome run =
      run_relief({"convert", write_knot(5000), "-o", path("knot.relief"), "--error", "1e-12"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("an error of 1e-12 is not reached"), std::string::npos) << run.err;
}

TEST_F(SampleBudgets, MoreSamplesThanThePointsTellAreRefused) {
  const Outcome run =
      run_relief({"convert", write_knot(5000), "-o", path("knot.relief"), "--samples", "1000000"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("--samples 1000000 is more than the points can tell"), std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("knot.relief")));
}

TEST_F(SampleBudgets, WrongValuesAreWrongUsage) {
  const std::string scan = write_knot(5000);
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--error", "nan"},
                                                  {"--error", "0"},
                                                  {"--error", "1e300"},
                                                  {"--spacing", "inf"},
                                                  {"--samples", "0"},
                                                  {"--samples", "-5"},
                                                  {"--samples", "1000", "--error", "1"},
                                                  {"--samples", "1000", "--spacing", "1"},
                                                  {"--error", "1", "--memory", "1G"}}) {
    std::vector<std::string> arguments{"convert", scan, "-o", path("knot.relief")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_relief(arguments).exit_code, 2) << options[0] << " " << options[1];
    EXPECT_FALSE(std::filesystem::exists(path("knot.relief")));
  }
}

}  // namespace
}  // namespace relief::test
