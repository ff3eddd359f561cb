#include "cli/interrupt.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>

#include "cli/messages.h"
#include "common/image/film_file.h"
#include "common/io/file.h"

namespace relief::cli {
namespace {

// A signal handler can reach nothing but globals; these are the only ones in the project.
volatile std::sig_atomic_t g_interrupted = 0;
int g_wake_watch = -1;

extern "C" void remember_interrupt(int /*signal*/) {
  g_interrupted = 1;
  const std::uint64_t one = 1;
  // Nothing can be done if it fails: then only jobs that look see the interrupt.
  [[maybe_unused]] const ssize_t written = ::write(g_wake_watch, &one, sizeof one);
}

struct Files {
  std::mutex mutex;
  std::vector<std::filesystem::path> outputs;
  std::function<std::string()> kept;
  bool are_complete = false;
};

Files& files() {
  static Files all;
  return all;
}

/// Waits for an interrupt, and ends the process if it is still there after the grace.
void watch(int woken_by) {
  std::uint64_t count = 0;
  while (::read(woken_by, &count, sizeof count) != sizeof count) {
  }
  std::this_thread::sleep_for(kInterruptGrace);
  Files& all = files();
  const std::lock_guard lock(all.mutex);
  if (all.are_complete) return;
  for (const auto& output : all.outputs) {
    remove_unfinished_files(output);
    // What writes a film goes on in a file without a name, and ends when its input does.
    if (is_film_name(output)) ::unlink(unfinished_film(output).c_str());
  }
  print_last_message(interrupt_message(all.kept ? all.kept() : std::string()));
  ::_exit(kFailed);
}

}  // namespace

void handle_signals() {
  g_wake_watch = ::eventfd(0, EFD_CLOEXEC);
  if (g_wake_watch >= 0) std::thread(watch, g_wake_watch).detach();
  struct sigaction action {};
  action.sa_handler = remember_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A terminal that closes; `nohup` has it ignored.
  struct sigaction inherited {};
  if (sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
  sigaction(SIGPIPE, &ignore, nullptr);
}

bool interrupted() {
  return g_interrupted != 0;
}

InterruptedFiles::InterruptedFiles(std::vector<std::filesystem::path> outputs,
                                   std::function<std::string()> kept) {
  Files& all = files();
  const std::lock_guard lock(all.mutex);
  all.outputs = std::move(outputs);
  all.kept = std::move(kept);
  all.are_complete = false;
}

void InterruptedFiles::note_complete() {
  Files& all = files();
  const std::lock_guard lock(all.mutex);
  all.are_complete = true;
}

InterruptedFiles::~InterruptedFiles() {
  Files& all = files();
  const std::lock_guard lock(all.mutex);
  all.outputs.clear();
  all.kept = nullptr;
}

std::string interrupt_message(const std::string& kept) {
  return "interrupted; " + (kept.empty() ? "nothing was written" : kept);
}

}  // namespace relief::cli
