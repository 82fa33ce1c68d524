#pragma once

#include <string>

namespace bem {

/// How large matrices are stored.
enum class Codec {
  none,    ///< every entry
  haar,    ///< the largest coefficients of a Haar transform
  lowrank  ///< blocks with common bases, numbers of as many bits as they need
};

struct CodecOptions {
  Codec codec = Codec::none;
  /// Error of the matrices aimed at, relative to their Frobenius norm (of all lags together).
  double tolerance = 1e-4;
  /// Codec haar: entries before / coefficients kept; 0: as many as the tolerance asks for.
  double ratio = 0;
};

/// "none", "haar", "lowrank".
inline const char* codec_name(Codec codec) {
  switch (codec) {
    case Codec::haar:
      return "haar";
    case Codec::lowrank:
      return "lowrank";
    case Codec::none:
      break;
  }
  return "none";
}

}  // namespace bem
