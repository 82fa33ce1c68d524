#include "model/balance.hpp"

#include "algebra/decompositions.hpp"
#include "algebra/gmres.hpp"
#include "base/error.hpp"
#include "compress/complex_product.hpp"
#include "model/elastic_system.hpp"

#include <Eigen/LU>

namespace bem {
namespace {

using Columns = Eigen::MatrixXd;

/// Sums of the lag matrices, one per component.
std::unique_ptr<MatrixFamily> sum_lags(const BodyModel& model, const MatrixFamily& lags) {
  const int components = model.components();
  std::vector<std::vector<double>> weights(components, std::vector<double>(lags.count(), 0.0));
  for (int k = 1; k <= model.discretisation.history_length; ++k)
    for (int m = 0; m < components; ++m) weights[m][model.lag_index(k, m)] = 1;
  return lags.combine(weights);
}

/// Transposed products of stage operators. Vectors hold all stages, one after another.
class Adjoint {
 public:
  explicit Adjoint(const BodyModel& model)
      : model_(model),
        scheme_(model.discretisation.scheme),
        n_(static_cast<Eigen::Index>(3 * model.nodes())) {}

  /// (sum_k X_k)^T z for the lag sums of X.
  Columns lags(const MatrixFamily& sums, const Columns& z) const {
    return by_component(
        z, [&](int m, const Columns& inputs) { return transposed(sums, {m}, inputs); });
  }

  /// The same from the lags themselves: a sum of matrices is rounded as the codec stores it.
  Columns exact_lags(const MatrixFamily& lags, const Columns& z) const {
    return by_component(z, [&](int m, const Columns& inputs) {
      std::vector<int> matrices;
      for (int k = 1; k <= model_.discretisation.history_length; ++k)
        matrices.push_back(model_.lag_index(k, m));
      return transposed(lags, matrices, inputs);
    });
  }

  /// X_0^T z for a matrix of lag 0, by initial component.
  Columns initial(const std::vector<std::unique_ptr<MatrixFamily>>& families,
                  const Columns& z) const {
    Columns out = Columns::Zero(z.rows(), z.cols());
    for (std::size_t i = 0; i < families.size(); ++i)
      spread(i, multiply_complex_transposed(*families[i], component(i, z)), out);
    return out;
  }

  /// About H_0^{-T} z, and H_0^T times that.
  struct Preconditioned {
    Columns forces, product;
  };
  Preconditioned precondition(const ElasticSystem& system, const Columns& z) const {
    Preconditioned out{Columns::Zero(z.rows(), z.cols()), Columns::Zero(z.rows(), z.cols())};
    for (std::size_t i = 0; i < scheme_.initial_components().size(); ++i) {
      const InitialSolver::Preconditioned p =
          system.solver(static_cast<int>(i)).precondition_transposed(component(i, z));
      spread(i, p.solution, out.forces);
      spread(i, p.product, out.product);
    }
    return out;
  }

  /// Sum over the stages of each column.
  Columns stage_sum(const Columns& z) const {
    return combine(StageVector::Ones(scheme_.stages()), z);
  }

  /// What is multiplied by the transpose of a matrix of lag 0.
  Eigen::MatrixXcd component(std::size_t i, const Columns& z) const {
    const InitialComponent& c = scheme_.initial_components()[i];
    Eigen::MatrixXcd out = combine(c.left.real(), z).cast<Complex>();
    out.imag() = combine(c.left.imag(), z);
    return out;
  }
  /// Adds such a product.
  void spread(std::size_t i, const Eigen::MatrixXcd& product, Columns& out) const {
    const InitialComponent& c = scheme_.initial_components()[i];
    for (int b = 0; b < scheme_.stages(); ++b)
      stage(out, b) += c.multiplicity() * (c.right[b] * product).real();
  }

