"""Small plug-ins, compiled by the tests against the public headers of the source tree."""

import os
import pathlib
import subprocess

HEADERS = pathlib.Path(__file__).resolve().parents[2] / "src/traversals/plugin"

# A predictor like Bool's, which goes wrong in a frame if told so.
FAULTY = r"""
#include <hlodbench/plugin.h>

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace {

using namespace hlodbench::plugin;

constexpr OptionInfo kOptions[] = {
    choiceOption("fault", "none,throw,odd,node,far,loop,crash,exit,make,throwmade,remove",
                 "what goes wrong"),
    intOption("frame", 0, 1000, 3, "in which frame"),
    numberOption("decay", 0, 1, 0.5, "nothing"),
};

class Faulty final : public Predictor {
 public:
  explicit Faulty(const OptionValues& own)
      : fault_(own.choice("fault")), frame_(own.integer("frame")) {
    if (fault_ == "make") std::abort();
    if (fault_ == "throwmade") throw std::runtime_error("cannot be made");
  }
  ~Faulty() override {
    if (fault_ == "remove") std::raise(SIGSEGV);
  }
  Prediction predict(NodeId node, const FrameView& view) override {
    if (view.frame() == frame_) goWrong(view);
    if (!view.wasVisible(node)) return Prediction::kDelay;
    // a leaf that should refine is taken as one that stops
    return view.computeSse(node) <= view.tau() && !view.node(node).isLeaf() ? Prediction::kStop
                                                                            : Prediction::kRefine;
  }

 private:
  void goWrong(const FrameView& view) {
    if (fault_ == "throw") throw std::runtime_error("no idea\nat all");
    if (fault_ == "odd") throw 42;
    if (fault_ == "node") (void)view.state(view.nodeCount());
    if (fault_ == "far") (void)view.computeSse(kNoNode);
    if (fault_ == "loop") for (std::atomic<int> i{0};; ++i) {}
    if (fault_ == "crash") std::raise(SIGSEGV);
    if (fault_ == "exit") std::_Exit(0);
  }

  std::string fault_;
  std::int64_t frame_;
};

}  // namespace

#define DESCRIBE(name) describe<Faulty>(name, "Faulty", "of a test", kOptions, Modulation::kNone)
HLODBENCH_PLUGIN(faulty, DESCRIBE("faulty"), DESCRIBE("faulty-throw"), DESCRIBE("faulty-odd"),
                 DESCRIBE("faulty-node"), DESCRIBE("faulty-far"), DESCRIBE("faulty-throwmade"),
                 DESCRIBE("faulty-loop"), DESCRIBE("faulty-crash"), DESCRIBE("faulty-exit"),
                 DESCRIBE("faulty-make"), DESCRIBE("faulty-remove"));
"""

# A whole strategy: stop-and-wait, as SW(B) but by the means of a plug-in, which goes wrong in a frame
# if told so.
WHOLE = r"""
#include <hlodbench/plugin.h>

#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace {

using namespace hlodbench::plugin;

constexpr OptionInfo kOptions[] = {
    choiceOption("fault", "none,twice,caught,unknown,unqueried,requery,poll,refine",
                 "what goes wrong"),
};

class Whole final : public Strategy {
 public:
  explicit Whole(const OptionValues& own) : fault_(own.choice("fault")) {}

  void renderFrame(const FrameView& view, Frame& frame) override {
    if (view.frame() == 3) goWrong(frame);
    using Entry = std::pair<double, NodeId>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
    open.emplace(0.0, kRoot);
    while (!open.empty()) {
      const NodeId id = open.top().second;
      open.pop();
      frame.noteVisit(id);
      if (!view.isInsideFrustum(id)) continue;
      frame.noteDelay(id);
      const Node& node = view.node(id);
      double bias = 1.0;
      if (!view.isCutByNearPlane(id)) {
        frame.issueQuery(id);
        if (frame.getResult(id) == 0) continue;
        bias = view.state(id).bias;
      }
      const bool stops = node.isLeaf() || bias * view.computeSse(id) <= view.tau();
      // every refined node is drawn first
      if (stops || (fault_ == "refine" && view.frame() == 3)) frame.draw(id);
      if (stops) continue;
      for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child)
        open.emplace(view.computeDistance(child), child);
    }
  }

 private:
  void goWrong(Frame& frame) {
    if (fault_ == "twice") { frame.draw(0); frame.draw(0); }
    if (fault_ == "caught") { try { frame.draw(0); frame.draw(0); } catch (...) {} }
    if (fault_ == "unknown") frame.draw(12345678);
    if (fault_ == "unqueried") (void)frame.getResult(160);
    if (fault_ == "requery") { frame.issueQuery(1); frame.issueQuery(1); }
    if (fault_ == "poll") {
      frame.issueQuery(1);
      while (true) (void)frame.isAvailable(1);
    }
  }

  std::string fault_;
};

}  // namespace

#define DESCRIBE(name) describe<Whole>(name, "Whole", "of a test", kOptions)
HLODBENCH_PLUGIN(whole, DESCRIBE("whole"), DESCRIBE("whole-twice"), DESCRIBE("whole-caught"),
                 DESCRIBE("whole-unknown"), DESCRIBE("whole-unqueried"), DESCRIBE("whole-requery"),
                 DESCRIBE("whole-poll"));
"""

# A description that is changed as the environment says before it is handed out.
CHANGED = r"""
#include <hlodbench/plugin.h>

#include <cstdlib>
#include <string>

using namespace hlodbench::plugin;
struct Mine : Predictor {
  Prediction predict(NodeId, const FrameView&) override { return Prediction::kDelay; }
};
extern "C" const PluginDescriptor* hlodbench_plugin() {
  static StrategyDescriptor strategies[] = {describe<Mine>("mine", "Mine", "of a test"),
                                            describe<Mine>("yours", "Yours", "of a test")};
  static PluginDescriptor descriptor = makePluginDescriptor({strategies, 2});
  const char* const variable = std::getenv("CHANGE");
  const std::string change = variable == nullptr ? "" : variable;
  if (change == "major") descriptor.apiMajor = 2;
  if (change == "minor") descriptor.apiMinor = 1;
  if (change == "library") descriptor.abi = "another library";
  if (change == "name") strategies[0].name = "My own";
  if (change == "taken") strategies[1].name = "coh-b";
  if (change == "label") strategies[1].label = "two\nlines";
  return &descriptor;
}
"""


def compile_plugin(folder, name, source, *options, standard="c++17"):
    """folder/libNAME.so, without a warning."""
    path = folder / f"{name}.cpp"
    path.write_text(source, encoding="utf-8")
    library = folder / f"lib{name}.so"
    command = [os.environ.get("CXX", "c++"), f"-std={standard}", "-Wall", "-Wextra", "-Wshadow",
               "-Wpedantic", "-Werror", "-shared", "-fPIC", "-I", HEADERS, path, "-o", library]
    made = subprocess.run([*map(str, [*command, *options])], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    return library
