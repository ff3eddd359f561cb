// Turns exceptions of other libraries, and std::bad_alloc, into errors.
#pragma once

#include <cassert>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "common/error.h"

namespace relief {

/// Advice for calls whose input cannot be at fault.
inline constexpr std::string_view kReportDefect =
    "this is a defect: report it with the command and its input";
/// Advice for calls whose need of memory no option lowers.
inline constexpr std::string_view kMoreMemory = "free some memory, or use a machine with more";

/// A guarded call, as its error describes it.
struct GuardedCall {
  std::string_view subject;        ///< begins the error, usually a path; may be empty
  std::string_view task;           ///< a verb and its object: "read it"
  std::string_view library = {};   ///< the library that is called; empty: several
  std::string_view advice;         ///< ends the error of an exception: what the user can do
  std::string_view memory_advice;  ///< ends the error of too little memory
};

/// Returns the error of a call that ran out of memory.
[[nodiscard]] inline Error not_enough_memory(const GuardedCall& call) {
  return make_error("{}{}not enough memory to {}; {}", call.subject,
                    call.subject.empty() ? "" : ": ", call.task, call.memory_advice);
}

/// Returns the error of a call that threw an exception; `reason` is the exception's text.
[[nodiscard]] inline Error call_failed(const GuardedCall& call, std::string_view reason) {
  return make_error("{}{}{} failed to {} ({}); {}", call.subject, call.subject.empty() ? "" : ": ",
                    call.library.empty() ? "Relief" : call.library, call.task, reason, call.advice);
}

/// Calls `work` and returns its Result or Status, or an error if it throws. Each call into a
/// library that may throw on hostile input goes through here, and so does each public function
/// whose memory depends on its input: no exception leaves our libraries.
template <class Work>
[[nodiscard]] std::invoke_result_t<Work&> guarded(const GuardedCall& call, Work&& work) {
  assert(!call.advice.empty() && !call.memory_advice.empty() && "errors say what to do");
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return not_enough_memory(call);
  } catch (const std::length_error&) {
    return not_enough_memory(call);  // a container would have grown beyond max_size()
  } catch (const std::exception& failure) {
    return call_failed(call, failure.what());
  } catch (...) {
    return call_failed(call, "unknown reason");
  }
}

}  // namespace relief
