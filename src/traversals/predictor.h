#pragma once

#include <hlodbench/predictor.h>

namespace hlodbench {

// The predictors of the tree are made of what those of plug-ins are made of.
using plugin::FrameView;
using plugin::Modulation;
using plugin::NodeState;
using plugin::Prediction;
using plugin::Predictor;

}  // namespace hlodbench
