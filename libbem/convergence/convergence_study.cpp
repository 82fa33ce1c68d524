#include "convergence/convergence_study.hpp"

#include "kernels/scheme.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Field = std::vector<double> BodyMotion::*;

Eigen::Map<const VectorXd> vector_of(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Products of the differences from the scene's own run, by run.
MatrixXd products_of(const std::vector<StudyRun>& runs, std::size_t body, Field field) {
  const auto n = static_cast<Eigen::Index>(runs.size());
  const auto own = vector_of(runs[0].motions[body].*field);
  MatrixXd differences(own.size(), n);
  for (Eigen::Index k = 0; k < n; ++k)
    differences.col(k) = vector_of(runs[static_cast<std::size_t>(k)].motions[body].*field) - own;
  return differences.transpose() * differences;
}

/// Over several bodies.
double root_mean_square(const StudyRun& run, const std::vector<std::size_t>& bodies, Field field) {
  double sum = 0;
  for (std::size_t b : bodies) sum += vector_of(run.motions[b].*field).squaredNorm();
  return std::sqrt(sum / static_cast<double>(bodies.size()));
}

double beyond(double rounding, double value) {
  return value > rounding ? value : 0;
}

/// One direction in which levels differ.
struct Series {
  std::vector<std::size_t> runs;  ///< coarse ones first
  std::vector<double> sizes;
};

Series series_of(const std::vector<StudyRun>& runs, int StudyLevel::*varied, int StudyLevel::*fixed,
                 const std::function<double(const StudyRun&)>& size) {
  Series out;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (runs[k].level.*fixed == 0) out.runs.push_back(k);
  std::sort(out.runs.begin(), out.runs.end(), [&](std::size_t a, std::size_t b) {
    return runs[a].level.*varied < runs[b].level.*varied;
  });
  for (std::size_t k : out.runs) out.sizes.push_back(size(runs[k]));
  return out;
}

class Evaluation {
 public:
  Evaluation(const std::vector<StudyRun>& runs, double time_order)
      : runs_(runs),
        time_order_(time_order),
        mesh_(series_of(runs, &StudyLevel::mesh, &StudyLevel::time,
                        [](const StudyRun& run) { return 1 / std::sqrt(run.nodes); })),
        time_(series_of(runs, &StudyLevel::time, &StudyLevel::mesh,
                        [](const StudyRun& run) { return run.time_step; })) {
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (runs[k].level.mesh >= runs[finest_].level.mesh &&
          runs[k].level.time >= runs[finest_].level.time)
        finest_ = k;
  }

  StudyResult run() const {
    StudyResult out;
    const std::size_t count = runs_[0].motions.size();
    Bodies all;
    for (std::size_t b = 0; b < count; ++b) {
      out.bodies.push_back(motion({b}));
      all.push_back(b);
    }
    out.all = motion(all);
    return out;
  }

 private:
  using Bodies = std::vector<std::size_t>;

  MotionResult motion(const Bodies& bodies) const {
    return {quantity(bodies, &BodyMotion::position, &BodyMotion::path),
            quantity(bodies, &BodyMotion::rigid, &BodyMotion::path),
            quantity(bodies, &BodyMotion::deformation, &BodyMotion::deformation)};
  }
  QuantityResult quantity(const Bodies& bodies, Field field, Field size) const;
  double most(const Bodies& bodies, Field field) const;
  std::optional<SeriesResult> result_of(const Series& series, const MatrixXd& products,
                                        double order, double rounding) const;
  VectorXd limit(const SeriesResult& series) const;
  VectorXd unit(std::size_t run) const {
    return VectorXd::Unit(static_cast<Eigen::Index>(runs_.size()), static_cast<Eigen::Index>(run));
  }

  const std::vector<StudyRun>& runs_;
  double time_order_;
  Series mesh_, time_;
  std::size_t finest_ = 0;
};

QuantityResult Evaluation::quantity(const Bodies& bodies, Field field, Field size) const {
  const auto n = static_cast<Eigen::Index>(runs_.size());
  constexpr double kRounding = 1e-12;
  const double rounding = kRounding * most(bodies, &BodyMotion::position);
  QuantityResult out;
  MatrixXd products = MatrixXd::Zero(n, n);
  for (std::size_t b : bodies)
    products += products_of(runs_, b, field) / static_cast<double>(bodies.size());
  if (most(bodies, size) > rounding) out.size = root_mean_square(runs_[finest_], bodies, size);
  out.mesh = result_of(mesh_, products, kExpectedMeshOrder, rounding);
  out.time = result_of(time_, products, time_order_, rounding);
  VectorXd limit = unit(finest_);
  for (const auto* series : {&out.mesh, &out.time})
    if (*series) limit += this->limit(**series) - unit((*series)->runs.back());
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    out.from_finest.push_back(beyond(rounding, norm_of(unit(finest_) - unit(k), products)));
    out.error.push_back(beyond(rounding, norm_of(limit - unit(k), products)));
  }
  return out;
}

