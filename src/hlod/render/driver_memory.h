#pragma once

namespace hlodbench {

// Lets the C library keep the memory that a software rasteriser takes and gives back in every
// frame, instead of returning it to the system and having it zeroed again page by page; with
// Mesa's llvmpipe that was about a fifth of the drawing thread's time. Does nothing with another C
// library, or where the user has set MALLOC_TRIM_THRESHOLD_.
void keepDriverMemory();

}  // namespace hlodbench
