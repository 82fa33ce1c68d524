#include "dynamics/bilateral.hpp"

#include "base/error.hpp"
#include "dynamics/selection.hpp"
#include "scene/location.hpp"
#include "scene/motion.hpp"

#include <map>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace bem {

std::vector<PrescribedNode> prescribed_nodes(const BodyGeometry& geometry, const BodySpec& spec) {
  std::map<int, const HandleSpec*> chosen;
  for (const Selection& s : spec.fixed)
    for (int node : select_nodes(geometry, s)) chosen[node] = nullptr;
  for (const HandleSpec& handle : spec.handles)
    for (int node : select_nodes(geometry, handle.select)) {
      const auto [entry, fresh] = chosen.try_emplace(node, &handle);
      if (!fresh && entry->second != &handle)
        throw error_at(handle.location,
                       "the handle moves a vertex that is already " +
                           std::string(entry->second ? "moved by another handle" : "fixed") +
                           "; select every vertex once");
    }
  std::vector<PrescribedNode> nodes;
  for (const auto& [node, handle] : chosen) nodes.push_back({node, handle});
  return nodes;
}

BilateralConstraints::BilateralConstraints(std::vector<PrescribedNode> nodes, InputColumns columns,
                                           const ElasticSystem& system, const RigidFrame& frame)
    : nodes_(std::move(nodes)),
      columns_(std::move(columns)),
      system_(system),
      is_active_(nodes_.size(), 0) {
  const TriangleMesh& mesh = system.model().geometry.nodes;
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<Vec3> moments(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const double twelfth = triangle_area(mesh, t) / 12;
    const Vec3 sum = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
    for (int v : t) moments[v] += twelfth * (sum + mesh.vertices[v]);
  }
  const RigidFrame::Stages start = frame.current();
  for (const PrescribedNode& p : nodes_) {
    rest_.push_back(mesh.vertices[p.node]);
    start_.push_back(frame.place(start, 0, mesh.vertices[p.node], Vec3::Zero()));
    areas_.push_back(areas[p.node]);
    moments_.push_back(moments[p.node]);
  }
  for (const Eigen::MatrixXcd& d : columns_.displacement) {
    Eigen::MatrixXcd rows(unknowns(), unknowns());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      rows.middleRows<3>(static_cast<Eigen::Index>(3 * i)) = d.middleRows<3>(3 * nodes_[i].node);
    response_.push_back(std::move(rows));
  }
}

void BilateralConstraints::activate(double step_end) {
  std::vector<int> active;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const HandleSpec* handle = nodes_[i].handle;
    // a step that ends at the release time, up to rounding, is still held
    if (!handle || !handle->release_time || step_end <= *handle->release_time * (1 + 1e-9))
      active.push_back(static_cast<int>(i));
  }
  if (active == active_) return;
  factorised_ = false;
  active_ = std::move(active);
  is_active_.assign(nodes_.size(), 0);
  for (int i : active_) is_active_[i] = 1;
  hold_all_round_ = spread_out();
}

void BilateralConstraints::factorise(const RigidFrame& frame, const FrameOffset& offset) {
  if (factorised_ || active_.empty()) return;
  factors_.compute(compliance(frame, offset));
  factorised_ = true;
}

/// d(position in body axes)/d(tractions) of the active nodes, stage by stage: deformation, motion
/// of the frame, and offset from it.
Eigen::MatrixXd BilateralConstraints::compliance(const RigidFrame& frame,
                                                 const FrameOffset& offset) const {
  const Scheme& scheme = system_.scheme();
  const int stages = scheme.stages();
  const Eigen::Index block = static_cast<Eigen::Index>(3 * active_.size());
  Eigen::MatrixXd w(stages * block, stages * block);
  for (int a = 0; a < stages; ++a)
    for (int b = 0; b < stages; ++b)
      for (std::size_t j = 0; j < active_.size(); ++j) {
        const int q = active_[j];
        // rigid displacement (translation, rotation) of the body by the tractions of node q
        Eigen::Matrix<double, 6, 3> rigid;
        const StageMatrix& gain =
            hold_all_round_ ? offset.gain() : frame.position_by_acceleration();
        const double inertial = gain(a, b);
        rigid.topRows<3>() = inertial * areas_[q] / frame.mass() * Mat3::Identity();
        rigid.bottomRows<3>() = inertial * frame.inverse_inertia() * cross_matrix(moments_[q]);
        for (int c = 0; c < stages; ++c)
          rigid += offset.gain()(a, c) * acceleration_difference(c, b, q);
        for (std::size_t i = 0; i < active_.size(); ++i) {
          const int p = active_[i];
          Mat3 m = rigid.topRows<3>() - cross_matrix(rest_[p]) * rigid.bottomRows<3>();
          for (std::size_t s = 0; s < response_.size(); ++s) {
            const InitialComponent& component = scheme.initial_components()[s];
            m += (component.multiplicity() * component.left[a] * component.right[b] *
                  response_[s].block<3, 3>(3 * p, 3 * q))
                     .real();
          }
          w.block<3, 3>(a * block + static_cast<Eigen::Index>(3 * i),
                        b * block + static_cast<Eigen::Index>(3 * j)) = m;
        }
      }
  return w;
}

