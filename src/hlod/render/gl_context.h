#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hlodbench {

struct GlContextOptions {
  bool debug = false;  // ask for a debug context, report every GL error and stop there
};

// A current OpenGL context (3.3 core or later) with its functions loaded. It has no default
// framebuffer: draw into one of your own. One at a time in a process: the functions are global.
class GlContext {
 public:
  virtual ~GlContext() = default;

  std::string name;                // "egl" or "osmesa"
  std::string detail;              // which device or platform was taken, and why
  std::vector<std::string> tried;  // one line for each way that failed before, with the reason
  std::string vendor, renderer, version;  // GL strings
};

struct GlContextInfo {
  std::string_view name;
  std::string_view description;
  // Makes the context current and fills in `detail`; throws GlUnavailable.
  std::unique_ptr<GlContext> (*make)(const GlContextOptions&);
};

// Every kind of context that was built in, in the order in which "auto" tries them.
std::span<const GlContextInfo> listContexts();

// name: "auto" or one of listContexts(). Throws InputError for a name that is not known and
// GlUnavailable, saying what was tried and what package is missing, when no context can be had.
std::unique_ptr<GlContext> createContext(std::string_view name, const GlContextOptions& options);

// For a context that was made current and had its functions loaded elsewhere, as that of a window:
// fills in what is the same for every kind. Throws GlUnavailable for a version below 3.3.
void completeContext(GlContext& context, std::string_view name, const GlContextOptions& options);

}  // namespace hlodbench
