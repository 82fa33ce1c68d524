#pragma once

#include "compress/codec.hpp"
#include "compress/dense_family.hpp"
#include "model/body_model.hpp"

namespace bem {

/// An uncompressed family compressed: what bemprecomp does with its rows as they are assembled.
/// `nodes`: in the order of the archive. `error`: relative Frobenius norm over all matrices.
std::unique_ptr<MatrixFamily> recode(const DenseFamily<float>& family,
                                     const std::vector<Vec3>& nodes, const CodecOptions& options,
                                     double& error);

/// The matrices of a model as they are: h, g, and inverse and traction response by initial
/// component. Throws ErrorCode::archive if they are not uncompressed in single precision.
struct NamedFamily {
  std::string name;
  std::unique_ptr<MatrixFamily>* family;
  double* error;  ///< where the model has that of the codec
};
std::vector<NamedFamily> families_of(BodyModel& model);
const DenseFamily<float>& dense_family(const NamedFamily& named);

/// Compresses all matrices of a model, one family after another.
void recode(BodyModel& model, const CodecOptions& options);

}  // namespace bem
