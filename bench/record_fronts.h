#pragma once

#include <functional>

#include "hlod/core/progress.h"
#include "hlod/query/query_source.h"
#include "hlod/render/renderer.h"
#include "session.h"
#include "traversals/front_recording.h"
#include "traversals/options.h"

namespace hlodbench {

// Replays the session once with SW(B), untimed, and keeps what it decided. Holds fewer frames than
// the session when it was interrupted.
FrontRecording recordFronts(const Hierarchy& hierarchy, const TraversalOptions& options,
                            const Session& session, Renderer& renderer, QuerySource& queries,
                            const std::function<bool()>& isInterrupted, const Progress& progress);

}  // namespace hlodbench
