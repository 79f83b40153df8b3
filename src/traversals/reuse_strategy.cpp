// A strategy of our own, with no paper of its own. What it takes from others:
// J. P. Charalambos, J. Bittner, M. Wimmer, E. Romero. Optimized HLOD Refinement Driven by Hardware
//   Occlusion Queries. ISVC 2007: VMSSE, and the front of the last frame as the guess for this one.
// O. Mattausch, J. Bittner, M. Wimmer. CHC++: Coherent Hierarchical Culling Revisited. CGF 27(2),
//   2008: visible nodes are not queried in every frame, and queries are issued in batches.
// docs/reuse.md says what each part is for and what was measured.
#include <hlodbench/plugin.h>

#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace hlodbench {
namespace {

using namespace plugin;

constexpr OptionInfo kOptions[] = {
    choiceOption("read", "late,early",
                 "when the last frame's results are read: after all is drawn that was visible in "
                 "it, so that the driver has had the time to answer; or first, for better pictures "
                 "of fast motion at the price of a wait"),
    intOption("interval", 1, 64, 4, "most frames between two queries of a node that is drawn"),
    intOption("probe-interval", 1, 64, 2, "frames between two queries of a node that is refined"),
    numberOption("probe-margin", 1.0, 10.0, 1.5,
                 "a refined node is queried while its estimated VMSSE is below this many tau"),
    numberOption("slack", 1.0, 10.0, 1.15,
                 "a node whose VMSSE is below this many tau is drawn for as long as its children's "
                 "visibility is not known"),
    intOption("memory", 2, 1000, 10, "frames after which a result is forgotten"),
};

// Draws a frame by what queries of earlier frames said, and never waits for one of its own. A node
// is queried the more seldom the longer its decision is sure to stay the same.
class ReuseStrategy final : public Strategy {
 public:
  explicit ReuseStrategy(const OptionValues& values)
      : readsEarly_(values.choice("read") == "early"),
        interval_(static_cast<int>(values.integer("interval"))),
        probeInterval_(static_cast<int>(values.integer("probe-interval"))),
        probeMargin_(values.number("probe-margin")),
        slack_(values.number("slack")),
        memoryFrames_(static_cast<int>(values.integer("memory"))) {}

  void renderFrame(const FrameView& view, Frame& frame) override {
    view_ = &view;
    nodes_.resize(view.nodeCount());
    areResultsRead_ = readsEarly_;
    if (readsEarly_) readResults(frame);
    push(kRoot);
    traverse(frame);
    render(frame);
    if (!readsEarly_) {
      readResults(frame);
      areResultsRead_ = true;
      for (const NodeId node : hidden_) push(node);
      hidden_.clear();
      traverse(frame);
      render(frame);
    }
    askAtEnd(frame);
  }

 private:
  static constexpr int kNever = -1'000'000;

  struct Memory {
    double mu = 1.0;         // relative visibility, measured or taken from the parent
    double drift = 0.05;     // how much mu changes in a frame: the recent most, decaying
    int measured = kNever;   // frame of the query that mu comes from
    int asked = kNever;      // frame of the last query
    int visited = kNever;    // frame in which the node was last inside the frustum
    bool refined = false;    // in frame `visited`
    bool isPending = false;  // a query was issued and its result has not been read
  };

  // Node to draw, and whether to query it before.
  struct Step {
    NodeId node;
    bool draws, asks;
  };

  [[nodiscard]] int now() const { return view_->frame(); }
  // That a node is hidden holds for as long as it is asked in every frame; the answer to what was
  // asked among the draws of one frame counts from the second after it, and its first question as a
  // hidden node is answered one frame later.
  [[nodiscard]] bool isKnown(const Memory& m) const {
    return now() - m.measured <= (m.mu > 0.0 ? memoryFrames_ : kHiddenFrames);
  }
  void push(NodeId node) { queue_.emplace(view_->computeDistance(node), node); }
  void pushChildren(const Node& node) {
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c) push(c);
  }

  void traverse(Frame& frame) {
    while (!queue_.empty()) {
      const NodeId node = queue_.top().second;
      queue_.pop();
      if (view_->isInsideFrustum(node)) visit(frame, node);
    }
  }

  // Those of the last frame's queries.
  void readResults(Frame& frame) {
    for (const NodeId node : asked_) {
      Memory& m = nodes_[node];
      frame.getResult(node);
      const double mu = view_->state(node).mu;
      const int frames = m.asked - m.measured;
      m.drift = frames <= memoryFrames_
                    ? std::max(std::abs(mu - m.mu) / frames, kDriftKept * m.drift)
                    : kFirstDrift;
      m.mu = mu;
      m.measured = m.asked;
      m.isPending = false;
    }
    asked_.clear();
  }

