// What panels hold that is nobody else's: texts being typed, figures that take a while to find.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "loader/scene/loaded_scene.h"
#include "viewer/session.h"

namespace relief {

/// A path that is being typed.
struct PathField {
  std::array<char, 4096> text{};  ///< with its 0
  std::vector<std::string> completions;
  bool takes_keys = false;  ///< from the next frame on
  bool is_open = false;     ///< the completions are shown
};

/// A file name that is offered, until the user types another one.
struct SaveField {
  std::array<char, 4096> text{};  ///< with its 0
  std::string offered;            ///< what was offered last
};

/// What the open files are, found once for each scene.
struct SceneFacts {
  std::weak_ptr<const LoadedScene> scene;
  std::size_t samples = 0;
};

/// Whether files are there, and how large they are: asked of the disk now and then.
struct FileFacts {
  std::map<std::filesystem::path, std::optional<std::uintmax_t>> bytes;  ///< none: not there
  double since = -1.0;  ///< the window's clock, seconds
};

/// A name that no file has, for a new picture or film.
struct FreeName {
  std::filesystem::path of;  ///< the open file
  std::string name;
  bool was_busy = false;  ///< a picture was being made, the last time
};

struct PanelState {
  PathField file;
  bool adds_file = false;
  PathField environment;
  bool is_scrolling = false;  ///< to the section that is asked for
  SaveField measurements;
  SaveField picture;
  FreeName offered_picture;
  SaveField film;
  FreeName offered_film;
  SceneFacts scene;
  FileFacts files;
  std::optional<std::size_t> renamed;  ///< a bookmark
  bool name_takes_keys = false;        ///< from the next frame on
  std::array<char, 256> new_name{};
};

/// What a panel works with.
struct PanelContext {
  Session& session;
  PanelState& state;
  double now;  ///< the window's clock, seconds
};

}  // namespace relief
