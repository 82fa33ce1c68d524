#pragma once

#include "compress/codec.hpp"

namespace bem {

/// Codec "lowrank": blocks with common bases, numbers of as many bits as they need (LowRankFamily).
const Codec& low_rank_codec();

}  // namespace bem
