#pragma once

#include "assembly/row_assembler.hpp"
#include "model/slab_assembly.hpp"

namespace bem {

/// Matrices of collocation: every row is that of its node.
template <class T>
class CollocationSlabs : public SlabAssembler<T> {
 public:
  CollocationSlabs(BodyModel& model, AssemblyPrecision precision);

  void assemble(int first, int last, MatrixSlab<T>& slab) override;
  typename SlabAssembler<T>::Norms estimate_norms() override;
  double row_sum_residual() const override { return residual_; }
  bool is_inertial() const override { return false; }
  MatrixForm form() const override { return MatrixForm::general; }

 private:
  template <class S>
  void assemble_tiles(int first, int last, MatrixSlab<T>& slab);
  template <class S>
  void distribute(int first, const std::vector<BlockRow<S>>& rows, int count,
                  MatrixSlab<T>& slab) const;

  AssemblyPrecision precision_;
  RowAssembler assembler_;
  double residual_ = 0;
};

}  // namespace bem
