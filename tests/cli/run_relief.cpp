#include "tests/cli/run_relief.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "models/knot_scan.h"

namespace relief::test {
namespace fs = std::filesystem;
namespace {

/// Both ends of what takes one of the command's output streams.
struct Stream {
  int read_end = -1;
  int write_end = -1;
};

Stream open_pipe() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) std::abort();
  return {ends[0], ends[1]};
}

Stream open_terminal() {
  Stream stream;
  if (openpty(&stream.read_end, &stream.write_end, nullptr, nullptr, nullptr) != 0) std::abort();
  return stream;
}

[[noreturn]] void become_relief(const std::vector<std::string>& arguments,
                                const RunOptions& options, const Stream& out, const Stream& err) {
  if (options.terminal) setenv("TERM", "xterm", 1);  // a test may run where there is none
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  if (options.largest_file) {
    const rlimit limit{*options.largest_file, *options.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(out.write_end, STDOUT_FILENO);
  dup2(err.write_end, STDERR_FILENO);
  for (const int end : {out.read_end, out.write_end, err.read_end, err.write_end}) close(end);
  if (options.closed_out) close(STDOUT_FILENO);
  std::string program = RELIEF_PROGRAM;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

/// Reads what is there; false at the end (of a terminal: EIO once the other side is closed).
bool read_some(int from, std::string& to) {
  std::array<char, 4096> buffer{};
  const ssize_t count = read(from, buffer.data(), buffer.size());
  if (count > 0) to.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// Leaves out "relief: resample 25 %, 14 s left" and "relief: neighbours, 10 s so far".
std::string without_progress(const std::string& text) {
  static const std::regex progress("relief: [a-z ]+( [0-9]+ %(, .* left)?|, .* so far)\n");
  return std::regex_replace(text, progress, "");
}

}  // namespace

Outcome run_relief(const std::vector<std::string>& arguments, const RunOptions& options) {
  const Stream out = open_pipe();
  const Stream err = options.terminal ? open_terminal() : open_pipe();
  if (options.unread_out) close(out.read_end);
  const pid_t child = fork();
  if (child == 0) become_relief(arguments, options, out, err);
  close(out.write_end);
  close(err.write_end);

  Outcome run;
  bool interrupted = options.interrupt_at.empty();
  std::array<pollfd, 2> streams{
      {{options.unread_out ? -1 : out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}}};
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::optional<Clock::time_point> interrupt;
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    poll(streams.data(), streams.size(), options.interrupt_after ? 1 : -1);
    if (options.interrupt_after && !interrupt && Clock::now() - start >= *options.interrupt_after) {
      kill(child, SIGINT);
      interrupt = Clock::now();
    }
    if (streams[0].revents != 0 && !read_some(out.read_end, run.out)) streams[0].fd = -1;
    if (streams[1].revents != 0 && !read_some(err.read_end, run.err)) streams[1].fd = -1;
    if (!interrupted && run.err.find(options.interrupt_at) != std::string::npos) {
      kill(child, SIGINT);
      interrupted = true;
    }
  }
  if (!options.unread_out) close(out.read_end);
  close(err.read_end);
  if (!options.terminal) run.err = without_progress(run.err);
  int status = 0;
  waitpid(child, &status, 0);
  if (interrupt)
    run.seconds_after_interrupt = std::chrono::duration<double>(Clock::now() - *interrupt).count();
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return run;
}

void CliTest::SetUp() {
  std::string name = fs::temp_directory_path() / "relief-test-XXXXXX";
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  directory_ = name;
}

void CliTest::TearDown() {
  fs::remove_all(directory_);
}

std::string CliTest::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(path(name), std::ios::binary) << bytes;
  return path(name);
}

std::string CliTest::write_knot(std::size_t points) const {
  return write("knot.ply", knot_scan_ply(points));
}

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory_)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void CliTest::expect_refused(const std::vector<std::string>& arguments, const std::string& about,
                             const RunOptions& options) const {
  const auto before = files();
  const Outcome run = run_relief(arguments, options);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("relief: ", 0), 0U) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(about), std::string::npos) << run.err << "does not name " << about;
  EXPECT_EQ(files(), before) << "a file was made, lost or left";
}

std::string file_bytes(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace relief::test
