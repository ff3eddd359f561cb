// A child process for a library that trusts its files: what it makes of one comes through a pipe.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// The end of the pipe into which the child writes.
class ChildOutput {
 public:
  explicit ChildOutput(int pipe) : pipe_(pipe) {}
  /// False if the parent has gone.
  [[nodiscard]] bool write(const void* bytes, std::size_t size) const;

 private:
  int pipe_;
};

/// Linux. The child ends with its parent, and when this object goes.
class ConfinedChild {
 public:
  ConfinedChild() = default;
  ~ConfinedChild();
  ConfinedChild(const ConfinedChild&) = delete;
  ConfinedChild& operator=(const ConfinedChild&) = delete;

  /// Starts `work`, which may take `memory` more bytes than this process has. Its exceptions and
  /// its faults end the child. Fails, with a clause, if no process can be started.
  Status start(std::uint64_t memory, const std::function<void(const ChildOutput&)>& work);

  enum class Got : std::uint8_t { All, Interrupted, Ended };
  /// Waits for that many bytes. Ended: the child has ended before.
  [[nodiscard]] Got read(void* bytes, std::size_t size, const Progress& progress) const;

 private:
  pid_t child_ = -1;
  int pipe_ = -1;
};

}  // namespace relief
