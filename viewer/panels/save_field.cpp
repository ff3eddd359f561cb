#include "viewer/panels/save_field.h"

#include <imgui.h>

#include <algorithm>

#include "common/io/extension.h"
#include "viewer/choices/path_completion.h"
#include "viewer/panels/rows.h"

namespace relief {

void offer(const std::string& offered, SaveField& field) {
  if (field.text.front() == '\0' || field.offered == field.text.data()) {
    const std::size_t length = std::min(offered.size(), field.text.size() - 1);
    std::copy_n(offered.begin(), length, field.text.begin());
    field.text[length] = '\0';
    field.offered = field.text.data();
  }
}

void show_save_field(const char* id, const std::string& offered, const Session& session,
                     SaveField& field) {
  offer(offered, field);
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::InputText(id, field.text.data(), field.text.size());
  help_for_last(path_in(field, session).string().c_str());
}

std::filesystem::path path_in(const SaveField& field, const Session& session) {
  const std::filesystem::path path = typed_path(field.text.data());
  const auto& files = session.document.files();
  if (path.has_parent_path() || files.empty()) return path;
  return files.front().parent_path() / path;
}

std::string name_beside(const Session& session, const std::string& ending) {
  const auto& files = session.document.files();
  std::filesystem::path name = files.empty() ? "relief" : files.front().filename();
  if (lower_extension(name) == ".gz") name = name.stem();
  return name.stem().string() + ending;
}

}  // namespace relief
