#pragma once

#include "base/error.hpp"

#include <limits>
#include <string>
#include <type_traits>

namespace bem {

/// The same integer in another type. Throws Error with `code` and `what`, which names the place, if
/// the type cannot hold it: for every number out of a file that ends in a narrower type.
template <class To, class From>
To narrow(From value, ErrorCode code, const std::string& what) {
  static_assert(std::is_integral_v<To> && std::is_integral_v<From>, "integers are narrowed");
  const To result = static_cast<To>(value);
  if (static_cast<From>(result) != value || (result < To(0)) != (value < From(0)))
    throw Error(code, what + " is out of range");
  return result;
}

}  // namespace bem
