#include "replay.h"

#include <ctime>

#include "gl_frame_services.h"
#include "hlod/render/frame_pacer.h"
#include "hlod/render/gpu_timer.h"

namespace hlodbench {
namespace {

using Clock = std::chrono::steady_clock;

double computeMs(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

// Processor time of the calling thread, milliseconds.
double readThreadCpuMs() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void storeGpuTime(GpuTimer& timer, std::vector<FrameRecord>& records, bool drain) {
  if (const auto reading = timer.read(drain))
    records[reading->frame].set(Counter::kGpuMs, reading->milliseconds);
}

// Where everything is there, these counters are absent.
void storeResidency(const Renderer& renderer, FrameRecord& record) {
  if (!renderer.isLimited()) return;
  const ResidencyCounters& counters = renderer.residency();
  record.set(Counter::kMissingNodes, static_cast<double>(counters.missingNodes));
  record.set(Counter::kLoads, static_cast<double>(counters.loads));
  record.set(Counter::kEvictions, static_cast<double>(counters.evictions));
  record.set(Counter::kResidentMib, static_cast<double>(counters.residentBytes) / (1 << 20));
}

}  // namespace

std::vector<FrameRecord> replaySession(const Session& session, Strategy& strategy,
                                       Renderer& renderer, QuerySource& queries,
                                       const ReplayOptions& options, const ReplayHooks& hooks) {
  std::vector<FrameRecord> records;
  records.reserve(session.poses.size());
  GlFrameServices services(renderer, queries, options.slowdown);
  FramePacer pacer(options.framesInFlight);
  GpuTimer timer;
  Trace trace;
  glFinish();
  auto start = Clock::now();
  for (int i = 0; i < static_cast<int>(session.poses.size()) && !hooks.isInterrupted(); ++i) {
    if (hooks.turns != nullptr && hooks.turns->beginsWith(i)) {
      hooks.turns->take(hooks.isInterrupted);
      start = Clock::now();
    }
    FrameRecord& record = records.emplace_back();
    record.frame = i;
    record.warmUp = i < options.warmUpFrames;
    const bool isTraced = hooks.onTrace && (!hooks.isTraced || hooks.isTraced(i));
    const double cpuStart = readThreadCpuMs();
    const Camera camera = makeCamera(session.lens, session.poses[i]);

    timer.beginFrame(i);
    queries.beginFrame();
    renderer.beginFrame(camera);
    const auto strategyStart = Clock::now();
    strategy.renderFrame(camera, services, record, isTraced ? &trace : nullptr);
    if (options.slowdown.traversal > 0.0)
      spin(services.timeOfCaller(strategyStart), options.slowdown.traversal);
    storeServiceTimes(services.takeTimes(), computeMs(Clock::now() - strategyStart), record);
    storeResidency(renderer, record);
    timer.endFrame();
    record.set(Counter::kCpuMs, readThreadCpuMs() - cpuStart);
    const bool isLast = i + 1 == static_cast<int>(session.poses.size());
    const bool passes = hooks.turns != nullptr && (hooks.turns->endsWith(i) || isLast);
    pacer.endFrame();
    if (passes) glFinish();  // or the rest of this frame would be drawn in the other one's turn
    storeGpuTime(timer, records, false);

    const auto end = Clock::now();
    record.set(Counter::kFrameMs, computeMs(end - start));
    if (isTraced) hooks.onTrace({session.poses[i], std::move(trace), record});
    trace.clear();
    if (hooks.onFrame) hooks.onFrame(i);
    // what the hooks took is nobody's frame time
    start = hooks.onTrace || hooks.onFrame ? Clock::now() : end;
    if (passes) hooks.turns->pass();
  }
  for (int i = 0; i < 3; ++i) storeGpuTime(timer, records, true);
  return records;
}

}  // namespace hlodbench
