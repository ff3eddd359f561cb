// Runs commands that answer with JSON.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/run_relief.h"

namespace relief::test {

/// Commands that give JSON.
class JsonTest : public CliTest {
 protected:
  /// Runs a command that must succeed with JSON on standard output and nothing on standard error.
  nlohmann::json run_json(std::vector<std::string> arguments, const RunOptions& options = {}) {
    arguments.emplace_back("--json");
    const Outcome run = run_relief(arguments, options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    nlohmann::json parsed = nlohmann::json::parse(run.out, nullptr, false);
    EXPECT_TRUE(parsed.is_object()) << run.out;
    return parsed.is_object() ? parsed : nlohmann::json::object();
  }
};

inline void expect_keys(const nlohmann::json& object, const std::set<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

}  // namespace relief::test
