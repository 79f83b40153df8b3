#pragma once

namespace hlodbench {

// What the build knows of itself; never null.
extern const char* const kProgramVersion;  // "hlodbench 0.1.0"
extern const char* const kCompiler;
extern const char* const kBuildType;
extern const char* const kGitRevision;  // "" when the sources are no git checkout

}  // namespace hlodbench
