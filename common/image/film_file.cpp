#include "common/image/film_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "common/image/srgb.h"
#include "common/io/extension.h"
#include "common/io/file.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChannels = 3;

std::vector<std::string> arguments_for(const fs::path& path, const fs::path& temporary,
                                       const FilmOptions& options) {
  std::vector<std::string> words{"ffmpeg",   "-loglevel", "error", "-y",         "-f",
                                 "rawvideo", "-pix_fmt",  "rgb24", "-video_size"};
  words.push_back(fmt::format("{}x{}", options.width, options.height));
  words.insert(words.end(), {"-framerate", fmt::format("{}", options.frames_per_second), "-i", "-",
                             "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  if (lower_extension(path) == ".webm") {
    words.insert(words.end(), {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-f", "webm"});
  } else {
    words.insert(words.end(),
                 {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"});
  }
  words.push_back(temporary.string());
  return words;
}

std::vector<std::byte> bytes_of(const Image& frame) {
  const Channel* const channels[kChannels] = {frame.find("R"), frame.find("G"), frame.find("B")};
  const std::size_t pixels = std::size_t{frame.width} * frame.height;
  std::vector<std::byte> bytes(pixels * kChannels);
  for (std::size_t c = 0; c < kChannels; ++c) {
    assert(channels[c] != nullptr && "a frame has colour");
    for (std::size_t i = 0; i < pixels; ++i)
      bytes[i * kChannels + c] = static_cast<std::byte>(srgb8_from_linear(channels[c]->values[i]));
  }
  return bytes;
}

}  // namespace

/// A running ffmpeg.
struct FilmFile::Process {
  fs::path path;
  fs::path temporary;
  FilmOptions options;
  pid_t child = -1;
  int frames = -1;                ///< socket to ffmpeg's standard input
  std::FILE* messages = nullptr;  ///< its standard error, as a file without a name

  explicit Process(fs::path named) : path(std::move(named)) {}
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (child > 0) ::kill(-child, SIGKILL);  // it leads a group
    (void)wait();
    if (messages != nullptr) (void)std::fclose(messages);
    std::error_code ignored;
    if (!temporary.empty()) fs::remove(temporary, ignored);
  }

  /// Ends its input and waits for it. Returns whether it succeeded.
  bool wait() {
    if (frames >= 0) ::close(std::exchange(frames, -1));
    int status = -1;
    const pid_t waited = std::exchange(child, -1);
    if (waited <= 0) return false;
    while (::waitpid(waited, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  /// The last line that it has printed.
  [[nodiscard]] std::string last_message() const {
    std::string text;
    std::array<char, 512> line{};
    std::rewind(messages);
    while (std::fgets(line.data(), static_cast<int>(line.size()), messages) != nullptr)
      text = line.data();
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    return text.empty() ? "it says nothing" : text;
  }
};

bool is_film_name(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".mp4" || extension == ".webm";
}

fs::path unfinished_film(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), ::getpid());
}

FilmFile::FilmFile(std::unique_ptr<Process> process) : process_(std::move(process)) {}
FilmFile::FilmFile(FilmFile&&) noexcept = default;
FilmFile& FilmFile::operator=(FilmFile&&) noexcept = default;
FilmFile::~FilmFile() = default;

Result<FilmFile> FilmFile::open(const fs::path& path, const FilmOptions& options) {
  assert(is_film_name(path) && options.width > 0 && options.height > 0);
  auto process = std::make_unique<Process>(path);
  process->options = options;
  process->temporary = unfinished_film(path);
  process->messages = std::tmpfile();
  // A socket, so that a write after ffmpeg's end is an error and no signal.
  int ends[2] = {-1, -1};
  if (process->messages == nullptr ||
      ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return make_error("{}: ffmpeg cannot be started: too many files are open", path.string());
  process->frames = ends[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(process->messages), STDERR_FILENO);
  // In a group of its own, Ctrl-C reaches only this process, which then ends the other.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> words = arguments_for(path, process->temporary, options);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int failed =
      ::posix_spawnp(&process->child, "ffmpeg", &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed != 0) {
    process->child = -1;
    return make_error(
        "{}: films are written by ffmpeg, which is not installed; install it, or name a .png for "
        "numbered images",
        path.string());
  }
  return FilmFile(std::move(process));
}

Error FilmFile::failure() {
  (void)process_->wait();
  return make_error("{}: ffmpeg cannot write it: {}", process_->path.string(),
                    process_->last_message());
}

Status FilmFile::add(const Image& frame) {
  assert(frame.width == process_->options.width && frame.height == process_->options.height);
  const std::vector<std::byte> bytes = bytes_of(frame);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t sent =
        ::send(process_->frames, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return failure();
    done += static_cast<std::size_t>(sent);
  }
  return {};
}

Status FilmFile::finish() {
  if (!process_->wait()) return failure();
  RELIEF_TRY(move_into_place(process_->temporary, process_->path));
  process_->temporary.clear();
  return {};
}

}  // namespace relief
