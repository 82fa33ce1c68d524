#include "diff.hpp"

#include "archive/archive_layout.hpp"
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

namespace bem {
namespace {

/// Squared norms of numbers and of their differences.
struct Norms {
  double difference = 0, first = 0, second = 0;

  void add(const double* a, const double* b, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      difference += (a[i] - b[i]) * (a[i] - b[i]);
      first += a[i] * a[i];
      second += b[i] * b[i];
    }
  }
  bool equal() const { return difference == 0; }
  double relative() const {
    return std::sqrt(difference / (first > 0 ? first : second));  // not finite stays not finite
  }
};

class Comparison {
 public:
  Comparison(std::ostream& out, const Archive& a, const Archive& b, const Progress& progress)
      : out_(out), a_(a), b_(b), progress_(progress) {}

  bool run() {
    compare_properties();
    compare_geometry();
    if (a_.kind() == ModelKind::rigid || b_.kind() == ModelKind::rigid) return equal_;
    if (a_.unknowns() != b_.unknowns()) {
      report("matrices", "cannot be compared: they have " + std::to_string(a_.unknowns()) +
                             " and " + std::to_string(b_.unknowns()) + " unknowns");
    } else {
      compare_small_matrices();
      compare_matrices();
    }
    return equal_;
  }

 private:
  void report(const std::string& what, const std::string& how) {
    equal_ = false;
    out_ << what << ": " << how << "\n";
  }

  void report(const std::string& what, const Norms& norms) {
    if (norms.equal()) return;
    equal_ = false;
    out_ << what << ": relative error " << norms.relative() << "\n";
  }

  void compare_properties() {
    const auto properties = [](const Archive& archive) {
      auto json = info_json(archive);
      json.erase("digest");
      return json.flatten();
    };
    const auto a = properties(a_), b = properties(b_);
    const auto value = [](const nlohmann::ordered_json& json, const std::string& key) {
      return json.contains(key) ? json[key].dump() : std::string("nothing");
    };
    for (const auto& [key, unused] : a.items())
      if (value(a, key) != value(b, key))
        report(key.substr(1), value(a, key) + " and " + value(b, key));
    for (const auto& [key, unused] : b.items())
      if (!a.contains(key)) report(key.substr(1), "nothing and " + value(b, key));
  }

  void compare_points(const std::string& what, const std::vector<Vec3>& a,
                      const std::vector<Vec3>& b) {
    if (a.size() != b.size()) return;  // the numbers were reported
    Norms norms;
    for (std::size_t i = 0; i < a.size(); ++i) norms.add(a[i].data(), b[i].data(), 3);
    report(what, norms);
  }

  void compare_geometry() {
    const BodyGeometry &a = a_.geometry(), &b = b_.geometry();
    compare_points("mesh/vertices", a.input.vertices, b.input.vertices);
    compare_points("body/nodes", a.nodes.vertices, b.nodes.vertices);
    if (a.input.triangles != b.input.triangles) report("mesh/faces", "different");
    if (a.nodes.triangles != b.nodes.triangles) report("body/triangles", "different");
    if (a.node_of_vertex != b.node_of_vertex) report("body/node_of_vertex", "different");
    if (a.triangle_order != b.triangle_order) report("body/triangle_order", "different");
    Norms inertia;
    inertia.add(a.mass.inertia.data(), b.mass.inertia.data(), 9);
    report("body/inertia", inertia);
  }

  void compare_body_force(const char* name) {
    const std::string path = lags_path(name).substr(1);
    if (name == kCentrifugal && !(a_.has_centrifugal() && b_.has_centrifugal())) {
      if (a_.has_centrifugal() != b_.has_centrifugal()) report(path, "in one of them only");
      return;
    }
    const BodyForce a = a_.load_body_force(name), b = b_.load_body_force(name);
    Norms lags, initial;
    for (std::size_t i = 0; i < std::min(a.lags.size(), b.lags.size()); ++i)
      lags.add(a.lags[i].data(), b.lags[i].data(), static_cast<std::size_t>(a.lags[i].size()));
    for (std::size_t i = 0; i < std::min(a.initial.size(), b.initial.size()); ++i)
      initial.add(reinterpret_cast<const double*>(a.initial[i].data()),
                  reinterpret_cast<const double*>(b.initial[i].data()),
                  2 * static_cast<std::size_t>(a.initial[i].size()));
    report(path + "/lags", lags);
    report(path + " of lag 0", initial);
  }

  void compare_small_matrices() {
    for (const char* name : {kBodyForce, kCentrifugal}) compare_body_force(name);
    for (const std::string path : {kBalancePath, kTractionBalancePath}) {
      const Eigen::MatrixXd x = a_.load_balance(path), y = b_.load_balance(path);
      if (x.size() != y.size()) {
        report(path.substr(1), "in one of them only");
        continue;
      }
      Norms balance;
      balance.add(x.data(), y.data(), static_cast<std::size_t>(x.size()));
      report(path.substr(1), balance);
    }
  }

  void compare_matrices() {
    const std::vector<std::string> paths = a_.matrix_paths(), others = b_.matrix_paths();
    const std::set<std::string> in_a(paths.begin(), paths.end()),
        in_b(others.begin(), others.end());
    std::size_t done = 0;
    for (const std::string& path : paths) {
      if (in_b.count(path) > 0)
        report(path.substr(1), matrix_norms(path));
      else
        report(path.substr(1), "only in " + a_.path());
      if (progress_) progress_("comparing", double(++done) / double(paths.size()));
    }
    for (const std::string& path : others)
      if (in_a.count(path) == 0) report(path.substr(1), "only in " + b_.path());
  }

  Norms matrix_norms(const std::string& path) const {
    const std::size_t n = a_.unknowns();
    const std::size_t tile = std::max<std::size_t>(1, (std::size_t(4) << 20) / n);
    std::vector<double> x(std::min(tile, n) * n), y(std::min(tile, n) * n);
    Norms norms;
    for (std::size_t first = 0; first < n; first += tile) {
      const std::size_t rows = std::min(tile, n - first);
      a_.read_matrix_rows(path, first, rows, x.data());
      b_.read_matrix_rows(path, first, rows, y.data());
      norms.add(x.data(), y.data(), rows * n);
    }
    return norms;
  }

  std::ostream& out_;
  const Archive &a_, &b_;
  const Progress& progress_;
  bool equal_ = true;
};

}  // namespace

bool print_differences(std::ostream& out, const Archive& a, const Archive& b,
                       const Progress& progress) {
  const bool equal =
      a.user_block().digest == b.user_block().digest || Comparison(out, a, b, progress).run();
  if (equal) out << "identical\n";
  return equal;
}

}  // namespace bem
