#pragma once

#include "compress/codec.hpp"

namespace bem {

/// Codec "none": every entry as it is; an archive has a dataset for every matrix.
const Codec& dense_codec(Precision precision);

}  // namespace bem
