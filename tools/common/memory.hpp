#pragma once

namespace bem {

/// Ends the process with exit code 6 and the message "error: not enough memory", without needing
/// any; the message is left out after errors_are_told(). What is written under temporary names is
/// left to the next run, which removes it.
[[noreturn]] void end_without_memory();

/// From here on stderr has the one error that the process reports.
void errors_are_told();

/// From here on exceptions that nobody catches end the process with a message and an exit code as
/// run_tool's, not with a signal. Failed allocations of C libraries, which abort() or crash then,
/// end it at once; those of C++ are exceptions as ever. Keeps some memory for messages.
void guard_memory();

/// Has this process, or the one from which it was forked, called guard_memory()?
bool is_guarded();

/// Gives back the memory that is kept for messages.
void release_memory_reserve();

}  // namespace bem
