#include "scene_examples.hpp"

#include <random>

#include <catch2/catch.hpp>

namespace {

enum class Outcome { parsed, refused, other };

Outcome outcome_of(const std::string& text) {
  try {
    bem::parse_scene("s.json", text);
    return Outcome::parsed;
  } catch (const bem::Error& error) {
    const std::string message = error.what();
    const bool placed = message.compare(0, 7, "s.json:") == 0 && message.size() > 12;
    return error.code() == bem::ErrorCode::invalid_input && placed ? Outcome::refused
                                                                   : Outcome::other;
  } catch (...) {
    return Outcome::other;
  }
}

/// `text` with one byte replaced, deleted or inserted at a random place.
std::string damaged(std::string text, std::mt19937& random) {
  const std::string alphabet =
      std::string("{}[]\",:.-+eE0123456789 \n\\/tfnaxyz_#'") + '\0' + '\xC3' + '\xFF';
  const std::size_t at = random() % text.size();
  const char c = alphabet[random() % alphabet.size()];
  switch (random() % 3) {
    case 0:
      text[at] = c;
      break;
    case 1:
      text.erase(at, 1);
      break;
    default:
      text.insert(at, 1, c);
  }
  return text;
}

}  // namespace

TEST_CASE("a damaged scene is read or refused with its place, nothing else") {
  std::mt19937 random(20240607);
  int parsed = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = damaged(bem::test::full_scene(), random);
    if (i % 2 == 1) text = damaged(damaged(text, random), random);
    const Outcome outcome = outcome_of(text);
    if (outcome == Outcome::other) FAIL("unexpected outcome of the scene " << text);
    ++(outcome == Outcome::parsed ? parsed : refused);
  }
  // Digits and blanks can change without harm, most other characters cannot.
  REQUIRE(parsed > 150);
  REQUIRE(refused > 2000);
}

TEST_CASE("a scene that ends too early is refused wherever it ends") {
  const std::string& text = bem::test::full_scene();
  for (std::size_t n = 0; n < text.size(); ++n)
    REQUIRE(outcome_of(text.substr(0, n)) == Outcome::refused);
}
