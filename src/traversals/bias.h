#pragma once

#include <hlodbench/bias.h>

namespace hlodbench {

using plugin::BiasOptions;
using plugin::computeBias;
using plugin::computeSigmoid;

}  // namespace hlodbench
