#include "algebra/blas.hpp"
#include "base/parallel.hpp"
#include "compress/low_rank_family.hpp"

#include <algorithm>
#include <optional>

// Products of a family of low-rank matrices with vectors.

namespace bem {
namespace {

using FloatVector = Eigen::VectorXf;

void scale(const float* scales, int count, float* values) {
  for (int i = 0; i < count; ++i) values[i] *= scales[i];
}

}  // namespace

void LowRankFamily::analyse_columns(const double* x, Eigen::Index count,
                                    float* coefficients) const {
  const FloatMatrix single =
      Eigen::Map<const Eigen::MatrixXd>(x, static_cast<Eigen::Index>(size_), count).cast<float>();
  parallel_for(slabs_.size(), [&](std::size_t s) {
    const LowRankSlab& slab = slabs_[s];
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      const LowRankBlock& block = slab.blocks[b];
      if (block.plain) continue;
      const Place& p = places_[s][b];
      for (Eigen::Index c = 0; c < count; ++c) {
        const float* in = single.col(c).data();
        float* all = coefficients + static_cast<std::size_t>(c) * coefficients_;
        float* out = all + p.coefficients;
        std::fill_n(out, block.input_rank(), 0.0F);
        multiply_layers(block.input_basis, slab.analysis.data() + p.analysis,
                        in + block.column_begin, out);
        scale(slab.input_scales.data() + p.input_scales, block.input_rank(), out);
        if (!is_mirrored(block)) continue;
        out = all + p.mirrored_coefficients;
        std::fill_n(out, block.output_rank(), 0.0F);
        multiply_layers_transposed(block.output_basis, slab.synthesis.data() + p.output_basis,
                                   in + block.row_begin, out);
        scale(slab.output_scales.data() + p.output_scales, block.output_rank(), out);
      }
    }
  });
}

/// The outputs of one slab while its blocks are multiplied one after another: its rows, and of
/// mirror images the rows below.
class LowRankFamily::SlabProduct {
 public:
  SlabProduct(const LowRankFamily& family, std::size_t slab, std::size_t outputs)
      : family_(family),
        slab_(family.slabs_[slab]),
        places_(family.places_[slab]),
        touched_(outputs, 0) {
    const int end =
        family.form_ == MatrixForm::symmetric ? static_cast<int>(family.size_) : slab_.row_end;
    sums_ = Eigen::MatrixXd::Zero(end - slab_.row_begin, static_cast<Eigen::Index>(outputs));
  }

  /// Begins the products with block b.
  void begin(std::size_t b) {
    block_ = &slab_.blocks[b];
    index_ = b;
    mirrored_ = family_.is_mirrored(*block_);
    coupled_.setZero(block_->output_rank(), sums_.cols());
    if (mirrored_) mirrored_coupled_.setZero(block_->input_rank(), sums_.cols());
    std::fill(touched_.begin(), touched_.end(), 0);
  }
  bool is_mirrored() const { return mirrored_; }
  /// Where the caller puts the next input, in coefficients of the block, and of its mirror image.
  float* input() {
    input_.resize(block_->input_rank());
    return input_.data();
  }
  float* mirrored_input() {
    mirrored_input_.resize(block_->output_rank());
    return mirrored_input_.data();
  }
  /// Working memory for a vector in a basis of the block, zero.
  float* unit(int rank) {
    unit_.setZero(rank);
    return unit_.data();
  }
  void multiply(int matrix, int output) {
    const Layers& layers = slab_.couplings[index_ * family_.count_ + matrix];
    const std::uint8_t* data = slab_.synthesis.data() + places_[index_].couplings[matrix];
    multiply_layers(layers, data, input_.data(), coupled_.col(output).data());
    if (mirrored_)
      multiply_layers_transposed(layers, data, mirrored_input_.data(),
                                 mirrored_coupled_.col(output).data());
    touched_[output] = 1;
  }
  void end() {
    const auto quantum = static_cast<float>(family_.quantum_);
    const Place& p = places_[index_];
    const auto add = [&](auto sum, auto coupled, const float* scales, const auto& synthesise) {
      coupled *= quantum;
      if (block_->plain) {
        sum += coupled.template cast<double>();
        return;
      }
      scale(scales, static_cast<int>(coupled.size()), coupled.data());
      synthesised_.setZero(sum.size());
      synthesise(coupled.data(), synthesised_.data());
      sum += synthesised_.cast<double>();
    };
    for (Eigen::Index o = 0; o < sums_.cols(); ++o) {
      if (!touched_[o]) continue;
      const auto rows = [&](int begin, int count) {
        return sums_.col(o).segment(begin - slab_.row_begin, count);
      };
      add(rows(block_->row_begin, block_->rows()), coupled_.col(o),
          slab_.output_scales.data() + p.output_scales, [&](const float* x, float* y) {
            multiply_layers(block_->output_basis, slab_.synthesis.data() + p.output_basis, x, y);
          });
      if (!mirrored_) continue;
      add(rows(block_->column_begin, block_->columns()), mirrored_coupled_.col(o),
          slab_.input_scales.data() + p.input_scales, [&](const float* x, float* y) {
            multiply_layers_transposed(block_->input_basis, slab_.analysis.data() + p.analysis, x,
                                       y);
          });
    }
  }
  /// Adds what there is for rows [begin, end) to an output.
  void add_to(double* output, Eigen::Index index, int begin, int end) const {
    const int last = std::min(end, slab_.row_begin + static_cast<int>(sums_.rows()));
    if (begin < last)
      Eigen::Map<Eigen::VectorXd>(output + begin, last - begin) +=
          sums_.col(index).segment(begin - slab_.row_begin, last - begin);
  }

