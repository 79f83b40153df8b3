#pragma once

#include <memory>

#include "hlod/render/gl_context.h"

namespace hlodbench {

// One function a kind of context, each in its own file; see GlContextInfo::make.
std::unique_ptr<GlContext> makeEglContext(const GlContextOptions& options);
std::unique_ptr<GlContext> makeOsMesaContext(const GlContextOptions& options);

}  // namespace hlodbench
