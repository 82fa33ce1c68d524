#include "dynamics/vibration_watch.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// A motion of 30 displacements: a deflection, and vibrations of different shapes.
class Oscillation {
 public:
  struct Mode {
    double amplitude, growth, frequency;
  };
  explicit Oscillation(std::vector<Mode> modes) : modes_(std::move(modes)) {}

  Eigen::VectorXd at(int step) const {
    Eigen::VectorXd out(30);
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      out[i] = std::cos(0.3 * static_cast<double>(i));
      double shape = 1;
      for (const Mode& m : modes_) {
        shape += 1;
        out[i] += m.amplitude * std::pow(m.growth, step) *
                  std::cos(2 * kPi * m.frequency * step + shape * static_cast<double>(i * i));
      }
    }
    return out;
  }

 private:
  std::vector<Mode> modes_;
};

std::optional<Vibration> watched(const Oscillation& motion, int steps) {
  VibrationWatch watch;
  for (int n = 0; n < steps; ++n) watch.add(motion.at(n));
  return watch.growing();
}

}  // namespace

TEST_CASE("a vibration that grows is found among others", "[dynamics]") {
  const Oscillation motion(
      {{0.1, 1.001, 0.021}, {0.05, 0.99, 0.11}, {0.2, 1, 0.013}, {0.1, 0.8, 0.3}});
  for (const int steps : {110, 512, 1000}) {
    const auto found = watched(motion, steps);
    REQUIRE(found);
    CHECK(std::abs(found->growth - 1.001) < 1e-6);
    CHECK(std::abs(found->frequency - 0.021) < 1e-6);
  }
}

TEST_CASE("what does not grow is not reported", "[dynamics]") {
  CHECK(!watched(Oscillation({{0.1, 1, 0.021}, {0.05, 0.99, 0.11}, {0.2, 1, 0.013}}), 700));
  CHECK(!watched(Oscillation({{0.1, 0.999, 0.021}, {0.1, 0.9, 0.2}}), 300));
  CHECK(!watched(Oscillation({{0, 1, 0.1}}), 300));                         // at rest
  CHECK(!watched(Oscillation({{1e-8, 1.01, 0.021}}), 100));                 // rounding
  CHECK(!watched(Oscillation({{0.1, 1.01, 0.015}}), 100));                  // not yet two periods
  CHECK(!watched(Oscillation({{0.1, 1.001, 0.1}}), 40));                    // too short
  CHECK(!watched(Oscillation({{1, 1, 0.04}, {1e-3, 1.002, 0.021}}), 300));  // a small part
}

TEST_CASE("disturbances begin a new motion", "[dynamics]") {
  // pushed again and again: larger every time, but decaying in between
  const Oscillation decaying({{0.1, 0.998, 0.021}, {0.05, 0.99, 0.11}});
  VibrationWatch watch;
  for (int push = 0; push < 4; ++push) {
    for (int n = 0; n < 90; ++n) watch.add((1 + push) * decaying.at(n));
    watch.interrupt();
  }
  CHECK(!watch.growing());

  // nothing of what came before an interruption counts
  const Oscillation quick({{0.1, 1.001, 0.1}});
  VibrationWatch brief;
  for (int n = 0; n < 200; ++n) {
    if (n % 50 == 0) brief.interrupt();
    brief.add(quick.at(n));
  }
  CHECK(!brief.growing());
  CHECK(watched(quick, 200));

  // a disturbance that nobody tells of is not mistaken for growth
  VibrationWatch surprised;
  for (int n = 0; n < 120; ++n) surprised.add((n < 70 ? 1 : 2) * decaying.at(n));
  CHECK(!surprised.growing());
  VibrationWatch driven;  // by a jolt in every period
  for (int n = 0; n < 200; ++n)
    driven.add(Oscillation({{0.1 * std::pow(1.3, n / 25), 1, 0.04}}).at(n));
  CHECK(!driven.growing());

  // what has been found before an interruption is remembered
  const Oscillation growing({{0.1, 1.003, 0.021}});
  VibrationWatch both;
  for (int n = 0; n < 200; ++n) both.add(growing.at(n));
  both.interrupt();
  for (int n = 0; n < 200; ++n) both.add(decaying.at(n));
  REQUIRE(both.growing());
  CHECK(std::abs(both.growing()->growth - 1.003) < 1e-6);
}
