#pragma once

#include "compress/codec.hpp"
#include "model/slab_assembly.hpp"

#include <algorithm>

namespace bem {

/// The defaults here are the plainest matrices, not those of bemprecomp: see model/defaults.hpp.
struct PrecomputeOptions {
  /// rigid: nothing below but the material counts; quasistatic: no history, a multistep method,
  /// quasistatic_time_step(), dense inverse.
  ModelKind kind = ModelKind::dynamic;
  Discretisation discretisation;
  CodecOptions codec;
  InverseKind inverse = InverseKind::dense;
  Loads loads = Loads::all;       ///< what is kept of G and H_0^{-1} G_0
  std::vector<int> loaded_nodes;  ///< of Loads::some, ascending; needs a sampled codec
  double window = 0;              ///< 0: the weakest that keeps the measured growth at or below 1
  bool measure_growth = true;
  bool energies = false;  ///< of the Galerkin method with a dense inverse: BodyModel::energy_mass
};

/// The codec with the tolerance that a body needs. Errors of a codec are relative to a whole
/// matrix; where a body of the Galerkin method is thin, or its triangles are small beside others,
/// its inertia is a small part of that, and motions would grow if it were lost: there the tolerance
/// is as much smaller. O(n log n).
CodecOptions codec_of_body(const BodyGeometry& geometry, SpatialMethod method, CodecOptions codec);

/// How D(0) of the inertial form is stored: displacements of slow motions are multiplied by it,
/// whose forces are a small part of what its largest entries make of others.
inline CodecOptions stiffness_codec(CodecOptions options) {
  constexpr double kPart = 1e-3, kSmallest = 1e-7;  // single precision
  options.tolerance = std::max(kSmallest, kPart * options.tolerance);
  options.ratio = 0;
  return options;
}

/// Computes all matrices of a body. Bit-identical for any number of threads. Throws
/// ErrorCode::numerical if the automatic window would leave less than a hundredth of a motion after
/// the time that a shear wave takes across the body.
/// Cost: assembly O(N^2), inversion O(N^3); memory: model/memory_estimate.hpp.
BodyModel precompute(BodyGeometry geometry, const PrecomputeOptions& options,
                     const Progress& progress = nullptr);

}  // namespace bem
