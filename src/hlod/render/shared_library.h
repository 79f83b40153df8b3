#pragma once

#include <dlfcn.h>

#include <string>

#include "hlod/core/error.h"

namespace hlodbench {

// A library opened at run time: the program starts on a machine without it, and can say what is
// missing. It is never closed: Mesa's drivers leave threads and exit handlers behind.
class SharedLibrary {
 public:
  // Throws GlUnavailable naming the file, the loader's reason and the Debian package.
  SharedLibrary(const char* file, const char* package) : handle_(dlopen(file, RTLD_NOW)) {
    if (handle_ == nullptr)
      throw GlUnavailable(std::string(file) + " cannot be loaded (" + dlerror() +
                          "); Debian package: " + package);
  }
  template <typename Function>
  Function get(const char* symbol) const {
    void* address = dlsym(handle_, symbol);
    if (address == nullptr) throw GlUnavailable(std::string(symbol) + " is missing: " + dlerror());
    return reinterpret_cast<Function>(address);
  }

 private:
  void* handle_;
};

}  // namespace hlodbench
