#include "cli/reports/explain_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace relief::cli {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t total_bytes(const Explanation& explanation) {
  std::uint64_t bytes = 0;
  for (const auto* const kind : {&explanation.buffers, &explanation.textures}) {
    for (const Explanation::Memory& memory : *kind) bytes += memory.bytes;
  }
  return bytes;
}

Json memory_as_json(const std::vector<Explanation::Memory>& all) {
  Json list = Json::array();
  for (const Explanation::Memory& memory : all) {
    list.push_back({{"name", memory.name},
                    {"bytes", memory.bytes},
                    {"target", memory.target},
                    {"bound", memory.bound}});
  }
  return list;
}

std::string names(const std::vector<std::string>& list) {
  return list.empty() ? std::string("none") : fmt::format("{}", fmt::join(list, ", "));
}

std::string memory_as_text(std::string_view kind, const std::vector<Explanation::Memory>& all) {
  std::string text = fmt::format("  {}\n", kind);
  for (const Explanation::Memory& memory : all) {
    text +=
        fmt::format("    {:<24} {:>12} bytes{}{}\n", memory.name, memory.bytes,
                    memory.target ? ", drawn into" : "", memory.bound ? "" : ", not in the frame");
  }
  return text;
}

}  // namespace

Json as_json(const Explanation& explanation, const FileBytes& read) {
  Json variants = Json::array();
  for (const Explanation::Variant& variant : explanation.variants) {
    variants.push_back({{"name", variant.name},
                        {"vertex", variant.vertex},
                        {"fragment", variant.fragment},
                        {"features", variant.features},
                        {"lines", variant.lines},
                        {"drawn", variant.drawn}});
  }
  Json draws = Json::array();
  for (const Explanation::Draw& draw : explanation.draws) {
    draws.push_back({{"pass", draw.pass},
                     {"program", draw.program},
                     {"primitive", draw.primitive},
                     {"commands", draw.commands},
                     {"front_alone", draw.front_alone}});
  }
  Json json = {{"features", explanation.features},
               {"variants", std::move(variants)},
               {"buffers", memory_as_json(explanation.buffers)},
               {"textures", memory_as_json(explanation.textures)},
               {"bytes", total_bytes(explanation)},
               {"passes", explanation.passes},
               {"draws", std::move(draws)},
               {"read_bytes", as_json(read)}};
  if (explanation.costs) json["costs"] = as_json(*explanation.costs, read);
  return json;
}

std::string as_text(const Explanation& explanation, const FileBytes& read) {
  std::string text =
      fmt::format("  features of the frame: {}\n  shader variants\n", names(explanation.features));
  for (const Explanation::Variant& variant : explanation.variants) {
    text += fmt::format("    {:<24} {} + {}, {} lines: {}{}\n", variant.name, variant.vertex,
                        variant.fragment, variant.lines, names(variant.features),
                        variant.drawn ? "" : "; not in the frame");
  }
  text += memory_as_text("buffers", explanation.buffers);
  text += memory_as_text("textures", explanation.textures);
  text += fmt::format("    {:<24} {:>12} bytes in all\n", "", total_bytes(explanation));
  text += fmt::format("  passes: {}\n  draws\n", names(explanation.passes));
  for (const Explanation::Draw& draw : explanation.draws) {
    text += fmt::format("    {:<24} {}, {}, {} command{}{}\n", draw.pass, draw.program,
                        draw.primitive, draw.commands, draw.commands == 1 ? "" : "s",
                        draw.front_alone ? ", front faces only" : "");
  }
  if (read) {
    text += fmt::format(
        "  read of patch files: {} bytes of heights, {} of normals, {} of colours, {} of scalars\n",
        read->heights, read->normals, read->colours, read->scalars);
  }
  return explanation.costs ? text + as_text(*explanation.costs, read) : text;
}

}  // namespace relief::cli