/// The largest root mean square of all runs.
double Evaluation::most(const Bodies& bodies, Field field) const {
  double most = 0;
  for (const StudyRun& run : runs_) most = std::max(most, root_mean_square(run, bodies, field));
  return most;
}

/// The limit of a series by all runs.
VectorXd Evaluation::limit(const SeriesResult& series) const {
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(runs_.size()));
  for (std::size_t i = 0; i < series.runs.size(); ++i)
    out += series.trend.limit[static_cast<Eigen::Index>(i)] * unit(series.runs[i]);
  return out;
}

std::optional<SeriesResult> Evaluation::result_of(const Series& series, const MatrixXd& products,
                                                  double order, double rounding) const {
  const std::size_t n = series.runs.size();
  if (n < 2) return std::nullopt;
  MatrixXd own(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      own(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = products(
          static_cast<Eigen::Index>(series.runs[i]), static_cast<Eigen::Index>(series.runs[j]));
  SeriesResult out;
  out.runs = series.runs;
  out.same = own.diagonal().maxCoeff() <= rounding * rounding;  // distances from the scene's run
  if (out.same) own.setZero();
  out.trend = find_trend(series.sizes, own, order);
  if (out.same) return out;
  out.scene_error = norm_of(limit(out) - unit(0), products);
  return out;
}

}  // namespace

StudyRun simulate_level(const Scene& scene, ModelSource& source, const StudyLevel& level,
                        const StudyTimes& times,
                        const std::vector<std::shared_ptr<const FollowedPoints>>& points,
                        const std::function<void(double)>& done) {
  StudyRun run;
  run.level = level;
  run.time_step = scene.time_step;
  Simulation simulation(scene, source);
  for (const Body& body : simulation.bodies())
    if (!body.is_rigid()) run.nodes += static_cast<double>(body.model().nodes());
  MotionRecorder recorder(points, simulation, static_cast<std::size_t>(times.count) + 1);
  recorder.record(simulation);
  const auto in_level = [&](long steps) {
    return std::lround(std::ldexp(static_cast<double>(steps), level.time));
  };
  run.steps = in_level(times.steps());
  while (simulation.steps() < run.steps) {
    simulation.step();
    run.unmet_steps += !simulation.statistics().converged();
    if (!run.first_touch && !simulation.contacts().empty()) run.first_touch = simulation.time();
    if (simulation.steps() % in_level(times.interval) == 0) recorder.record(simulation);
    done(static_cast<double>(simulation.steps()) / static_cast<double>(run.steps));
  }
  run.motions = recorder.take();
  return run;
}

double expected_time_order(const Scene& scene) {
  double order = 2;
  for (const BodySpec& body : scene.bodies) {
    const Scheme scheme = Scheme::parse(body.source->settings.scheme_name());
    if (scheme.is_multistep() && scheme.theta() < 1) order = 1;
  }
  return order;
}

StudyResult evaluate_study(const std::vector<StudyRun>& runs, double expected_time_order) {
  return Evaluation(runs, expected_time_order).run();
}

}  // namespace bem
