#pragma once

#include <hlodbench/plugin.h>

#include <functional>

namespace hlodbench {

// A frame of the strategy "script" of sample_plugin.cpp.
extern std::function<void(const plugin::FrameView&, plugin::Frame&)> sampleFrame;

plugin::StrategyList listStrategiesOf_sample();

}  // namespace hlodbench
