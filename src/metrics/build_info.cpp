#include "metrics/build_info.h"

#include "git_revision.h"

#define HLODBENCH_STRING_OF(x) #x
#define HLODBENCH_STRING(x) HLODBENCH_STRING_OF(x)

namespace hlodbench {

const char* const kProgramVersion = "hlodbench " HLODBENCH_VERSION;

#if defined(__clang__)
const char* const kCompiler = "Clang " HLODBENCH_STRING(__clang_major__) "." HLODBENCH_STRING(
    __clang_minor__) "." HLODBENCH_STRING(__clang_patchlevel__);
#elif defined(__GNUC__)
const char* const kCompiler = "GCC " HLODBENCH_STRING(__GNUC__) "." HLODBENCH_STRING(
    __GNUC_MINOR__) "." HLODBENCH_STRING(__GNUC_PATCHLEVEL__);
#else
const char* const kCompiler = "unknown";
#endif

const char* const kBuildType = HLODBENCH_BUILD_TYPE;
const char* const kGitRevision = HLODBENCH_GIT_REVISION;

}  // namespace hlodbench