/// d((a', alpha) - balanced value at stage c)/d(tractions of node q at stage b).
Eigen::Matrix<double, 6, 3> BilateralConstraints::acceleration_difference(int c, int b,
                                                                          int q) const {
  const Scheme& scheme = system_.scheme();
  Eigen::Matrix<double, 6, 3> d = Eigen::Matrix<double, 6, 3>::Zero();
  for (std::size_t s = 0; s < response_.size(); ++s) {
    const InitialComponent& component = scheme.initial_components()[s];
    d -= (component.multiplicity() * component.left[c] * component.right[b] *
          columns_.acceleration[s].middleCols<3>(3 * q))
             .real();
  }
  if (b == c) d -= columns_.balanced_acceleration.middleCols<3>(3 * q);
  return d;
}

Eigen::MatrixXd BilateralConstraints::displacements(const SpectralState& state,
                                                    const Eigen::MatrixXd& tractions) const {
  const Scheme& scheme = system_.scheme();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns(), scheme.stages());
  for (std::size_t c = 0; c < response_.size(); ++c) {
    const InitialComponent& component = scheme.initial_components()[c];
    Eigen::VectorXcd u = response_[c] * (tractions.cast<Complex>() * component.right);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      u.segment<3>(static_cast<Eigen::Index>(3 * i)) +=
          state.displacement[c].segment<3>(3 * nodes_[i].node);
    for (int a = 0; a < scheme.stages(); ++a)
      out.col(a) += component.multiplicity() * (component.left[a] * u).real();
  }
  return out;
}

Vec3 BilateralConstraints::target(std::size_t i, double t) const {
  const HandleSpec* handle = nodes_[i].handle;
  return handle ? motion_at(handle->motion, t).apply(start_[i]) : start_[i];
}

bool BilateralConstraints::spread_out() const {
  constexpr double kThin = 1e-3;  // width over length of a row of nodes
  Vec3 centre = Vec3::Zero();
  for (int i : active_) centre += rest_[i] / static_cast<double>(active_.size());
  Mat3 spread = Mat3::Zero();
  for (int i : active_) spread += (rest_[i] - centre) * (rest_[i] - centre).transpose();
  const Vec3 squares = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvalues();
  return squares[1] > kThin * kThin * squares[2];
}

BilateralConstraints::Holder BilateralConstraints::holder(double t) const {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  for (int i : active_) {
    from += start_[i] / static_cast<double>(active_.size());
    to += target(i, t) / static_cast<double>(active_.size());
  }
  Mat3 covariance = Mat3::Zero();
  for (int i : active_) covariance += (target(i, t) - to) * (start_[i] - from).transpose();
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  Holder h;
  h.rotation = svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  h.translation = to - h.rotation * from;
  return h;
}

void BilateralConstraints::correct(const Eigen::MatrixXd& gaps, Eigen::MatrixXd& tractions) const {
  const Eigen::Index block = static_cast<Eigen::Index>(3 * active_.size());
  Eigen::VectorXd r(block * gaps.cols());
  for (Eigen::Index a = 0; a < gaps.cols(); ++a)
    for (std::size_t i = 0; i < active_.size(); ++i)
      r.segment<3>(a * block + static_cast<Eigen::Index>(3 * i)) =
          gaps.col(a).segment<3>(3 * active_[i]);
  const Eigen::VectorXd change = factors_.solve(r);
  for (Eigen::Index a = 0; a < gaps.cols(); ++a)
    for (std::size_t i = 0; i < active_.size(); ++i)
      tractions.col(a).segment<3>(3 * active_[i]) +=
          change.segment<3>(a * block + static_cast<Eigen::Index>(3 * i));
}

void BilateralConstraints::clear_inactive(Eigen::MatrixXd& tractions) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (!is_active_[i]) tractions.middleRows<3>(static_cast<Eigen::Index>(3 * i)).setZero();
}

Vec3 BilateralConstraints::force(const Eigen::VectorXd& tractions) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    sum += areas_[i] * tractions.segment<3>(static_cast<Eigen::Index>(3 * i));
  return sum;
}

Vec3 BilateralConstraints::torque(const Eigen::VectorXd& tractions) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    sum += moments_[i].cross(tractions.segment<3>(static_cast<Eigen::Index>(3 * i)).matrix());
  return sum;
}

}  // namespace bem
