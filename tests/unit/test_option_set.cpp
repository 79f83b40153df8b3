// The options of single strategies: what they take, and what is said of what they do not.
#include <gmock/gmock.h>

#include "hlod/core/error.h"
#include "strategy_settings.h"

namespace hlodbench {
namespace {

using plugin::OptionInfo;
using testing::HasSubstr;

constexpr OptionInfo kOptions[] = {
    plugin::intOption("window", 1, 8, 4, "frames"),
    plugin::numberOption("decay", 0, 1, 0.5, "share a frame"),
    plugin::boolOption("eager", false, "whether"),
    plugin::choiceOption("rule", "last,mean,first", "which"),
};

StrategyInfo makeInfo(std::string_view name) {
  return {name, "Mine", "of the test", nullptr, kOptions};
}

std::string refuse(const std::vector<std::string>& settings) {
  const StrategyInfo mine = makeInfo("mine");
  const StrategyInfo plain{"plain", "Plain", "without options", nullptr};
  try {
    const StrategySettings made({&mine, &plain}, settings);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(OptionSet, TellsWhatItWouldTakeToComeToItsValues) {
  OptionSet set(kOptions);
  set.set("mine", "window", "7");
  set.set("mine", "rule", "first");
  EXPECT_THAT(set.texts(),
              testing::ElementsAre("window=7", "decay=0.5", "eager=off", "rule=first"));
  const StrategyInfo mine = makeInfo("mine");
  std::vector<std::string> settings;
  for (const std::string& text : set.texts()) settings.push_back("mine." + text);
  EXPECT_EQ(StrategySettings({&mine}, settings).of("mine").choice("rule"), "first");
}

TEST(StrategySettings, HoldsTheDefaultsUntilSetAndStoresThem) {
  const StrategyInfo mine = makeInfo("mine");
  const StrategyInfo other = makeInfo("other");
  const StrategySettings settings(
      {&mine, &other},
      {"mine.window=7", "mine.decay=0.25", "mine.eager=on", "mine.rule=first", "mine.window=8"});
  const plugin::OptionValues own = settings.of("mine");
  EXPECT_EQ(own.integer("window"), 8);
  EXPECT_EQ(own.number("decay"), 0.25);
  EXPECT_TRUE(own.flag("eager"));
  EXPECT_EQ(own.choice("rule"), "first");
  EXPECT_EQ(settings.of("other").choice("rule"), "last");
  EXPECT_EQ(settings.toJson().dump(),
            R"({"mine":{"decay":0.25,"eager":true,"rule":"first","window":8},)"
            R"("other":{"decay":0.5,"eager":false,"rule":"last","window":4}})");
}

TEST(StrategySettings, SaysInOneLineWhatIsWrong) {
  EXPECT_THAT(refuse({"mine"}), HasSubstr("STRATEGY.OPTION=VALUE"));
  EXPECT_THAT(refuse({"mine.decay"}), HasSubstr("found 'mine.decay'"));
  EXPECT_THAT(refuse({"decay=0.5"}), HasSubstr("STRATEGY.OPTION=VALUE"));
  EXPECT_THAT(refuse({"yours.decay=1"}), HasSubstr("mine, plain, found 'yours'"));
  EXPECT_THAT(refuse({"mine.x=1"}), HasSubstr("one of its options, window, decay, eager, rule"));
  EXPECT_THAT(refuse({"plain.x=1"}), HasSubstr("has none"));
  for (const char* text : {"1.5", "9", "0", "", "four", "nan", "4 ", "1e400"})
    EXPECT_EQ(
        refuse({std::string("mine.window=") + text}),
        std::string("--set mine.window: expected an integer from 1 to 8, found '") + text + "'");
  for (const char* text : {"1.01", "-0.1", "nan", "0,5", "0.5x"})
    EXPECT_THAT(refuse({std::string("mine.decay=") + text}), HasSubstr("a number from 0 to 1"));
  EXPECT_THAT(refuse({"mine.eager=1"}), HasSubstr("expected on or off, found '1'"));
  EXPECT_THAT(refuse({"mine.rule=las"}), HasSubstr("expected one of last, mean, first"));
  EXPECT_EQ(refuse({"mine.window=1", "mine.decay=1", "mine.rule=mean"}), "accepted");
}

TEST(OptionValues, RefusesWhatIsNotDeclared) {
  const OptionSet set(kOptions);
  EXPECT_THROW((void)set.values().number("other"), std::logic_error);
  EXPECT_THROW((void)set.values().number("window"), std::logic_error) << "declared as an integer";
  EXPECT_THROW((void)plugin::OptionValues().flag("eager"), std::logic_error);
}

TEST(OptionInfos, AreCheckedThemselves) {
  const auto wrong = [](OptionInfo info) { return checkOptionInfos({&info, 1}); };
  EXPECT_EQ(checkOptionInfos(kOptions), "");
  EXPECT_THAT(wrong(plugin::boolOption("A b", true, "x")), HasSubstr("'A b'"));
  EXPECT_THAT(wrong(plugin::boolOption(nullptr, true, "x")), HasSubstr("name"));
  EXPECT_THAT(wrong(plugin::boolOption("a", true, "")), HasSubstr("meaning"));
  EXPECT_THAT(wrong(plugin::numberOption("a", 0, 1, 2, "x")), HasSubstr("default within"));
  EXPECT_THAT(wrong(plugin::numberOption("a", 1, 0, 0.5, "x")), HasSubstr("range"));
  EXPECT_THAT(wrong(plugin::numberOption("a", 0, 1e300, 0.5, "x")), HasSubstr("2^53"));
  EXPECT_THAT(wrong(plugin::choiceOption("a", "", "x")), HasSubstr("choices"));
  EXPECT_THAT(wrong(plugin::choiceOption("a", "b,b", "x")), HasSubstr("each once"));
  OptionInfo fraction = plugin::intOption("a", 0, 9, 1, "x");
  fraction.preset = 1.5;
  EXPECT_THAT(wrong(fraction), HasSubstr("integer"));
  OptionInfo unknown = fraction;
  unknown.type = static_cast<plugin::OptionType>(17);
  EXPECT_THAT(wrong(unknown), HasSubstr("type"));
  const OptionInfo twice[] = {kOptions[0], kOptions[0]};
  EXPECT_THAT(checkOptionInfos(twice), HasSubstr("found twice"));
}

TEST(Options, SayTheirRangeAndDefault) {
  EXPECT_EQ(describeOptions(makeInfo("mine")),
            "    --set mine.window=: frames; an integer from 1 to 8, default 4\n"
            "    --set mine.decay=: share a frame; a number from 0 to 1, default 0.5\n"
            "    --set mine.eager=: whether; on or off, default off\n"
            "    --set mine.rule=: which; one of last, mean, first, default last\n");
}

}  // namespace
}  // namespace hlodbench
