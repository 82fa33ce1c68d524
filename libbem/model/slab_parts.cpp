#include "model/slab_parts.hpp"

namespace bem {
namespace {

NodeBlock nodes_of(const FarBlock& b) {
  return {b.rows.begin, b.rows.end, b.columns.begin, b.columns.end, true};
}

/// `count` matrices from `first` on.
FactoredBlock some_of(const FarBlock& b, const FactoredMatrices& factors, std::size_t first,
                      std::size_t count) {
  FactoredBlock out{nodes_of(b), &factors.outputs, {}};
  for (std::size_t k = first; k < first + count; ++k) out.inputs.push_back(&factors.inputs[k]);
  return out;
}

std::vector<FactoredBlock> some_of_each(const std::vector<FarBlock>& far,
                                        FactoredMatrices FarBlock::*factors, std::size_t first,
                                        std::size_t count) {
  std::vector<FactoredBlock> out;
  for (const FarBlock& b : far)
    if (!(b.*factors).empty()) out.push_back(some_of(b, b.*factors, first, count));
  return out;
}

template <class T>
std::vector<typename MatrixSlab<T>::Matrix> rounded(const std::vector<Eigen::MatrixXd>& from,
                                                    int first, int count) {
  std::vector<typename MatrixSlab<T>::Matrix> out;
  for (int k = first; k < first + count; ++k) out.emplace_back(from[k].template cast<T>());
  return out;
}

/// The first matrix, which has `fixed` added to it, and the others.
FactoredMatrices sum_of(const FactoredMatrices& moving, const FactoredMatrices& fixed, int first,
                        int count) {
  const Eigen::Index a = moving.outputs.cols(), b = fixed.outputs.cols();
  FactoredMatrices out;
  out.outputs.resize(moving.outputs.rows(), a + b);
  out.outputs << moving.outputs, fixed.outputs;
  for (int k = first; k < first + count; ++k) {
    Eigen::MatrixXf inputs = Eigen::MatrixXf::Zero(a + b, moving.inputs[k].cols());
    inputs.topRows(a) = moving.inputs[k];
    if (k == first) inputs.bottomRows(b) = fixed.inputs[0];
    out.inputs.push_back(std::move(inputs));
  }
  return out;
}

/// To the real parts of lag 0 of an expanded block.
template <class T>
void add_stiffness(const FarBlock& block, const Scheme& scheme, MatrixSlab<T>& slab) {
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    const auto at = [&](Eigen::MatrixXd& m) {
      return m.block(3 * (block.rows.begin - slab.first),
                     3 * slab.h_columns.place[block.columns.begin], 3 * block.rows.size(),
                     3 * block.columns.size());
    };
    at(slab.initial_h[lane]) += at(slab.stiffness);
    lane += c.paired ? 2 : 1;
  }
}

}  // namespace

template <class T>
void multiply_out(const FarBlock& block, const Scheme& scheme, MatrixSlab<T>& slab) {
  const Eigen::Index row = 3 * (block.rows.begin - slab.first);
  const auto set = [&](const FactoredMatrices& factors, std::size_t k, const ColumnPlaces& columns,
                       auto& to) {
    const Eigen::MatrixXf entries = factors.outputs * factors.inputs[k];
    auto part =
        to.block(row, 3 * columns.place[block.columns.begin], entries.rows(), entries.cols());
    part = entries.cast<typename std::decay_t<decltype(to)>::Scalar>();
  };
  const auto set_lanes = [&](const FactoredMatrices& factors, const ColumnPlaces& columns,
                             auto& initial, auto& lags) {
    for (std::size_t k = 0; k < factors.inputs.size(); ++k) {
      if (k < initial.size())
        set(factors, k, columns, initial[k]);
      else
        set(factors, k, columns, lags[k - initial.size()]);
    }
  };
  if (!block.stiffness.empty()) set(block.stiffness, 0, slab.h_columns, slab.stiffness);
  set_lanes(block.inertia, slab.h_columns, slab.initial_h, slab.h);
  if (!block.inertia.empty()) add_stiffness(block, scheme, slab);
  set_lanes(block.tractions, slab.g_columns, slab.initial_g, slab.g);
}

template <class T>
SlabParts<T> h_parts(const MatrixSlab<T>& slab) {
  return {views(slab.h), &slab.h_columns.place,
          some_of_each(slab.far, &FarBlock::inertia, slab.initial_h.size(), slab.h.size())};
}

template <class T>
SlabParts<T> g_parts(const MatrixSlab<T>& slab) {
  return {views(slab.g), &slab.g_columns.place,
          some_of_each(slab.far, &FarBlock::tractions, slab.initial_g.size(), slab.g.size())};
}

template <class T>
SlabFamily<T> stiffness_parts(const MatrixSlab<T>& slab) {
  SlabFamily<T> out;
  out.matrices.emplace_back(slab.stiffness.template cast<T>());
  out.parts = {views(out.matrices), &slab.h_columns.place,
               some_of_each(slab.far, &FarBlock::stiffness, 0, 1)};
  return out;
}

template <class T>
SlabFamily<T> initial_h_parts(const MatrixSlab<T>& slab, int first, int count) {
  SlabFamily<T> out;
  out.matrices = rounded<T>(slab.initial_h, first, count);
  out.parts = {views(out.matrices), &slab.h_columns.place, {}};
  out.sums.reserve(slab.far.size());
  for (const FarBlock& b : slab.far) {
    if (b.inertia.empty()) continue;
    out.sums.push_back(sum_of(b.inertia, b.stiffness, first, count));
    out.parts.factored.push_back({nodes_of(b), &out.sums.back().outputs, {}});
    for (const Eigen::MatrixXf& m : out.sums.back().inputs)
      out.parts.factored.back().inputs.push_back(&m);
  }
  return out;
}

template <class T>
SlabFamily<T> initial_g_parts(const MatrixSlab<T>& slab, int first, int count) {
  SlabFamily<T> out;
  out.matrices = rounded<T>(slab.initial_g, first, count);
  out.parts = {views(out.matrices), &slab.g_columns.place,
               some_of_each(slab.far, &FarBlock::tractions, first, count)};
  return out;
}

template void multiply_out(const FarBlock&, const Scheme&, MatrixSlab<float>&);
template SlabParts<float> h_parts(const MatrixSlab<float>&);
template SlabParts<float> g_parts(const MatrixSlab<float>&);
template SlabFamily<float> stiffness_parts(const MatrixSlab<float>&);
template SlabFamily<float> initial_h_parts(const MatrixSlab<float>&, int, int);
template SlabFamily<float> initial_g_parts(const MatrixSlab<float>&, int, int);
template void multiply_out(const FarBlock&, const Scheme&, MatrixSlab<double>&);
template SlabParts<double> h_parts(const MatrixSlab<double>&);
template SlabParts<double> g_parts(const MatrixSlab<double>&);
template SlabFamily<double> stiffness_parts(const MatrixSlab<double>&);
template SlabFamily<double> initial_h_parts(const MatrixSlab<double>&, int, int);
template SlabFamily<double> initial_g_parts(const MatrixSlab<double>&, int, int);

}  // namespace bem