 private:
  const LowRankFamily& family_;
  const LowRankSlab& slab_;
  const std::vector<Place>& places_;
  Eigen::MatrixXd sums_;
  std::vector<char> touched_;
  const LowRankBlock* block_ = nullptr;
  std::size_t index_ = 0;
  bool mirrored_ = false;
  FloatMatrix coupled_, mirrored_coupled_;
  FloatVector input_, mirrored_input_, unit_, synthesised_;
};

template <class F>
void LowRankFamily::multiply_blocks(const std::vector<double*>& outputs, const F& add) const {
  std::vector<std::optional<SlabProduct>> products(slabs_.size());
  parallel_for(slabs_.size(), [&](std::size_t s) {
    SlabProduct& product = products[s].emplace(*this, s, outputs.size());
    for (std::size_t b = 0; b < slabs_[s].blocks.size(); ++b) {
      product.begin(b);
      add(product, s, b);
      product.end();
    }
  });
  // in the order of slabs, of which the first ones have mirror images in the rows of later ones
  parallel_for(slabs_.size(), [&](std::size_t s) {
    for (std::size_t from = form_ == MatrixForm::symmetric ? 0 : s; from <= s; ++from)
      for (std::size_t o = 0; o < outputs.size(); ++o)
        products[from]->add_to(outputs[o], static_cast<Eigen::Index>(o), slabs_[s].row_begin,
                               slabs_[s].row_end);
  });
}

void LowRankFamily::multiply_add(const std::vector<FamilyTerm>& unsorted,
                                 const std::vector<double*>& outputs) const {
  const std::vector<FamilyTerm> terms = sorted_by_matrix(unsorted);
  if (terms.empty()) return;
  multiply_blocks(outputs, [&](SlabProduct& product, std::size_t s, std::size_t b) {
    const LowRankSlab& slab = slabs_[s];
    const LowRankBlock& block = slab.blocks[b];
    const Place& p = places_[s][b];
    for (const FamilyTerm& t : terms) {
      if (slab.couplings[b * count_ + t.matrix].stored_rows() == 0) continue;
      const auto factor = static_cast<float>(t.factor);
      const auto set = [&](float* to, int count, const double* x, const float* coefficients) {
        for (int i = 0; i < count; ++i)
          to[i] = factor * (block.plain ? static_cast<float>(x[i]) : coefficients[i]);
      };
      set(product.input(), block.input_rank(), t.input + block.column_begin,
          t.coefficients + p.coefficients);
      if (product.is_mirrored())
        set(product.mirrored_input(), block.output_rank(), t.input + block.row_begin,
            t.coefficients + p.mirrored_coefficients);
      product.multiply(t.matrix, t.output);
    }
  });
}

