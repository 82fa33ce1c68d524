#include "assembly/galerkin_static.hpp"

#include "assembly/edge_reconstruction.hpp"
#include "assembly/static_sums.hpp"
#include "quadrature/triangle_rules.hpp"

#include <array>

namespace bem {
namespace {

/// What the static hypersingular form of a pair needs: integrals of 1/r and h h^T/r times linear
/// shape functions of both triangles, 3 by 3; index 3 stands for the sum over all three.
struct Moments {
  double scalar[4][4];
  Mat3 tensor[4][4];

  explicit Moments(const StaticSums& sums) {
    const auto& v = sums.values;
    constexpr int t = StaticSums::kTensor;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const int i = 3 * a + b;
        scalar[a][b] = v[StaticSums::kScalar][i];
        tensor[a][b] << v[t][i], v[t + 1][i], v[t + 2][i], v[t + 1][i], v[t + 3][i], v[t + 4][i],
            v[t + 2][i], v[t + 4][i], v[t + 5][i];
      }
    for (int a = 0; a < 3; ++a) {
      scalar[a][3] = scalar[a][0] + scalar[a][1] + scalar[a][2];
      tensor[a][3] = tensor[a][0] + tensor[a][1] + tensor[a][2];
    }
    for (int b = 0; b < 4; ++b) {
      scalar[3][b] = scalar[0][b] + scalar[1][b] + scalar[2][b];
      tensor[3][b] = tensor[0][b] + tensor[1][b] + tensor[2][b];
    }
  }
};

/// Products of shape functions at the points of products of triangle rules, weights included.
class ProductShapes {
 public:
  ProductShapes() {
    const auto& rules = triangle_rules();
    for (int x = 0; x < kTriangleRuleCount; ++x)
      for (int y = 0; y < kTriangleRuleCount; ++y) {
        std::vector<Shapes>& table = tables_[x][y];
        for (int i = 0; i < rules[x].size; ++i)
          for (int j = 0; j < rules[y].size; ++j) {
            const TrianglePoint &p = rules[x].points[i], &q = rules[y].points[j];
            set_shapes(p.barycentric, q.barycentric, p.weight * q.weight,
                       table.emplace_back().values);
          }
      }
  }
  const double (*at(int x, int y, int point) const)[StaticBatch::kShapes] {
    return &tables_[x][y][point].values;
  }

 private:
  struct alignas(64) Shapes {
    double values[StaticBatch::kShapes];
  };
  std::vector<Shapes> tables_[kTriangleRuleCount][kTriangleRuleCount];
};

/// Sums over parts of two triangles that do not touch, by the shape functions of the parts and as a
/// fraction of their areas.
void add_product_sums(const Vec3& normal, const StaticTraction& traction,
                      const PairQuadrature::Part& part, StaticSums& sums) {
  static const ProductShapes shapes;
  const TriangleRule &of_x = triangle_rules()[part.rule_x], &of_y = triangle_rules()[part.rule_y];
  Vec3 y[kMaxRulePoints];
  for (int j = 0; j < of_y.size; ++j) y[j] = part.y.position(of_y.points[j].barycentric);
  StaticBatch batch;
  int done = 0;
  const auto flush = [&] {
    batch.shapes = shapes.at(part.rule_x, part.rule_y, done);
    accumulate_static(normal, traction, batch, sums);
    done += batch.size;
    batch.size = 0;
  };
  for (int i = 0; i < of_x.size; ++i) {
    const Vec3 x = part.x.position(of_x.points[i].barycentric);
    for (int j = 0; j < of_y.size; ++j) {
      batch.add(y[j] - x);
      if (batch.size == StaticBatch::kCapacity) flush();
    }
  }
  if (batch.size > 0) flush();
}

/// The same over parts that touch.
void add_touching_sums(const PairQuadrature& quadrature, const Vec3& normal,
                       const StaticTraction& traction, const PairQuadrature::Part& part,
                       StaticSums& sums) {
  StaticBatch batch;
  alignas(64) double shapes[StaticBatch::kCapacity][StaticBatch::kShapes];
  batch.shapes = shapes;
  const auto flush = [&] {
    accumulate_static(normal, traction, batch, sums);
    batch.size = 0;
  };
  quadrature.for_each_point_of(part, [&](const PairPoint& p) {
    set_shapes(p.x, p.y, p.weight, shapes[batch.size]);
    batch.add(part.y.position(p.y) - part.x.position(p.x));
    if (batch.size == StaticBatch::kCapacity) flush();
  });
  if (batch.size > 0) flush();
}

/// Adds sums over parts of triangles to those by the shape functions of the triangles.
void add_sums(const PairQuadrature::Part& part, const StaticSums& of_part, StaticSums& sums) {
  using Products = Eigen::Matrix<double, kShapes, 3, Eigen::RowMajor>;
  const Eigen::Matrix<double, kShapes, kShapes> x = part.fraction() * part.x.shapes();
  const Mat3 y = part.y.shapes().topLeftCorner<3, 3>();
  for (int e = 0; e < StaticSums::kCount; ++e)
    Eigen::Map<Products>(sums.values[e]) +=
        (x * Eigen::Map<const Products>(of_part.values[e])).lazyProduct(y.transpose());
}

/// The static sums over two triangles.
StaticSums static_sums(const PairQuadrature& quadrature, double kappa, int tx, int ty) {
  const StaticTraction traction(kappa);
  const Vec3& normal = quadrature.normal(tx);
  StaticSums sums;
  const auto add = [&](const PairQuadrature::Part& part, StaticSums& to) {
    if (part.touching)
      add_touching_sums(quadrature, normal, traction, part, to);
    else
      add_product_sums(normal, traction, part, to);
  };
  quadrature.for_each_part(tx, ty, KernelPart::static_part, [&](const PairQuadrature::Part& part) {
    if (part.is_whole()) {
      add(part, sums);
      return;
    }
    StaticSums of_part;
    add(part, of_part);
    add_sums(part, of_part, sums);
  });
  const double areas = quadrature.area(tx) * quadrature.area(ty);
  for (auto& row : sums.values)
    for (double& value : row) value *= areas;
  return sums;
}

/// The curls of the linear shape functions of a triangle, constant on it [1/m].
std::array<Vec3, 3> linear_curls(const TriangleMesh& mesh, int triangle, double area) {
  const Triangle& t = mesh.triangles[triangle];
  std::array<Vec3, 3> c;
  for (int i = 0; i < 3; ++i)
    c[i] = (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[(i + 2) % 3]]) / (2 * area);
  return c;
}

}  // namespace

