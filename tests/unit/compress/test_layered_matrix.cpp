#include "compress/layered_matrix.hpp"

#include <catch2/catch.hpp>
#include <hwy/highway.h>

using namespace bem;

namespace {

/// Entries that fall from `largest` by a factor per row and column.
FloatMatrix falling(int rows, int columns, float largest) {
  FloatMatrix m(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i)
      m(i, j) =
          largest * std::pow(0.7F, static_cast<float>(i + j)) * ((i * 7 + j * 3) % 2 ? 1 : -1);
  return m;
}

}  // namespace

TEST_CASE("layers hold what rounding leaves, in as few bytes as the sizes allow") {
  const FloatMatrix entries = falling(40, 23, 1e6F);
  const Layers layers = fit_layers(entries);
  for (int i = 0; i < 2; ++i) {
    CHECK(layers.rows[i] < layers.rows[i + 1]);
    CHECK(layers.columns[i] <= layers.columns[i + 1]);
  }
  CHECK(layers.rows[0] == 10);  // 1e6 * 0.7^9 is above 32767
  FloatMatrix errors = entries;
  std::vector<std::uint8_t> data;
  store_layers(layers, errors, data);
  CHECK(data.size() == layers.bytes());
  CHECK(data.size() < 4 * 40 * 23 / 2);
  CHECK(errors.cwiseAbs().maxCoeff() <= 0.5F);
  FloatMatrix back = FloatMatrix::Zero(40, 23);
  back.topLeftCorner(layers.stored_rows(), layers.stored_columns()) =
      load_layers(layers, data.data());
  CHECK((back + errors - entries).cwiseAbs().maxCoeff() < 1e-2F);
  std::vector<float> column(layers.stored_rows());
  load_layers_column(layers, data.data(), 5, column.data());
  for (int i = 0; i < layers.stored_rows(); ++i) CHECK(column[i] == back(i, 5));
  for (int i : {3, 30}) {
    std::vector<float> row(layers.stored_columns());
    load_layers_row(layers, data.data(), i, row.data());
    for (int j = 0; j < layers.stored_columns(); ++j) CHECK(row[j] == back(i, j));
  }
}

TEST_CASE("a matrix of zeros has no layers") {
  FloatMatrix zeros = FloatMatrix::Constant(5, 4, 0.4F);
  const Layers layers = fit_layers(zeros);
  CHECK(layers.bytes() == 0);
  CHECK(layers.stored_rows() == 0);
}

TEST_CASE("products of layers agree with their entries on every instruction set") {
  for (int rows : {1, 5, 16, 17, 40, 96, 131})
    for (float largest : {60.0F, 3000.0F, 1e6F}) {
      FloatMatrix entries = falling(rows, 37, largest);
      const Layers layers = fit_layers(entries);
      std::vector<std::uint8_t> data;
      FloatMatrix errors = entries;
      store_layers(layers, errors, data);
      data.resize(data.size() + 64);
      const Eigen::VectorXf x = Eigen::VectorXf::Random(37);
      const Eigen::MatrixXd stored = load_layers(layers, data.data()).cast<double>();
      const Eigen::VectorXd expected = stored * x.head(layers.stored_columns()).cast<double>();
      const Eigen::VectorXf left = Eigen::VectorXf::Random(rows);
      const Eigen::VectorXd from_left =
          stored.transpose() * left.head(layers.stored_rows()).cast<double>();
      for (int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        Eigen::VectorXf y = Eigen::VectorXf::Constant(rows, 2);
        multiply_layers(layers, data.data(), x.data(), y.data());
        Eigen::VectorXf transposed = Eigen::VectorXf::Constant(37, 2);
        multiply_layers_transposed(layers, data.data(), left.data(), transposed.data());
        hwy::SetSupportedTargetsForTest(0);
        const Eigen::VectorXd errors_of_y =
            (y.head(layers.stored_rows()).cast<double>().array() - 2).matrix() - expected;
        CHECK(errors_of_y.cwiseAbs().maxCoeff() < 2e-6 * largest);
        CHECK((y.tail(rows - layers.stored_rows()).array() == 2).all());
        const Eigen::VectorXd errors_from_left =
            (transposed.head(layers.stored_columns()).cast<double>().array() - 2).matrix() -
            from_left;
        CHECK(errors_from_left.cwiseAbs().maxCoeff() < 2e-6 * largest);
        CHECK((transposed.tail(37 - layers.stored_columns()).array() == 2).all());
      }
    }
}
