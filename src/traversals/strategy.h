#pragma once

#include "hlod/view/camera.h"
#include "metrics/counters.h"
#include "traversals/frame_services.h"
#include "traversals/trace_event.h"

namespace hlodbench {

// One technique of rendering a frame: gets a camera and the services of a renderer, leaves
// counters. It keeps what it has to remember from frame to frame; a new object starts cold.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // Renders one frame. Sets in `record` every counter that the technique has; timings are the
  // caller's. Appends its decisions to `trace` when that is not null.
  virtual void renderFrame(const Camera& camera, FrameServices& services, FrameRecord& record,
                           Trace* trace) = 0;
};

}  // namespace hlodbench