void add_static_pair(const PairQuadrature& quadrature, double shear_modulus, double kappa, int tx,
                     int ty, PairMatrix* h, PairTractions& adjoint) {
  const StaticSums sums = static_sums(quadrature, kappa, tx, ty);
  for (int a = 0; a < kShapes; ++a)
    for (int b = 0; b < 3; ++b)
      for (int e = 0; e < 9; ++e)
        adjoint(3 * a + e / 3, 3 * b + e % 3) += sums.values[StaticSums::kAdjoint + e][3 * a + b];

  if (!h) return;
  // the form is bilinear in the curls of both, scalar in these moments
  const Moments moments(sums);
  const auto cx = linear_curls(quadrature.mesh(), tx, quadrature.area(tx));
  const auto cy = linear_curls(quadrature.mesh(), ty, quadrature.area(ty));
  const double scale = shear_modulus / (4 * kPi);
  double of_both[3][3];
  Mat3 of_scalar[3][3];
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      of_both[p][q] = scale * 2 * (1 - kappa) * cx[p].dot(cy[q]);
      of_scalar[p][q] =
          of_both[p][q] * Mat3::Identity() -
          scale * (cx[p] * cy[q].transpose() + 2 * (1 - 2 * kappa) * cy[q] * cx[p].transpose());
    }
  // shape i has the curl c_i for i < 3, and 4 (L_i c_j + L_j c_i) with j = i + 1 beyond
  const auto form = [&](int p, int q, int a, int b) -> Mat3 {
    return of_both[p][q] * moments.tensor[a][b] + moments.scalar[a][b] * of_scalar[p][q];
  };
  constexpr int kAll = 3;
  for (int i = 0; i < 3; ++i) {
    const int in = (i + 1) % 3;
    for (int j = 0; j < 3; ++j) {
      const int jn = (j + 1) % 3;
      h->block<3, 3>(3 * i, 3 * j) += form(i, j, kAll, kAll);
      h->block<3, 3>(3 * (3 + i), 3 * j) += 4 * (form(in, j, i, kAll) + form(i, j, in, kAll));
      h->block<3, 3>(3 * i, 3 * (3 + j)) += 4 * (form(i, jn, kAll, j) + form(i, j, kAll, jn));
      h->block<3, 3>(3 * (3 + i), 3 * (3 + j)) +=
          16 * (form(in, jn, i, j) + form(in, j, i, jn) + form(i, jn, in, j) + form(i, j, in, jn));
    }
  }
}

PairTractions mass_matrix(double area) {
  PairTractions m = PairTractions::Zero();
  const TriangleRule& rule = triangle_rules()[2];  // of degree 4
  for (int q = 0; q < rule.size; ++q) {
    const double* l = rule.points[q].barycentric;
    const auto shape = quadratic_shapes(l);
    for (int i = 0; i < kShapes; ++i)
      for (int j = 0; j < 3; ++j)
        m.block<3, 3>(3 * i, 3 * j) +=
            rule.points[q].weight * area * shape[i] * l[j] * Mat3::Identity();
  }
  return m;
}

}  // namespace bem
