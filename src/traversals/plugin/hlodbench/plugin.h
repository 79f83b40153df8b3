#pragma once

// All that a new predictor or strategy for hlodbench needs; docs/writing-a-predictor.md. Nothing
// but the standard library, C++17 or later.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>

#include "options.h"
#include "predictor.h"
#include "strategy.h"

// The version of these headers. Major: what was built for another one cannot be loaded. Minor: the
// program loads what was built for its own or a smaller one.
#define HLODBENCH_API_MAJOR 1
#define HLODBENCH_API_MINOR 0

// What of the compiler's library crosses the border: exceptions.
#define HLODBENCH_TO_TEXT(x) HLODBENCH_TO_TEXT_(x)
#define HLODBENCH_TO_TEXT_(x) #x
#if defined(_GLIBCXX_USE_CXX11_ABI)
#define HLODBENCH_ABI "libstdc++, cxx11 ABI " HLODBENCH_TO_TEXT(_GLIBCXX_USE_CXX11_ABI)
#elif defined(_LIBCPP_ABI_VERSION)
#define HLODBENCH_ABI "libc++, ABI " HLODBENCH_TO_TEXT(_LIBCPP_ABI_VERSION)
#else
#define HLODBENCH_ABI "unknown standard library"
#endif

namespace hlodbench::plugin {

// One strategy of a file. Make one by describe().
struct StrategyDescriptor {
  const char* name;         // on the command line and in files: a-z, 0-9, - and _
  const char* label;        // in tables: "Coh(B)"
  const char* description;  // one line
  const OptionInfo* options;
  std::uint32_t optionCount;
  Modulation modulation;
  // one of these; the other is null
  Predictor* (*makePredictor)(const OptionValues&);
  Strategy* (*makeStrategy)(const OptionValues&);
};

struct StrategyList {
  const StrategyDescriptor* strategies;
  std::uint32_t count;
};

inline constexpr char kPluginMagic[8] = {'H', 'L', 'O', 'D', 'P', 'L', 'U', 'G'};

// What a plug-in's entry point returns.
struct PluginDescriptor {
  char magic[8];  // kPluginMagic
  std::uint32_t apiMajor, apiMinor;
  // what follows is as in this major version
  const char* abi;                                                             // HLODBENCH_ABI
  const char* compiler;                                                        // its version
  std::uint32_t nodeBytes, stateBytes, viewBytes, optionBytes, strategyBytes;  // sizes of structs
  StrategyList list;
};

// The entry point, by which a program finds the rest.
inline constexpr const char* kPluginEntry = "hlodbench_plugin";
using PluginEntry = const PluginDescriptor* (*)();

// T's constructor takes the values of its options, or nothing.
template <typename T>
T* makeFromOptions(const OptionValues& values) {
  if constexpr (std::is_constructible_v<T, const OptionValues&>)
    return new T(values);
  else
    return new T();
}

// Describes a class derived from Predictor or from Strategy. The texts must be literals, the
// options a constexpr or static array.
template <typename T>
StrategyDescriptor describe(const char* name, const char* label, const char* description,
                            Modulation modulation = Modulation::kBias) {
  static_assert(std::is_base_of_v<Predictor, T> != std::is_base_of_v<Strategy, T>,
                "expected a class derived from Predictor or from Strategy");
  StrategyDescriptor result{name, label, description, nullptr, 0, modulation, nullptr, nullptr};
  if constexpr (std::is_base_of_v<Predictor, T>)
    result.makePredictor = [](const OptionValues& v) -> Predictor* {
      return makeFromOptions<T>(v);
    };
  else
    result.makeStrategy = [](const OptionValues& v) -> Strategy* { return makeFromOptions<T>(v); };
  return result;
}
template <typename T, std::size_t kCount>
StrategyDescriptor describe(const char* name, const char* label, const char* description,
                            const OptionInfo (&options)[kCount],
                            Modulation modulation = Modulation::kBias) {
  StrategyDescriptor result = describe<T>(name, label, description, modulation);
  result.options = options;
  result.optionCount = static_cast<std::uint32_t>(kCount);
  return result;
}

inline PluginDescriptor makePluginDescriptor(StrategyList list) {
  PluginDescriptor result{{},
                          HLODBENCH_API_MAJOR,
                          HLODBENCH_API_MINOR,
                          HLODBENCH_ABI,
                          __VERSION__,
                          sizeof(Node),
                          sizeof(NodeState),
                          sizeof(FrameView),
                          sizeof(OptionInfo),
                          sizeof(StrategyDescriptor),
                          list};
  std::copy(std::begin(kPluginMagic), std::end(kPluginMagic), result.magic);
  return result;
}

}  // namespace hlodbench::plugin

// Stands once in a file, outside of every namespace: HLODBENCH_PLUGIN(FILE, describe<...>(...),
// ...) with one or more strategies. FILE is an identifier, by which the registry of the program
// finds the file when it is moved into the tree.
#define HLODBENCH_PLUGIN(file, ...)                                                     \
  static hlodbench::plugin::StrategyList makeStrategiesOf_##file() {                    \
    static const hlodbench::plugin::StrategyDescriptor strategies[] = {__VA_ARGS__};    \
    return {strategies, static_cast<std::uint32_t>(std::end(strategies) - strategies)}; \
  }                                                                                     \
  namespace hlodbench {                                                                 \
  plugin::StrategyList listStrategiesOf_##file();                                       \
  plugin::StrategyList listStrategiesOf_##file() {                                      \
    return ::makeStrategiesOf_##file();                                                 \
  }                                                                                     \
  }                                                                                     \
  HLODBENCH_PLUGIN_ENTRY(file)

// A program holds many such files, a plug-in is one.
#if defined(HLODBENCH_IN_TREE)
#define HLODBENCH_PLUGIN_ENTRY(file) static_assert(true, "")
#else
#define HLODBENCH_PLUGIN_ENTRY(file)                                                           \
  extern "C" __attribute__((visibility("default"))) const hlodbench::plugin::PluginDescriptor* \
  hlodbench_plugin() {                                                                         \
    static const hlodbench::plugin::PluginDescriptor descriptor =                              \
        hlodbench::plugin::makePluginDescriptor(hlodbench::listStrategiesOf_##file());         \
    return &descriptor;                                                                        \
  }                                                                                            \
  static_assert(true, "")
#endif
