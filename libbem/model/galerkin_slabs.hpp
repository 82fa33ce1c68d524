#pragma once

#include "assembly/far_field.hpp"
#include "assembly/galerkin_assembler.hpp"
#include "model/parted_slab.hpp"
#include "model/slab_assembly.hpp"

namespace bem {

/// Rows of test functions, of n nodes, that are assembled together, and what they take [bytes].
int galerkin_rows_together(int n, const LaneLayout& layout, AssemblyPrecision precision);
double galerkin_row_bytes(int n, const LaneLayout& layout, AssemblyPrecision precision);

/// Matrices of the Galerkin method: rows are those of test functions that reach over two rings of
/// triangles, so that many of them are assembled together, as far as memory goes.
template <class T>
class GalerkinSlabs : public SlabAssembler<T> {
 public:
  GalerkinSlabs(BodyModel& model, AssemblyPrecision precision, MatrixForm form);

  void assemble(int first, int last, MatrixSlab<T>& slab) override;
  void use_factors(const std::vector<Slab>& partition) override;
  void allow_errors(const FarErrors& errors) override { errors_ = errors; }
  typename SlabAssembler<T>::Norms estimate_norms() override;
  double row_sum_residual() const override { return 0; }  // rigid translation is exact
  /// Without a history nothing is multiplied but by lag 0.
  bool is_inertial() const override { return this->model_.has_history(); }
  MatrixForm form() const override { return form_; }

 private:
  void assemble_factors(const PartedSlab& parted, bool with_forces, MatrixSlab<T>& slab);
  void add_forces(const NodeRange& nodes, const AlignedVector<double>& forces);
  void add_traction_moments(const FarBlock& block);
  template <class F>
  void with_rows(int first, int last, const F& f);
  template <class S>
  void load_rows(int first, int last, GalerkinRows<S>& rows) const;
  const PartedSlab* parted(int first, int last) const;
  template <class S>
  void add_squares(const GalerkinRows<S>& rows, int row,
                   typename SlabAssembler<T>::Norms& sum) const;
  int rows_in_memory() const;
  template <class S>
  void distribute_h(const GalerkinRows<S>& rows, int j, MatrixSlab<T>& slab) const;
  template <class S>
  void distribute_g(const GalerkinRows<S>& rows, int j, MatrixSlab<T>& slab) const;
  void add_traction_moments(const MatrixSlab<T>& slab);
  template <class S>
  void add_body_forces(const GalerkinRows<S>& rows, int first, int last, int node);

  AssemblyPrecision precision_;
  MatrixForm form_;
  std::vector<char> known_;  ///< by node: whether its rows are in the body forces
  GalerkinAssembler assembler_;
  GalerkinCombination combination_;
  std::unique_ptr<FarField> far_field_;  ///< null: no factors
  std::vector<PartedSlab> parted_;
  FarErrors errors_;
  GalerkinRows<float> single_;
  GalerkinRows<double> double_;
};

}  // namespace bem
