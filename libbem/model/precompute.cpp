#include "model/precompute.hpp"

#include "algebra/lu.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "model/growth.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace bem {
namespace {

constexpr int kSymmetric[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
constexpr int kTileVertices = 8;

/// The system matrices of lag 0 while they are still to be factorised, by initial component.
struct InitialSystem {
  std::vector<DenseMatrix<Complex>> h, g;  // complex also where a component is real
};

/// The static matrices: H(0) transposed, for its left null space, and G(0).
struct StaticSystem {
  DenseMatrix<double> h_transposed, g;
};

template <class T>
std::vector<std::unique_ptr<StoredMatrix>> make_stores(std::size_t count, std::size_t n) {
  std::vector<std::unique_ptr<StoredMatrix>> stores;
  for (std::size_t i = 0; i < count; ++i) stores.push_back(std::make_unique<DenseStore<T>>(n, n));
  return stores;
}

/// Moves the lanes of an assembled block row into the matrices of all lags.
template <class T, class Stored>
class RowDistributor {
 public:
  RowDistributor(const RowAssembler& assembler, BodyModel& model, InitialSystem& initial,
                 StaticSystem& at_rest)
      : layout_(assembler.layout()),
        static_factors_(static_lane_factors(model.discretisation.scheme, layout_)),
        model_(model),
        initial_(initial),
        at_rest_(at_rest) {}

  void lags(int i, const BlockRow<T>& row) {
    const int n = static_cast<int>(model_.nodes());
    for (int lane = layout_.initial; lane < layout_.count(); ++lane) {
      const int index = lane - layout_.initial;
      for (int r = 0; r < 3; ++r) {
        Stored* h = static_cast<DenseStore<Stored>&>(*model_.h[index]).row(3 * i + r);
        Stored* g = static_cast<DenseStore<Stored>&>(*model_.g[index]).row(3 * i + r);
        for (int j = 0; j < n; ++j)
          for (int c = 0; c < 3; ++c) {
            h[3 * j + c] =
                static_cast<Stored>(row.h_block(j)[(3 * r + c) * row.padded_lanes + lane]);
            g[3 * j + c] = static_cast<Stored>(
                row.g_block(j)[kSymmetric[3 * r + c] * row.padded_lanes + lane]);
          }
      }
    }
  }

  void static_row(int i, const BlockRow<T>& row) {
    const int n = static_cast<int>(model_.nodes());
    const auto sum = [this](const T* lanes) {
      double total = 0;
      for (int lane = 0; lane < layout_.count(); ++lane)
        total += static_factors_[lane] * lanes[lane];
      return total;
    };
    for (int j = 0; j < n; ++j)
      for (int e = 0; e < 9; ++e) {
        const int r = 3 * i + e / 3, c = 3 * j + e % 3;
        at_rest_.h_transposed(c, r) = sum(row.h_block(j) + e * row.padded_lanes);
        at_rest_.g(r, c) = sum(row.g_block(j) + kSymmetric[e] * row.padded_lanes);
      }
  }

  void body_force(int i, const BlockRow<T>& row) {
    const auto value = [&row](const AlignedVector<double>& block, int e, int lane) {
      return block[e * row.padded_lanes + lane];
    };
    for (int e = 0; e < 9; ++e) {
      const int r = 3 * i + e / 3, c = e % 3;
      for (int lane = layout_.initial; lane < layout_.count(); ++lane) {
        model_.body_force[lane - layout_.initial](r, c) = value(row.d, e, lane);
        model_.body_force[lane - layout_.initial](r, 3 + c) = value(row.q, e, lane);
      }
      for_each_initial([&](std::size_t component, int lane, bool paired) {
        Eigen::MatrixXcd& m = model_.initial_body_force[component];
        m(r, c) = Complex(value(row.d, e, lane), paired ? value(row.d, e, lane + 1) : 0.0);
        m(r, 3 + c) = Complex(value(row.q, e, lane), paired ? value(row.q, e, lane + 1) : 0.0);
      });
    }
  }

  /// Rows of lag 0 of a tile of vertices, written column by column (the matrices are column-major).
  void initial_rows(int first, const std::vector<BlockRow<T>>& rows, int count) {
    const int n = static_cast<int>(model_.nodes());
    for_each_initial([&](std::size_t component, int lane, bool paired) {
      for (int j = 0; j < n; ++j)
        for (int c = 0; c < 3; ++c) {
          Complex* h = &initial_.h[component](3 * first, 3 * j + c);
          Complex* g = &initial_.g[component](3 * first, 3 * j + c);
          for (int v = 0; v < count; ++v)
            for (int r = 0; r < 3; ++r) {
              const T* hb = rows[v].h_block(j) + (3 * r + c) * rows[v].padded_lanes + lane;
              const T* gb =
                  rows[v].g_block(j) + kSymmetric[3 * r + c] * rows[v].padded_lanes + lane;
              h[3 * v + r] = Complex(hb[0], paired ? hb[1] : T(0));
              g[3 * v + r] = Complex(gb[0], paired ? gb[1] : T(0));
            }
        }
    });
  }

 private:
  template <class F>
  void for_each_initial(const F& f) const {
    const auto& components = model_.discretisation.scheme.initial_components();
    for (std::size_t i = 0, lane = 0; i < components.size(); ++i) {
      f(i, static_cast<int>(lane), components[i].paired);
      lane += components[i].paired ? 2 : 1;
    }
  }

  LaneLayout layout_;
  std::vector<double> static_factors_;
  BodyModel& model_;
  InitialSystem& initial_;
  StaticSystem& at_rest_;
};

template <class T, class Stored>
void assemble(const RowAssembler& assembler, BodyModel& model, InitialSystem& initial,
              StaticSystem& at_rest, const Progress& progress) {
  const int n = static_cast<int>(model.nodes());
  const std::size_t tiles = (n + kTileVertices - 1) / kTileVertices;
  RowDistributor<T, Stored> distribute(assembler, model, initial, at_rest);
  std::vector<double> residuals(n, 0.0);
  std::atomic<std::size_t> done{0};
  parallel_for(tiles, [&](std::size_t tile) {
    thread_local RowAssembler::Workspace work;
    thread_local std::vector<BlockRow<T>> rows(kTileVertices);
    const int first = static_cast<int>(tile) * kTileVertices;
    const int count = std::min(kTileVertices, n - first);
    for (int v = 0; v < count; ++v) {
      residuals[first + v] = assembler.assemble(first + v, true, work, rows[v]);
      distribute.lags(first + v, rows[v]);
      distribute.body_force(first + v, rows[v]);
      distribute.static_row(first + v, rows[v]);
    }
    distribute.initial_rows(first, rows, count);
    if (progress) progress("assembly", static_cast<double>(++done) / static_cast<double>(tiles));
  });
  model.report.row_sum_residual = *std::max_element(residuals.begin(), residuals.end());
}

/// Row-major copy of the real or imaginary part of a column-major matrix.
template <class Stored, class Part>
std::unique_ptr<StoredMatrix> store_part(Eigen::Index n, const Part& part) {
  auto store = std::make_unique<DenseStore<Stored>>(n, n);
  constexpr Eigen::Index kTile = 64;
  parallel_for((n + kTile - 1) / kTile, [&](std::size_t tile) {
    const Eigen::Index begin = static_cast<Eigen::Index>(tile) * kTile;
    const Eigen::Index end = std::min(n, begin + kTile);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = begin; i < end; ++i) store->row(i)[j] = static_cast<Stored>(part(i, j));
  });
  return store;
}

template <class Stored, class T>
SpectralMatrix store_spectral(const DenseMatrix<T>& m) {
  SpectralMatrix out;
  if constexpr (std::is_same_v<T, Complex>) {
    out.real = store_part<Stored>(m.rows(), [&m](auto i, auto j) { return m(i, j).real(); });
    out.imaginary = store_part<Stored>(m.rows(), [&m](auto i, auto j) { return m(i, j).imag(); });
  } else {
    out.real = store_part<Stored>(m.rows(), [&m](auto i, auto j) { return m(i, j); });
  }
  return out;
}

/// |H_0 W + s^2 Q_0| relative to |H_0|: rotation is not imposed, so this measures the quadrature.
double rotation_residual(const BodyModel& model, const DenseMatrix<Complex>& h0) {
  const Scheme& scheme = model.discretisation.scheme;
  Eigen::MatrixXcd w(3 * static_cast<Eigen::Index>(model.nodes()), 3);
  for (std::size_t i = 0; i < model.nodes(); ++i)
    w.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        cross_matrix(model.geometry.nodes.vertices[i]).transpose().cast<Complex>();
  const Complex s = scheme.initial_components()[0].eigenvalue / model.discretisation.dt;
  const Eigen::MatrixXcd r = h0 * w + s * s * model.initial_body_force[0].rightCols(3);
  return r.cwiseAbs().maxCoeff() / model.geometry.extent;
}

template <class T, class Stored>
void invert_component(BodyModel& model, DenseMatrix<T>&& h, DenseMatrix<T>&& g,
                      const Progress& progress) {
  if (progress) progress("factorisation", 0);
  Lu<T> lu(std::move(h));
  if (progress) progress("traction response", 0);
  lu.solve(g);
  model.traction_response.push_back(store_spectral<Stored>(g));
  g.resize(0, 0);
  if (progress) progress("inverse", 0);
  const double norm = lu.norm1();
  const DenseMatrix<T> inverse = std::move(lu).invert();
  model.report.condition = std::max(model.report.condition, norm * norm1(inverse));
  model.inverse.push_back(store_spectral<Stored>(inverse));
}

template <class Stored>
void invert_initial(BodyModel& model, InitialSystem& initial, const Progress& progress) {
  model.report.rotation_residual = rotation_residual(model, initial.h[0]);
  const auto& components = model.discretisation.scheme.initial_components();
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].paired) {
      invert_component<Complex, Stored>(model, std::move(initial.h[i]), std::move(initial.g[i]),
                                        progress);
    } else {
      DenseMatrix<double> h = initial.h[i].real(), g = initial.g[i].real();
      initial.h[i].resize(0, 0);
      initial.g[i].resize(0, 0);
      invert_component<double, Stored>(model, std::move(h), std::move(g), progress);
    }
  }
}

