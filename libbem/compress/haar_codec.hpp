#pragma once

#include "compress/codec.hpp"

namespace bem {

/// Codec "haar": the largest coefficients of a Haar transform of each matrix (HaarFamily).
const Codec& haar_codec();

}  // namespace bem
