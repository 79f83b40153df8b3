// Strategies in the form of a plug-in: what they do, what is checked and counted, which versions
// are taken.
#include <gmock/gmock.h>

#include <optional>

#include "sample_plugin.h"
#include "tiny_tree.h"
#include "traversals/option_set.h"
#include "traversals/plugin_library.h"

namespace hlodbench {
namespace {

using plugin::Frame;
using plugin::FrameView;
using testing::HasSubstr;

const StrategyInfo kSample = describeStrategy(listStrategiesOf_sample().strategies[0]);
const StrategyInfo kScript = describeStrategy(listStrategiesOf_sample().strategies[1]);

// Frames of one strategy, without GL.
class PluginRun final : public FrameServices {
 public:
  explicit PluginRun(const StrategyInfo& info, const TinyTree& tree, plugin::OptionValues own = {})
      : tree_(tree), strategy_(info.make({tree.hierarchy, {}, nullptr, own})) {}

  void renderFrame() {
    record = FrameRecord();
    trace.clear();
    strategy_->renderFrame(camera_, *this, record, &trace);
  }
  void draw(NodeId node) override { drawn.push_back(node); }
  void issueQuery(NodeId) override {}
  bool isAvailable(NodeId) override { return true; }
  std::uint32_t getResult(NodeId node) override { return tree_.countPixels(node, camera_); }

  [[nodiscard]] std::vector<NodeId> listRefined() const {
    std::vector<NodeId> refined;
    for (const TraceEvent& event : trace)
      if (event.type == TraceEvent::Type::kRarn) refined.push_back(event.node);
    return refined;
  }

  FrameRecord record;
  Trace trace;
  std::vector<NodeId> drawn;