/// Left null vectors N (3N x 6) of H(0) by inverse iteration: N^T H(0) u = 0 for every u. With
/// them, N^T (b + D a' + Q alpha) = 0 gives the accelerations that balance a load b.
void compute_balance(BodyModel& model, StaticSystem&& at_rest, const Progress& progress) {
  if (progress) progress("static balance", 0);
  const Scheme& scheme = model.discretisation.scheme;
  const LaneLayout layout(scheme, model.discretisation.history_length);
  const Eigen::MatrixXd body_force =
      static_columns(scheme, layout, model.initial_body_force, model.body_force);
  const auto n = at_rest.g.rows();

  constexpr double kShift = 1e-10;  // keeps the singular matrix factorisable
  at_rest.h_transposed.diagonal().array() += kShift;
  const Lu<double> lu(std::move(at_rest.h_transposed));
  DenseMatrix<double> null = body_force;  // not orthogonal to the null space: the balance exists
  constexpr int kIterations = 4;
  for (int i = 0; i < kIterations; ++i) {
    null = Eigen::HouseholderQR<DenseMatrix<double>>(null).householderQ() *
           DenseMatrix<double>::Identity(n, 6);
    lu.solve(null);
  }
  const Eigen::Matrix<double, 6, 6> inertia = null.transpose() * body_force;
  model.balance = -inertia.inverse() * null.transpose();
  model.traction_balance = model.balance * at_rest.g;
}