 private:
  Columns::BlockXpr stage(Columns& z, int a) const { return z.block(a * n_, 0, n_, z.cols()); }
  Columns combine(const StageVector& factors, const Columns& z) const {
    const Eigen::Index n = z.rows() / scheme_.stages();
    Columns out = factors[0] * z.topRows(n);
    for (int a = 1; a < scheme_.stages(); ++a) out += factors[a] * z.middleRows(a * n, n);
    return out;
  }
  /// The sum over the components of lags of product(m, what is multiplied).
  template <class F>
  Columns by_component(const Columns& z, const F& product) const {
    const auto& components = scheme_.lag_components();
    Columns out = Columns::Zero(z.rows(), z.cols());
    for (std::size_t m = 0; m < components.size(); ++m) {
      const Columns products = product(static_cast<int>(m), combine(components[m].left, z));
      for (int b = 0; b < scheme_.stages(); ++b) stage(out, b) += components[m].right[b] * products;
    }
    return out;
  }
  /// Products with the sum of some matrices.
  Columns transposed(const MatrixFamily& family, const std::vector<int>& matrices,
                     const Columns& inputs) const {
    Columns out = Columns::Zero(n_, inputs.cols());
    if (inputs.isZero(0)) return out;
    std::vector<FamilyTerm> terms;
    std::vector<double*> outputs;
    for (Eigen::Index c = 0; c < inputs.cols(); ++c) {
      for (int matrix : matrices)
        terms.push_back({matrix, inputs.col(c).data(), nullptr, static_cast<int>(c)});
      outputs.push_back(out.col(c).data());
    }
    family.multiply_transposed_add(terms, outputs);
    return out;
  }