void LowRankFamily::multiply_add(const std::vector<SparseTerm>& unsorted,
                                 const std::vector<double*>& outputs) const {
  const std::vector<SparseTerm> terms = sorted_by_matrix(unsorted);
  if (terms.empty()) return;
  multiply_blocks(outputs, [&](SlabProduct& product, std::size_t s, std::size_t b) {
    const LowRankSlab& slab = slabs_[s];
    const LowRankBlock& block = slab.blocks[b];
    const Place& p = places_[s][b];
    for (const SparseTerm& t : terms) {
      if (slab.couplings[b * count_ + t.matrix].stored_rows() == 0) continue;
      const std::vector<int>& columns = *t.columns;
      const auto entries_in = [&](int begin, int end) {
        const auto first = std::lower_bound(columns.begin(), columns.end(), begin);
        return std::pair(first, std::lower_bound(first, columns.end(), end));
      };
      const auto own = entries_in(block.column_begin, block.column_end);
      const auto mirrored = entries_in(block.row_begin, block.row_end);
      const bool met =
          own.first != own.second || (product.is_mirrored() && mirrored.first != mirrored.second);
      if (!met) continue;
      // coefficients of entries, which count from `begin` on; load: of a unit entry
      const auto set = [&](float* to, int rank, const auto& entries, int begin, const auto& load,
                           const float* scales) {
        std::fill_n(to, rank, 0.0F);
        for (auto c = entries.first; c != entries.second; ++c) {
          const auto value = static_cast<float>(t.factor * t.values[c - columns.begin()]);
          if (block.plain) {
            to[*c - begin] += value;
            continue;
          }
          float* unit = product.unit(rank);
          load(*c - begin, unit);
          for (int i = 0; i < rank; ++i) to[i] += value * unit[i] * scales[i];
        }
      };
      const auto of_column = [&](int j, float* out) {
        if (j < block.input_basis.stored_columns())
          load_layers_column(block.input_basis, slab.analysis.data() + p.analysis, j, out);
      };
      const auto of_row = [&](int i, float* out) {
        if (i < block.output_basis.stored_rows())
          load_layers_row(block.output_basis, slab.synthesis.data() + p.output_basis, i, out);
      };
      set(product.input(), block.input_rank(), own, block.column_begin, of_column,
          slab.input_scales.data() + p.input_scales);
      if (product.is_mirrored())
        set(product.mirrored_input(), block.output_rank(), mirrored, block.row_begin, of_row,
            slab.output_scales.data() + p.output_scales);
      product.multiply(t.matrix, t.output);
    }
  });
}

void LowRankFamily::multiply_transposed_add(const std::vector<FamilyTerm>& unsorted,
                                            const std::vector<double*>& outputs) const {
  std::vector<FamilyTerm> terms = sorted_by_matrix(unsorted);
  const auto size = static_cast<Eigen::Index>(size_);
  if (form_ == MatrixForm::symmetric) {
    FloatMatrix coefficients(static_cast<Eigen::Index>(coefficients_),
                             static_cast<Eigen::Index>(terms.size()));
    for (std::size_t t = 0; t < terms.size(); ++t) {
      float* own = coefficients.col(static_cast<Eigen::Index>(t)).data();
      analyse(terms[t].input, own);
      terms[t].coefficients = own;
    }
    multiply_add(terms, outputs);
    return;
  }
  std::vector<FloatMatrix> sums(slabs_.size());
  parallel_for(slabs_.size(), [&](std::size_t s) {
    const LowRankSlab& slab = slabs_[s];
    sums[s] = FloatMatrix::Zero(size, static_cast<Eigen::Index>(outputs.size()));
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      const LowRankBlock& block = slab.blocks[b];
      FloatMatrix synthesis, coupled;
      if (!block.plain) synthesis = output_basis(s, b);
      FloatMatrix coefficients = FloatMatrix::Zero(block.input_rank(), sums[s].cols());
      int loaded = -1;
      for (const FamilyTerm& t : terms) {
        if (t.matrix != loaded) coupled = coupling(s, b, t.matrix);
        loaded = t.matrix;
        const FloatVector x =
            (t.factor * Eigen::Map<const Eigen::VectorXd>(t.input + block.row_begin, block.rows()))
                .cast<float>();
        const FloatVector y = block.plain ? x : FloatVector(synthesis.transpose() * x);
        coefficients.col(t.output).noalias() += coupled.transpose() * y;
      }
      auto sum = sums[s].middleRows(block.column_begin, block.columns());
      if (block.plain)
        sum += coefficients;
      else
        sum.noalias() += input_basis(s, b).transpose() * coefficients;
    }
  });
  for (const FloatMatrix& part : sums)
    for (std::size_t o = 0; o < outputs.size(); ++o)
      Eigen::Map<Eigen::VectorXd>(outputs[o], size) +=
          part.col(static_cast<Eigen::Index>(o)).cast<double>();
}

}  // namespace bem