template <class T, class Stored>
void compute_matrices(BodyModel& model, const Progress& progress) {
  const RowAssembler assembler(model.geometry.nodes, model.geometry.extent, model.discretisation);
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  const std::size_t lanes = assembler.layout().count() - assembler.layout().initial;
  const std::size_t components = model.discretisation.scheme.initial_components().size();
  model.h = make_stores<Stored>(lanes, n);
  model.g = make_stores<Stored>(lanes, n);
  model.body_force.assign(lanes, Eigen::MatrixXd(n, 6));
  model.initial_body_force.assign(components, Eigen::MatrixXcd(n, 6));
  InitialSystem initial;
  for (std::size_t c = 0; c < components; ++c) {  // not copied: pages are touched by the assembly
    initial.h.emplace_back(n, n);
    initial.g.emplace_back(n, n);
  }
  StaticSystem at_rest{DenseMatrix<double>(n, n), DenseMatrix<double>(n, n)};
  assemble<T, Stored>(assembler, model, initial, at_rest, progress);
  compute_balance(model, std::move(at_rest), progress);
  invert_initial<Stored>(model, initial, progress);
}

/// Far panels in single precision where neither storage nor tolerance asks for more.
bool single_precision(const PrecomputeOptions& options) {
  return options.precision == Precision::float32 &&
         options.discretisation.quadrature_tolerance >= 1e-6;
}

