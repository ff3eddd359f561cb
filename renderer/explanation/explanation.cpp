#include "renderer/explanation/explanation.h"

#include <algorithm>

namespace relief {
namespace {

using Memories = std::vector<Explanation::Memory>;

bool same_object(const Explanation::Memory& a, const Explanation::Memory& b) {
  return a.name == b.name && a.bytes == b.bytes && a.target == b.target;
}

/// Objects are known only by their description: of those that look alike there are as many as the
/// larger of the two counts.
void unite(Memories& all, const Memories& more) {
  Memories rest = all;
  for (const Explanation::Memory& memory : more) {
    const auto alike = [&memory](const Explanation::Memory& m) { return same_object(m, memory); };
    const auto known = std::find_if(rest.begin(), rest.end(), alike);
    if (known == rest.end()) {
      all.push_back(memory);
      continue;
    }
    rest.erase(known);
    if (!memory.bound) continue;
    const auto unbound = std::find_if(all.begin(), all.end(),
                                      [&alike](const auto& m) { return alike(m) && !m.bound; });
    if (unbound != all.end()) unbound->bound = true;
  }
}

}  // namespace

BoundBytes bound_bytes(const Explanation& explanation) {
  BoundBytes bytes;
  for (const auto* const kind : {&explanation.buffers, &explanation.textures}) {
    for (const Explanation::Memory& memory : *kind) {
      if (!memory.bound) continue;
      bytes.all += memory.bytes;
      if (!memory.target) bytes.model += memory.bytes;
    }
  }
  return bytes;
}

void append(Explanation& all, const Explanation& more) {
  for (const std::string& feature : more.features) {
    if (std::find(all.features.begin(), all.features.end(), feature) == all.features.end())
      all.features.push_back(feature);
  }
  for (const Explanation::Variant& variant : more.variants) {
    const auto known = std::find_if(all.variants.begin(), all.variants.end(), [&](const auto& v) {
      return v.name == variant.name && v.features == variant.features;
    });
    if (known == all.variants.end()) {
      all.variants.push_back(variant);
    } else {
      known->drawn = known->drawn || variant.drawn;
    }
  }
  unite(all.buffers, more.buffers);
  unite(all.textures, more.textures);
  all.passes.insert(all.passes.end(), more.passes.begin(), more.passes.end());
  all.draws.insert(all.draws.end(), more.draws.begin(), more.draws.end());
}

}  // namespace relief
