#pragma once

#include "algebra/matrix_form.hpp"
#include "compress/codec.hpp"
#include "model/body_model.hpp"

namespace bem {

/// A family compressed, to a tolerance relative to its own Frobenius norm. `nodes`: in the order of
/// the archive. `form`: of the matrices. `error`: what was reached.
std::unique_ptr<MatrixFamily> recode(const MatrixFamily& family, MatrixForm form,
                                     const std::vector<Vec3>& nodes, const CodecOptions& options,
                                     double& error);

/// A family of a model: h, g, and those of lag 0 by initial component.
struct NamedFamily {
  std::string name;
  MatrixForm form;
  std::unique_ptr<MatrixFamily>* family;
  double* error;  ///< where the model has that of the codec
};
std::vector<NamedFamily> families_of(BodyModel& model);

/// Compresses all matrices of a model, one family after another.
void recode(BodyModel& model, const CodecOptions& options);

}  // namespace bem
