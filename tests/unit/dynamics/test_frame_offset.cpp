#include "dynamics/frame_offset.hpp"
#include "support/schemes.hpp"

#include <string>

#include <catch2/catch.hpp>

using namespace bem;
using bem_test::kSchemes;

namespace {

int stages_of(const std::string& scheme) {
  return Scheme::parse(scheme).stages();
}

/// Differences of the accelerations that have nothing regular about them.
Eigen::MatrixXd differences(const std::string& scheme, int step, double phase) {
  Eigen::MatrixXd e(6, stages_of(scheme));
  for (Eigen::Index j = 0; j < e.cols(); ++j)
    for (Eigen::Index i = 0; i < 6; ++i)
      e(i, j) = std::sin(phase + 1.7 * step + 0.9 * static_cast<double>(j) +
                         2.3 * static_cast<double>(i));
  return e;
}

Vector6 components() {
  return (Vector6() << 1, -2, 3, 0.4, -0.5, 0.6).finished();
}

/// The offset at the time 1 under differences that grow with a power of the time, from rest.
Vector6 after_power(const std::string& name, int steps, int power,
                    const FrameOffset::Leak& leak = {}) {
  const Scheme scheme = Scheme::parse(name);
  FrameOffset offset(scheme, 1.0 / steps);
  offset.set_leak(leak);
  Eigen::MatrixXd last;
  for (int i = 0; i < steps; ++i) {
    const Eigen::ArrayXd times = (scheme.stage_times().array() + i) / steps;
    const Eigen::MatrixXd e = components() * times.pow(power).matrix().transpose();
    last = offset.stages(e);
    offset.advance(e);
  }
  return last.col(last.cols() - 1);
}

}  // namespace

TEST_CASE("without a leak the offset is the double integral of the differences") {
  for (const std::string scheme : {"radau2", "radau3"}) {
    INFO(scheme);
    CHECK((after_power(scheme, 10, 0) - components() / 2).norm() < 1e-13);
  }
  for (const auto& [scheme, order] : {std::pair<const char*, int>{"bdf1", 1}, {"bdf2", 2}}) {
    const double coarse = (after_power(scheme, 20, 2) - components() / 12).norm(),
                 fine = (after_power(scheme, 40, 2) - components() / 12).norm();
    INFO(scheme << ": errors " << coarse << ", " << fine);
    CHECK(std::log2(coarse / fine) == Approx(order).margin(0.3));
  }
}

TEST_CASE("a critical leak is a critically damped oscillator") {
  const double w = 4;
  const Vector6 exact = components() / (w * w) * (1 - (1 + w) * std::exp(-w));
  // not BDF2, which is of first order for differences that begin at once
  for (const auto& [scheme, order] :
       {std::pair<const char*, int>{"bdf1", 1}, {"radau2", 3}, {"radau3", 5}}) {
    const auto leak = FrameOffset::Leak::critical(w);
    const double coarse = (after_power(scheme, 20, 0, leak) - exact).norm(),
                 fine = (after_power(scheme, 40, 0, leak) - exact).norm();
    INFO(scheme << ": errors " << coarse << ", " << fine);
    CHECK(coarse < 0.05 * exact.norm());
    CHECK(std::log2(coarse / fine) > order - 0.4);
  }
}

TEST_CASE("under a leak a lasting difference ends at difference over stiffness") {
  for (const std::string scheme : kSchemes) {
    INFO(scheme);
    FrameOffset offset(Scheme::parse(scheme), 0.05);
    offset.set_leak({5, 4});
    const Eigen::MatrixXd e = components().replicate(1, stages_of(scheme));
    for (int i = 0; i < 2000; ++i) offset.advance(e);
    CHECK((offset.stages(e) - e / 4).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("gain is the derivative of the offsets by the differences") {
  for (const std::string scheme : kSchemes)
    for (const FrameOffset::Leak& leak : {FrameOffset::Leak{}, FrameOffset::Leak{3, 7}}) {
      FrameOffset offset(Scheme::parse(scheme), 0.1);
      offset.set_leak(leak);
      for (int i = 0; i < 3; ++i) offset.advance(differences(scheme, i, 0));
      const Eigen::MatrixXd e = differences(scheme, 3, 0), before = offset.stages(e);
      for (Eigen::Index j = 0; j < e.cols(); ++j) {
        Eigen::MatrixXd changed = e;
        changed(2, j) += 1;
        const Eigen::MatrixXd change = offset.stages(changed) - before;
        INFO(scheme << " by stage " << j);
        CHECK((change.row(2).transpose() - Eigen::VectorXd(offset.gain().col(j))).norm() < 1e-14);
        CHECK(change.topRows<2>().norm() + change.bottomRows<3>().norm() == 0);
      }
    }
}

TEST_CASE("offsets of two motions add up to that of their sum") {
  for (const std::string scheme : kSchemes) {
    INFO(scheme);
    FrameOffset first(Scheme::parse(scheme), 0.1), second = first, both = first;
    for (FrameOffset* offset : {&first, &second, &both}) offset->set_leak({0.5, 2});
    double size = 0;
    for (int i = 0; i < 30; ++i) {
      const Eigen::MatrixXd e = differences(scheme, i, 0), f = differences(scheme, i, 1);
      const Eigen::MatrixXd sum = both.stages(e + f);
      size = std::max(size, sum.cwiseAbs().maxCoeff());
      CHECK((first.stages(e) + second.stages(f) - sum).cwiseAbs().maxCoeff() < 1e-13);
      first.advance(e);
      second.advance(f);
      both.advance(e + f);
    }
    CHECK(size > 0.05);
  }
}

TEST_CASE("what has a rate goes on with it") {
  for (const std::string scheme : {"radau2", "radau3"}) {
    INFO(scheme);
    const double dt = 0.1;
    FrameOffset offset(Scheme::parse(scheme), dt);
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(6, stages_of(scheme));
    offset.advance(components().replicate(1, stages_of(scheme)));
    for (int i = 1; i <= 5; ++i) {  // after one step: place dt^2/2, rate dt
      const Vector6 expected = (0.5 * dt * dt + i * dt * dt) * components();
      CHECK((offset.stages(none).rightCols<1>() - expected).norm() < 1e-14);
      offset.advance(none);
    }
  }
}