/// The window that brings the measured growth down to 1. Throws if it would leave nothing of the
/// body's motion.
double automatic_window(const BodyModel& model) {
  constexpr double kLeastLeft = 0.01, kRounding = 1e-6;
  const double growth = model.report.growth;
  if (growth <= 1) return 1;
  const double window = (1 - kRounding) / growth;
  if (std::pow(window, std::max(1.0, model.report.lam)) >= kLeastLeft) return window;
  double edge = 0;
  for (const Triangle& t : model.geometry.nodes.triangles)
    for (int k = 0; k < 3; ++k)
      edge = std::max(edge, (model.geometry.nodes.vertices[t[k]] -
                             model.geometry.nodes.vertices[t[(k + 1) % 3]])
                                .norm());
  const Discretisation& d = model.discretisation;
  throw Error(ErrorCode::numerical,
              "motions grow by a factor of " + std::to_string(growth) +
                  " per step, and a window that prevents it would leave nothing of them; use a "
                  "larger --dt (a shear wave goes " +
                  std::to_string(d.material.shear_speed() * d.dt / edge) +
                  " of the longest edge in a step; sharp edges with a Poisson ratio near 0.5 need "
                  "about 1), a finer mesh or a longer --history, or set --window yourself");
}

}  // namespace

BodyModel precompute(BodyGeometry geometry, const PrecomputeOptions& options,
                     const Progress& progress) {
  BodyModel model;
  model.kind = options.kind;
  model.geometry = std::move(geometry);
  model.discretisation = options.discretisation;
  if (options.kind == ModelKind::rigid) return model;
  model.precision = options.precision;
  model.report.lam =
      traversal_steps(model.geometry, options.discretisation.material, options.discretisation.dt);
  if (single_precision(options))
    compute_matrices<float, float>(model, progress);
  else if (options.precision == Precision::float32)
    compute_matrices<double, float>(model, progress);
  else
    compute_matrices<double, double>(model, progress);
  model.window = options.window > 0 ? options.window : 1;
  if (options.measure_growth) {
    if (progress) progress("growth factor", 0);
    model.report.growth = growth_factor(model).factor;
    if (options.window == 0) model.window = automatic_window(model);
  }
  return model;
}

MemoryEstimate precompute_memory(std::size_t nodes, const PrecomputeOptions& options) {
  if (options.kind == ModelKind::rigid) return {};
  const Scheme& scheme = options.discretisation.scheme;
  const LaneLayout layout(scheme, options.discretisation.history_length);
  const double square = 9.0 * static_cast<double>(nodes) * static_cast<double>(nodes);
  const double entry = static_cast<double>(bytes_per_entry(options.precision));
  MemoryEstimate e;
  e.stored = square * entry * 2 * layout.count() +
             3.0 * static_cast<double>(nodes) * 6 * 8 * layout.count();
  // lag 0 is complex double while it is factorised; the stored copies replace it one by one
  const double lags = square * entry * 2 * (layout.count() - layout.initial);
  const double initial = square * 16 * 2 * static_cast<double>(scheme.initial_components().size());
  const double at_rest = square * 8 * 2;
  e.peak = std::max(lags + initial + at_rest, e.stored + square * 16);
  return e;
}

}  // namespace bem
