#include "compress/complex_product.hpp"
#include "model/nodal_tractions.hpp"
#include "support/models.hpp"

#include <numeric>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

struct Pair {
  BodyModel dense, iterative;
};

Pair make_pair_of(const std::string& scheme, const Codec& codec) {
  const Material m = material(1000, 1e6, 0.4);
  const BodyGeometry g = geometry_of(star(2, 0.4), m.density);
  PrecomputeOptions o = options_for(g, m, scheme, 3);
  o.codec = CodecOptions(codec);
  Pair pair;
  pair.dense = precompute(g, o);
  o.inverse = InverseKind::iterative;
  pair.iterative = precompute(g, o);
  return pair;
}

double difference(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return (a - b).norm() / b.norm();
}

}  // namespace

TEST_CASE("iterative solutions with H_0 are those of the stored inverse") {
  struct Case {
    const char* scheme;
    const Codec& codec;
    double tolerance;
  };
  for (const Case& c : {Case{"radau2", codec_named("none", Precision::float64), 1e-10},
                        Case{"theta:0.75", codec_named("none"), 1e-5},
                        Case{"radau2", codec_named("lowrank"), 1e-3}}) {
    CAPTURE(c.scheme, c.codec.name());
    const auto [dense, iterative] = make_pair_of(c.scheme, c.codec);
    CHECK(iterative.is_iterative());
    CHECK(iterative.inverse.empty());
    const ElasticSystem a(dense), b(iterative);
    const auto n = static_cast<Eigen::Index>(3 * dense.nodes());
    const Eigen::MatrixXcd load = Eigen::MatrixXcd::Random(n, 30);
    CHECK(difference(b.solver(0).solve(load), a.solver(0).solve(load)) < c.tolerance);
    CHECK(difference(b.solver(0).solve_transposed(load), a.solver(0).solve_transposed(load)) <
          c.tolerance);
    CHECK(difference(iterative.balance, dense.balance) < c.tolerance);
    CHECK(difference(iterative.traction_balance, dense.traction_balance) < c.tolerance);
    std::vector<int> nodes(dense.nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    const NodalTractions p(a, extract_tractions(dense, nodes));
    const NodalTractions q(b, extract_tractions(iterative, nodes));
    const std::vector<int> some = {2, 17, 40}, others = {1, 17};
    const double single = 1e-7;  // what columns are remembered with
    CHECK(difference(q.response(0, some, others), p.response(0, some, others)) <
          std::max(single, c.tolerance));
    CHECK(difference(q.acceleration(0, some), p.acceleration(0, some)) < c.tolerance);
  }
}

TEST_CASE("steps of an iterative model start from the last ones and keep no rigid motion") {
  const auto [dense, iterative] = make_pair_of("radau2", codec_named("none", Precision::float64));
  const ElasticSystem a(dense), b(iterative);
  const auto n = static_cast<Eigen::Index>(3 * dense.nodes());
  SolutionMemory memory;
  const Eigen::MatrixXd first = Eigen::MatrixXd::Random(n, dense.components());
  const Eigen::MatrixXd second = Eigen::MatrixXd::Random(n, dense.components());
  for (int step = 0; step < 4; ++step) {
    const Eigen::MatrixXd sums = first + 0.1 * step * second;
    const Eigen::MatrixXd u = b.displacement_stages(b.solve({sums}, {}, {&memory})[0]);
    CHECK(difference(u.cast<Complex>(), a.displacement_stages(a.solve({sums})[0]).cast<Complex>()) <
          1e-10);
    CHECK((b.projection().rigid() * u).norm() < 1e-12 * u.norm());
  }
  // what is a combination of known right-hand sides is known
  const Eigen::MatrixXcd load = Eigen::MatrixXcd::Random(n, 2);
  const Eigen::MatrixXcd known = a.solver(0).solve(load);
  SolutionMemory other;
  for (int i = 0; i < 2; ++i) other.add(0, known.col(i), load.col(i));
  CHECK(difference(other.guess(0, load.col(0) - Complex(2, 1) * load.col(1)),
                   known.col(0) - Complex(2, 1) * known.col(1)) < 1e-12);
  CHECK(other.guess(1, load.col(0)).norm() == 0);
}

TEST_CASE("columns of nodes without loads are zero, the others as always") {
  const Material m = material(1000, 1e6, 0.4);
  const BodyGeometry g = geometry_of(star(2, 0.4), m.density);
  PrecomputeOptions o = options_for(g, m, "theta:0.75", 3);
  o.codec = CodecOptions(codec_named("lowrank"));
  const BodyModel all = precompute(g, o);
  o.loads = Loads::some;
  for (int node = 20; node < 50; node += 3) o.loaded_nodes.push_back(node);
  const BodyModel some = precompute(g, o);
  o.loads = Loads::none;
  const BodyModel none = precompute(g, o);
  CHECK(!none.g);
  CHECK(none.traction_response.empty());
  CHECK(full_matrix(*none.inverse[0], 0) == full_matrix(*all.inverse[0], 0));
  CHECK(some.g->bytes() < all.g->bytes() / 2);
  const std::vector<int> columns = unknowns_of(some.loaded_nodes);
  for (const auto& [part, whole] :
       {std::pair(some.g.get(), all.g.get()),
        std::pair(some.traction_response[0].get(), all.traction_response[0].get())}) {
    Eigen::MatrixXd kept = full_matrix(*part, 0), expected = full_matrix(*whole, 0);
    const Eigen::MatrixXd a = kept(Eigen::all, columns), b = expected(Eigen::all, columns);
    CHECK((a - b).norm() < 1e-3 * b.norm());
    kept(Eigen::all, columns).setZero();
    CHECK(kept.norm() < 1e-6 * expected.norm());
  }
}
