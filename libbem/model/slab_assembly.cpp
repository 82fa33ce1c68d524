#include "model/slab_assembly.hpp"

#include "base/parallel.hpp"
#include "model/collocation_slabs.hpp"
#include "model/galerkin_slabs.hpp"

#include <cmath>

namespace bem {
namespace {

template <class Matrix>
void resize(std::vector<Matrix>& matrices, int count, Eigen::Index rows, Eigen::Index columns) {
  matrices.resize(count);
  for (auto& m : matrices) m.resize(rows, columns);  // not initialised
}

}  // namespace

template <class T>
SlabAssembler<T>::SlabAssembler(BodyModel& model)
    : model_(model),
      layout_(model.discretisation.scheme, model.discretisation.history_length),
      loaded_(model.loads == Loads::none ? 0 : model.nodes(), model.loads == Loads::all) {
  if (model.loads == Loads::some)
    for (int node : model.loaded_nodes) loaded_[node] = 1;
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  const std::size_t components = model.discretisation.scheme.initial_components().size();
  for (auto* lags : {&model_.body_force, &model_.centrifugal})
    lags->assign(lag_count(), Eigen::MatrixXd::Zero(n, 6));
  for (auto* initial : {&model_.initial_body_force, &model_.initial_centrifugal})
    initial->assign(components, Eigen::MatrixXcd::Zero(n, 6));
}

template <class T>
void SlabAssembler<T>::prepare(int first, int last, ColumnPlaces h, ColumnPlaces g,
                               MatrixSlab<T>& slab) const {
  const Eigen::Index rows = 3 * (last - first), h_columns = 3 * h.count, g_columns = 3 * g.count;
  slab.first = first;
  slab.last = last;
  slab.h_columns = std::move(h);
  slab.g_columns = std::move(g);
  slab.far.clear();
  resize(slab.h, lag_count(), rows, h_columns);
  resize(slab.g, has_tractions() ? lag_count() : 0, rows, g_columns);
  resize(slab.initial_h, initial_count(), rows, h_columns);
  resize(slab.initial_g, has_tractions() ? initial_count() : 0, rows, g_columns);
  if (model_.loads == Loads::some) {
    clear_columns(slab.g_columns, slab.g);
    clear_columns(slab.g_columns, slab.initial_g);
  }
}

template <class T>
void SlabAssembler<T>::prepare(int first, int last, MatrixSlab<T>& slab) const {
  const ColumnPlaces all(static_cast<int>(model_.nodes()), 0);
  prepare(first, last, all, all, slab);
}

/// Those of nodes without loads.
template <class T>
template <class Matrix>
void SlabAssembler<T>::clear_columns(const ColumnPlaces& columns,
                                     std::vector<Matrix>& matrices) const {
  parallel_for(matrices.size(), [&](std::size_t k) {
    for (std::size_t node = 0; node < loaded_.size(); ++node)
      if (!loaded_[node] && columns.place[node] >= 0)
        matrices[k].middleCols(3 * columns.place[node], 3).setZero();
  });
}

template <class T>
template <class F>
void SlabAssembler<T>::change_columns(int node, const double* from, int entries, int padded_lanes,
                                      Eigen::Index first, std::vector<Eigen::MatrixXd>& lags,
                                      std::vector<Eigen::MatrixXcd>& initial, const F& f) const {
  const auto& components = model_.discretisation.scheme.initial_components();
  for (int e = 0; e < entries; ++e) {
    const Eigen::Index r = 3 * node + e / (entries / 3), c = first + e % (entries / 3);
    const double* lanes = from + static_cast<std::size_t>(e) * padded_lanes;
    for (int lane = layout_.initial; lane < layout_.count(); ++lane)
      f(lags[lane - layout_.initial](r, c), lanes[lane]);
    int lane = 0;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const bool paired = components[i].paired;
      f(initial[i](r, c), Complex(lanes[lane], paired ? lanes[lane + 1] : 0.0));
      lane += paired ? 2 : 1;
    }
  }
}

template <class T>
void SlabAssembler<T>::distribute_columns(int node, const double* from, int entries,
                                          int padded_lanes, Eigen::Index first,
                                          std::vector<Eigen::MatrixXd>& lags,
                                          std::vector<Eigen::MatrixXcd>& initial) const {
  change_columns(node, from, entries, padded_lanes, first, lags, initial,
                 [](auto& entry, auto value) { entry = value; });
}

template <class T>
void SlabAssembler<T>::add_columns(int node, const double* from, int padded_lanes,
                                   std::vector<Eigen::MatrixXd>& lags,
                                   std::vector<Eigen::MatrixXcd>& initial) const {
  change_columns(node, from, 18, padded_lanes, 0, lags, initial,
                 [](auto& entry, auto value) { entry += value; });
}

template <class T>
typename SlabAssembler<T>::Norms SlabAssembler<T>::Norms::root(double scale) const {
  return {std::sqrt(scale * h),         std::sqrt(scale * g),
          std::sqrt(scale * stiffness), std::sqrt(scale * initial_h),
          std::sqrt(scale * initial_g), std::sqrt(scale * initial_inertia)};
}

template <class T>
std::unique_ptr<SlabAssembler<T>> make_slab_assembler(BodyModel& model, AssemblyPrecision precision,
                                                      bool whole) {
  if (model.discretisation.is_galerkin())
    return std::make_unique<GalerkinSlabs<T>>(model, precision,
                                              whole ? MatrixForm::general : MatrixForm::symmetric);
  return std::make_unique<CollocationSlabs<T>>(model, precision);
}

template class SlabAssembler<float>;
template class SlabAssembler<double>;
template std::unique_ptr<SlabAssembler<float>> make_slab_assembler(BodyModel&, AssemblyPrecision,
                                                                   bool);
template std::unique_ptr<SlabAssembler<double>> make_slab_assembler(BodyModel&, AssemblyPrecision,
                                                                    bool);

}  // namespace bem
