#pragma once

#include <stdexcept>
#include <string>

namespace bem {

/// What went wrong, as the exit code that both tools return for it.
enum class ErrorCode {
  internal = 1,       ///< a broken invariant of the program itself
  usage = 2,          ///< wrong command line
  invalid_input = 3,  ///< mesh or JSON that cannot be used
  archive = 4,        ///< archive missing, damaged or not fitting the scene
  numerical = 5,      ///< a number is not finite, or a matrix or step cannot be solved
  resources = 6,      ///< memory, disk or permission
};

/// The one exception type of the library. The message is complete: it names file, place and cure.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

/// Checks an invariant of the program in every build; throws ErrorCode::internal with `what`.
inline void require(bool condition, const char* what) {
  if (!condition) throw Error(ErrorCode::internal, std::string("broken invariant: ") + what);
}

}  // namespace bem
