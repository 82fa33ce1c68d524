#include "base/interruption.hpp"

#include <utility>

namespace bem {
namespace {

std::function<void()>& installed_check() {
  static std::function<void()> check;
  return check;
}

}  // namespace

void set_interruption_check(std::function<void()> check) {
  installed_check() = std::move(check);
}

void check_interruption() {
  const std::function<void()>& check = installed_check();
  if (check) check();
}

}  // namespace bem