  void visit(Frame& frame, NodeId id) {
    const Node& node = view_->node(id);
    Memory& m = nodes_[id];
    const bool known = isKnown(m);
    if (!areResultsRead_ && known && m.mu <= 0.0) {
      hidden_.push_back(id);  // what comes into sight is drawn in this frame, once it is known
      return;
    }
    frame.noteVisit(id);
    const bool wasRefined = m.refined && m.visited == now() - 1;
    m.visited = now();
    if (view_->isCutByNearPlane(id)) {
      m.mu = 1.0;  // no query can tell
      m.measured = now();
      decide(node, id, node.isLeaf() || view_->computeSse(id) <= view_->tau(), false);
      return;
    }
    if (known && m.mu <= 0.0) {
      m.refined = false;
      noteForEnd(id);  // hidden: in every frame, since what it hides may come out in any
      return;
    }
    if (!known && node.parent != kNoNode) m.mu = std::max(kLeastMu, nodes_[node.parent].mu);
    const double sse = view_->computeSse(id);
    const double vmsse = view_->computeBias(m.mu) * sse;
    bool stops = node.isLeaf() || vmsse <= view_->tau();
    // an old result is not enough to take the children back
    if (stops && wasRefined && !node.isLeaf() && now() - m.measured > probeInterval_ + 2)
      stops = false;
    const int wait = !known       ? 1
                     : wasRefined ? computeProbeWait(node, sse, vmsse)
                                  : computeWait(node, m, sse);
    const bool isDue = now() - m.asked >= wait;
    const bool dependsOnMu = !node.isLeaf() && sse > view_->tau();
    if (!stops && !wasRefined && vmsse <= slack_ * view_->tau() && !areChildrenKnown(node)) {
      for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
        if (!view_->isCutByNearPlane(c)) noteForEnd(c);
      stops = true;
    }
    // whether a leaf is hidden is known best when all is drawn; how much the error of another node
    // matters is told, as in Fig. 2, by what lies before it
    if (isDue && !dependsOnMu) noteForEnd(id);
    decide(node, id, stops, isDue && dependsOnMu);
  }

  void decide(const Node& node, NodeId id, bool stops, bool asks) {
    nodes_[id].refined = !stops;
    if (asks && beginAsking(id))
      steps_.push_back({id, stops, true});
    else if (stops)
      steps_.push_back({id, true, false});
    if (!stops) pushChildren(node);
  }

  // Frames to wait after the last query of a node that is drawn: for as long as mu, drifting as it
  // did, cannot lead to another decision, nor to a hidden node.
  [[nodiscard]] int computeWait(const Node& node, const Memory& m, double sse) const {
    for (int wait = interval_; wait > 1; --wait) {
      const double reach = kSafety * wait * (m.drift + kLeastDrift);
      if (m.mu <= reach) continue;
      if (node.isLeaf() || sse <= view_->tau()) return wait;
      const bool stopsBelow = view_->computeBias(m.mu - reach) * sse <= view_->tau();
      const bool stopsAbove = view_->computeBias(m.mu + reach) * sse <= view_->tau();
      if (stopsBelow == stopsAbove) return wait;
    }
    return 1;
  }

  // The same for a node that is refined: it is queried only where it might stop, by its own last
  // result or by the average bias of its children (paper, Fig. 3).
  [[nodiscard]] int computeProbeWait(const Node& node, double sse, double vmsse) const {
    double sum = 0.0;
    int count = 0;
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c) {
      if (nodes_[c].visited < now() - 1) continue;
      sum += view_->computeBias(nodes_[c].mu);
      ++count;
    }
    const double limit = probeMargin_ * view_->tau();
    const bool mayStop = vmsse <= limit || (count > 0 && sum / count * sse <= limit) || count == 0;
    return mayStop ? probeInterval_ : -kNever;
  }

  [[nodiscard]] bool areChildrenKnown(const Node& node) const {
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
      if (!isKnown(nodes_[c])) return false;
    return true;
  }

  // A node has one query at a time.
  bool beginAsking(NodeId id) {
    Memory& m = nodes_[id];
    if (m.isPending) return false;
    m.isPending = true;
    m.asked = now();
    return true;
  }
  void noteForEnd(NodeId id) {
    if (beginAsking(id)) atEnd_.push_back(id);
  }

  // Queries and draws what was decided, the nearest first.
  void render(Frame& frame) {
    for (const Step& step : steps_) {
      if (step.asks) {
        frame.issueQuery(step.node);
        inOrder_.push_back(step.node);
      }
      if (step.draws) frame.draw(step.node);
    }
    steps_.clear();
  }

  // Queries what is to be asked when all is drawn; the next frame reads these and the others.
  void askAtEnd(Frame& frame) {
    for (const NodeId node : atEnd_) frame.issueQuery(node);
    asked_.insert(asked_.end(), inOrder_.begin(), inOrder_.end());
    asked_.insert(asked_.end(), atEnd_.begin(), atEnd_.end());
    inOrder_.clear();
    atEnd_.clear();
  }

  static constexpr int kHiddenFrames = 3;
  static constexpr double kLeastMu = 0.01;     // of a node not known to be hidden
  static constexpr double kFirstDrift = 0.05;  // a frame, of a node seen for the first time
  static constexpr double kLeastDrift = 0.01;  // what is never ruled out
  static constexpr double kDriftKept = 0.7;    // a result
  static constexpr double kSafety = 2.0;

  bool readsEarly_;
  int interval_, probeInterval_;
  double probeMargin_, slack_;
  int memoryFrames_;
  const FrameView* view_ = nullptr;
  std::vector<Memory> nodes_;
  std::priority_queue<std::pair<double, NodeId>, std::vector<std::pair<double, NodeId>>,
                      std::greater<>>
      queue_;
  std::vector<NodeId> asked_;    // queries of the last frame
  std::vector<NodeId> inOrder_;  // queries of this frame, among what is drawn
  std::vector<NodeId> hidden_;   // of this frame: hidden by what was known at its start
  bool areResultsRead_ = false;  // those of the last frame
  std::vector<Step> steps_;      // of this frame, in order
  std::vector<NodeId> atEnd_;    // of this frame: queries after all is drawn
};

}  // namespace
}  // namespace hlodbench

HLODBENCH_PLUGIN(reuse_b,
                 hlodbench::plugin::describe<hlodbench::ReuseStrategy>(
                     "reuse-b", "Reuse(B)", "results of earlier frames, no wait; VMSSE; ours",
                     hlodbench::kOptions));