  const BodyModel& model_;
  const Scheme& scheme_;
  Eigen::Index n_;
};

/// [D Q](0): right-hand side stages by acceleration stages, (3N s) x (6 s).
Columns body_force(const BodyModel& model) {
  const Scheme& scheme = model.discretisation.scheme;
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  const int stages = scheme.stages();
  std::vector<Columns> sums(model.components(), Columns::Zero(n, 6));
  for (std::size_t i = 0; i < model.body_force.size(); ++i)
    sums[i % sums.size()] += model.body_force[i];
  Columns out = Columns::Zero(n * stages, 6 * stages);
  for (int a = 0; a < stages; ++a)
    for (int b = 0; b < stages; ++b) {
      auto block = out.block(a * n, 6 * b, n, 6);
      for (std::size_t m = 0; m < sums.size(); ++m) {
        const LagComponent& c = scheme.lag_components()[m];
        block += c.left[a] * c.right[b] * sums[m];
      }
      for (std::size_t i = 0; i < scheme.initial_components().size(); ++i) {
        const InitialComponent& c = scheme.initial_components()[i];
        block += c.multiplicity() * (c.left[a] * c.right[b] * model.initial_body_force[i]).real();
      }
    }
  return out;
}

/// Orthonormal rows that span those of Pi.
Columns orthonormal_rigid(const Columns& rigid) {
  return orthonormal_basis(rigid.transpose());
}

/// Galerkin matrices without a history balance forces and torques exactly: rigid motions are the
/// left null vectors of H(0), R^T [D Q](0) = -diag(m, inertia), and R^T G(0) is that of the
/// tractions themselves.
void set_exact_balance(BodyModel& model) {
  const TriangleMesh& mesh = model.geometry.nodes;
  const auto n = static_cast<Eigen::Index>(model.nodes());
  Eigen::Matrix<double, 6, 6> inverse = Eigen::Matrix<double, 6, 6>::Zero();
  inverse.diagonal().head<3>().setConstant(1 / model.geometry.mass.mass);
  inverse.bottomRightCorner<3, 3>() = model.geometry.mass.inertia.inverse();
  const auto wrench = [](const Vec3& x) {  // of a unit force at x
    Eigen::Matrix<double, 6, 3> w;
    w << Mat3::Identity(), cross_matrix(x);
    return w;
  };
  model.balance.resize(6, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    model.balance.middleCols<3>(3 * i) = inverse * wrench(mesh.vertices[i]);
  if (model.loads == Loads::none) return;
  model.traction_balance = Eigen::MatrixXd::Zero(6, 3 * n);
  for (const Triangle& t : mesh.triangles) {
    const double area = triangle_area(mesh, t);
    const Vec3 sum = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
    for (int v : t) {
      Eigen::Matrix<double, 6, 3> w = wrench((sum + mesh.vertices[v]) / 4);  // int psi x / int psi
      model.traction_balance.middleCols<3>(3 * v) += inverse * (area / 3 * w);
    }
  }
}

/// The mean over a step of accelerations at the stages, as a functional of these: 6 s x 6.
Columns mean_of_stages(const Scheme& scheme) {
  const StageVector weights = scheme.integration().row(scheme.stages() - 1).transpose();
  Columns mean(6 * scheme.stages(), 6);
  for (int a = 0; a < scheme.stages(); ++a)
    mean.middleRows(6 * a, 6) = weights[a] / weights.sum() * Columns::Identity(6, 6);
  return mean;
}

/// The inertial form has the rigid motions R as left null vectors of H(0) whatever a codec has made
/// of its matrices, so that R^T b + R^T [D Q](0) (a', alpha) = 0.
void set_inertial_balance(BodyModel& model) {
  const Scheme& scheme = model.discretisation.scheme;
  const int stages = scheme.stages();
  const Columns rigid = rigid_motions(model.geometry.nodes.vertices), body = body_force(model);
  const Eigen::Index n = rigid.rows();
  Columns moments(6 * stages, 6 * stages), forces(n * stages, 6);
  for (int a = 0; a < stages; ++a)
    moments.middleRows(6 * a, 6) = rigid.transpose() * body.middleRows(a * n, n);
  const Columns motions = -moments.transpose().partialPivLu().solve(mean_of_stages(scheme));
  for (int a = 0; a < stages; ++a)
    forces.middleRows(a * n, n) = rigid * motions.middleRows(6 * a, 6);
  const Adjoint adjoint(model);
  model.balance = adjoint.stage_sum(forces).transpose();
  if (model.loads == Loads::none) return;
  Columns tractions = adjoint.exact_lags(*model.g, forces);
  for (std::size_t i = 0; i < model.traction_moments.size(); ++i)
    adjoint.spread(i, model.traction_moments[i].transpose() * adjoint.component(i, motions),
                   tractions);
  model.traction_balance = adjoint.stage_sum(tractions).transpose();
}

}  // namespace

void compute_balance(BodyModel& model) {
  if (model.stiffness) return set_inertial_balance(model);
  if (model.discretisation.is_galerkin()) return set_exact_balance(model);
  constexpr double kAcceptable = 1e-4;
  constexpr int kMostIterations = 300, kPatience = 60;  // bending of thin bodies comes late
  const double tolerance =
      model.codec->is_double() ? 1e-13 : 1e-9;  // beyond what the matrices know
  const ElasticSystem system(model, 1);
  const Scheme& scheme = model.discretisation.scheme;
  const int stages = scheme.stages();
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  const Adjoint adjoint(model);
  const auto sums = model.h ? sum_lags(model, *model.h) : nullptr;
  const Columns rigid = orthonormal_rigid(system.projection().rigid());
  Columns body = body_force(model);
  const Eigen::VectorXd scales = body.colwise().norm();
  body = body * scales.cwiseInverse().asDiagonal();
  // unknowns: H_0^T times the adjoint of u (about), then that of the condition Pi u = 0, stage by
  // stage
  const auto apply = [&](const Columns& x) {
    const auto [forces, product] = adjoint.precondition(system, x.topRows(n * stages));
    Columns out(x.rows(), x.cols());
    out.topRows(n * stages) = product;
    if (sums) out.topRows(n * stages) += adjoint.lags(*sums, forces);
    for (int a = 0; a < stages; ++a)
      out.middleRows(a * n, n) += rigid * x.middleRows(n * stages + 6 * a, 6);
    out.bottomRows(6 * stages) = -body.transpose() * forces;
    return out;
  };
  Columns wanted = Columns::Zero((n + 6) * stages, 6);
  wanted.bottomRows(6 * stages) = scales.cwiseInverse().asDiagonal() * mean_of_stages(scheme);
  const Eigen::VectorXd sizes = wanted.colwise().norm();
  Columns solution = Columns::Zero(wanted.rows(), 6);
  const GmresResult result = gmres<double>(apply, wanted * sizes.cwiseInverse().asDiagonal(),
                                           solution, {tolerance, kMostIterations, kPatience});
  if (!(result.residual <= kAcceptable))
    throw Error(ErrorCode::numerical,
                "the static balance of the body cannot be computed: its matrices are too "
                "inaccurate; use a smaller --codec-tol or --quadrature-tol");
  const Columns z = solution.topRows(n * stages) * sizes.asDiagonal();
  const Columns forces = adjoint.precondition(system, z).forces;
  model.balance = adjoint.stage_sum(forces).transpose();
  if (model.loads == Loads::none) return;
  Columns tractions = model.is_iterative() ? adjoint.initial(model.initial_g, forces)
                                           : adjoint.initial(model.traction_response, z);
  if (model.g) tractions += adjoint.lags(*sum_lags(model, *model.g), forces);
  model.traction_balance = adjoint.stage_sum(tractions).transpose();
}

}  // namespace bem