 private:
  const TinyTree& tree_;
  Camera camera_ = makeTestCamera();
  std::unique_ptr<Strategy> strategy_;
};

// What the frame of a script is refused for; empty if it is not.
std::string refuse(const std::function<void(Frame&)>& script) {
  const FiveNodes tree;
  PluginRun run(kScript, tree);
  sampleFrame = [](const FrameView&, Frame& frame) {
    frame.draw(0);  // of the frame before: forgotten
    frame.issueQuery(1);
  };
  run.renderFrame();
  sampleFrame = [&](const FrameView&, Frame& frame) { script(frame); };
  try {
    run.renderFrame();
    return "";
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

TEST(PluginPredictor, DoesWhatTheSameOneInTheTreeDoes) {
  const FiveNodes tree;
  ScriptedRun ours(tree, "bool", 0);
  PluginRun run(kSample, tree);
  for (int frame = 0; frame < 3; ++frame) {
    ours.renderFrame();
    run.drawn.clear();
    run.renderFrame();
    EXPECT_EQ(run.drawn, ours.listDrawn());
    for (const Counter counter : {Counter::kDn, Counter::kQueries, Counter::kDelays})
      EXPECT_EQ(run.record.get(counter), ours.record.get(counter));
  }
}

TEST(PluginPredictor, GetsTheValuesOfItsOptions) {
  const FiveNodes tree;
  OptionSet options(kSample.options);
  options.set("sample", "weight", "0.2");
  PluginRun run(kSample, tree, options.values());
  run.renderFrame();
  run.drawn.clear();
  run.renderFrame();
  // 0.2 * 4 is within tolerance: drawn at once, and refined by its result
  EXPECT_THAT(run.drawn, testing::Contains(1));
  EXPECT_EQ(run.record.get(Counter::kRarn), 1.0);
}

TEST(PluginStrategy, IsCountedByTheProgram) {
  FiveNodes tree;
  tree.setMu(2, 0.5);
  PluginRun run(kScript, tree);
  sampleFrame = [&](const FrameView& view, Frame& frame) {
    EXPECT_EQ(view.state(2).lastVisited, -1);
    frame.draw(0);
    frame.draw(3);
    frame.issueQuery(2);
    EXPECT_TRUE(frame.isAvailable(2));
    EXPECT_EQ(frame.getResult(2), tree.countPixels(2, makeTestCamera()));
    EXPECT_NEAR(view.state(2).mu, 0.5, 0.01);
    EXPECT_EQ(view.state(2).bias, view.computeBias(view.state(2).mu));
    EXPECT_TRUE(view.state(2).visible);
    frame.draw(2);
    frame.draw(1);  // after what is below it: no refinement of 1
    EXPECT_EQ(view.state(2).lastRendered, 0);
    EXPECT_FALSE(view.wasVisible(2)) << "not in the frame before";
  };
  run.renderFrame();
  EXPECT_EQ(run.drawn, (std::vector<NodeId>{0, 3, 2, 1}));
  EXPECT_EQ(run.record.get(Counter::kDn), 4.0);
  EXPECT_EQ(run.record.get(Counter::kTriangles), 3.0) << "the root of this tree has none";
  EXPECT_EQ(run.record.get(Counter::kQueries), 1.0);
  EXPECT_EQ(run.record.get(Counter::kRarn), 1.0);
  EXPECT_EQ(run.listRefined(), std::vector<NodeId>{0});
  for (const Counter counter : {Counter::kD, Counter::kDelays, Counter::kNodesVisited})
    EXPECT_FALSE(run.record.has(counter)) << "never noted: absent, not 0";
  sampleFrame = [&](const FrameView& view, Frame& frame) {
    EXPECT_TRUE(view.wasVisible(2));
    frame.noteVisit(1);
    frame.noteDelay(1);
    frame.noteDelay(2);
    frame.draw(1);
  };
  run.renderFrame();
  EXPECT_EQ(run.record.get(Counter::kDelays), 2.0);
  EXPECT_EQ(run.record.get(Counter::kD), 1.0);
  EXPECT_EQ(run.record.get(Counter::kNodesVisited), 1.0);
  sampleFrame = [](const FrameView&, Frame&) {};
  run.renderFrame();
  EXPECT_EQ(run.record.get(Counter::kDelays), 0.0);
  EXPECT_EQ(run.record.get(Counter::kDn), 0.0);
}

TEST(PluginStrategy, CountsADrawnNodeOnceHoweverManyAreDrawnBelowIt) {
  const FiveNodes tree;
  PluginRun run(kScript, tree);
  sampleFrame = [](const FrameView&, Frame& frame) {
    for (const NodeId node : {0u, 1u, 3u, 4u, 2u}) frame.draw(node);
  };
  run.renderFrame();
  EXPECT_THAT(run.listRefined(), testing::UnorderedElementsAre(0, 1));
  EXPECT_EQ(run.record.get(Counter::kRarn), 2.0);
}

TEST(PluginStrategy, IsRefusedWhatItsFrameRulesOut) {
  EXPECT_EQ(refuse([](Frame& f) { f.draw(0), f.issueQuery(1), f.getResult(1); }), "");
  EXPECT_EQ(refuse([](Frame& f) { f.draw(3), f.draw(3); }), "drew node 3 twice");
  EXPECT_EQ(refuse([](Frame& f) { f.issueQuery(2), f.issueQuery(2); }), "queried node 2 twice");
  EXPECT_EQ(refuse([](Frame& f) { f.getResult(2); }),
            "asked for the result of node 2, which was not queried");
  EXPECT_THAT(refuse([](Frame& f) { (void)f.isAvailable(2); }), HasSubstr("not queried"));
  EXPECT_EQ(refuse([](Frame& f) { f.draw(5); }), "asked to draw node 5; the hierarchy has 5 nodes");
  EXPECT_THAT(refuse([](Frame& f) { f.issueQuery(99); }), HasSubstr("query node 99"));
  EXPECT_THAT(refuse([](Frame& f) { f.getResult(99); }), HasSubstr("result of node 99"));
  EXPECT_THAT(refuse([](Frame& f) { f.noteVisit(99); }), HasSubstr("visit node 99"));
  EXPECT_THAT(refuse([](Frame& f) { f.noteDelay(99); }), HasSubstr("delay node 99"));
  const auto caught = [](Frame& f) {
    try {
      f.draw(99);
    } catch (const std::exception&) {
    }
  };
  EXPECT_THAT(refuse(caught), HasSubstr("draw node 99")) << "an exception that it caught";
}

// What is said of a description after a change.
template <typename Change>
std::string check(Change change) {
  plugin::PluginDescriptor descriptor = plugin::makePluginDescriptor(listStrategiesOf_sample());
  change(descriptor);
  return checkPlugin(descriptor);
}

TEST(PluginDescription, IsTakenInItsVersionOnly) {
  using plugin::PluginDescriptor;
  EXPECT_EQ(check([](PluginDescriptor&) {}), "");
  for (const std::uint32_t major : {HLODBENCH_API_MAJOR - 1, HLODBENCH_API_MAJOR + 1})
    EXPECT_THAT(check([&](PluginDescriptor& d) { d.apiMajor = major; }), HasSubstr("version"));
  EXPECT_THAT(check([](PluginDescriptor& d) { d.apiMinor = HLODBENCH_API_MINOR + 1; }),
              HasSubstr("version"));
  EXPECT_THAT(check([](PluginDescriptor& d) { d.magic[7] = 0; }), HasSubstr("another one's"));
  EXPECT_THAT(check([](PluginDescriptor& d) { d.abi = "other"; }), HasSubstr("found other"));
  for (auto member :
       {&PluginDescriptor::nodeBytes, &PluginDescriptor::stateBytes, &PluginDescriptor::optionBytes,
        &PluginDescriptor::strategyBytes, &PluginDescriptor::viewBytes})
    EXPECT_THAT(check([&](PluginDescriptor& d) { ++(d.*member); }), HasSubstr("laid out"));
  EXPECT_EQ(check([](PluginDescriptor& d) { d.viewBytes -= 8; }), "")
      << "a smaller view is one of an earlier minor version";
  // of another version, nothing else is looked at
  EXPECT_THAT(check([](PluginDescriptor& d) {
                d.apiMajor = 0;
                d.abi = nullptr;
                d.list = {nullptr, 1000};
              }),
              HasSubstr("version"));
}

TEST(Registry, DescribesEveryStrategyOfTheTree) {
  for (const StrategyInfo& info : listStrategies()) {
    EXPECT_TRUE(isIdentifier(info.name)) << info.name;
    EXPECT_EQ(checkOptionInfos(info.options), "") << info.name;
    EXPECT_EQ(info.create == nullptr, info.descriptor != nullptr) << info.name;
  }
}

}  // namespace
}  // namespace hlodbench
