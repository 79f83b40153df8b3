// The nights of one machine, as plots want them: what they call a frame is a night here.

class TrendData {
  constructor(id, shared) {
    Object.assign(this, readJson(`${id}-data`)); // key, nights, series
    this.shared = shared;
    this.frames = this.nights.length;
    this.lines = {}; // of what is chosen, by strategy
    this.plotted = [];
  }

  /** Chooses what is plotted. */
  choose(scene, counter) {
    this.scene = scene;
    this.counter = this.shared.counters.find((entry) => entry.key === counter);
    const found = (this.series[scene] || {})[counter] || {};
    this.lines = Object.create(null); // whatever strategies are called
    for (const [strategy, line] of Object.entries(found)) this.lines[strategy] = this.unfold(line);
    this.plotted = this.shared.strategies.map((s) => s.id).filter((s) => s in this.lines);
  }

  /** Exact values come as runs of equal ones. */
  unfold(line) {
    if (!line.runs) return line;
    const values = line.runs.flatMap(([value, count]) => Array(count).fill(value));
    return { values, changes: line.changes };
  }

  strategy(id) {
    return this.shared.strategies.find((strategy) => strategy.id === id);
  }

  label(id) {
    return id;
  }

  hasBands() {
    return this.plotted.some((id) => this.lines[id].low);
  }

  /** A night's value; null for none. */
  value(counter, id, night) {
    return this.lines[id].values[night];
  }

  /** A night's interval, [low, high]; null for none. */
  interval(id, night) {
    const { low, high } = this.lines[id];
    return low && low[night] !== null ? [low[night], high[night]] : null;
  }

  /** [exact verdict, timing verdict, why] of a night; texts. */
  verdict(id, night) {
    return this.nights[night].cells[`${this.scene}/${id}`] || ["", "", ""];
  }

  /** Whether a night's verdict on what is plotted is a change. */
  isChanged(id, night) {
    const [exact, timing] = this.verdict(id, night);
    return this.counter.exact ? exact === "DIFFERENT" : timing === "SLOW" || timing === "FAST";
  }

  /** [{strategy, night, before, after}] of the strategies, in the order of nights. */
  changes(strategies) {
    const found = strategies.flatMap((strategy) => this.lines[strategy].changes.map(
      ([night, before, after]) => ({ strategy, night, before, after })));
    return found.sort((a, b) => a.night - b.night);
  }

  /** A night's date and revision, short. */
  shortName(night) {
    const { time, revision } = this.nights[night];
    return [time.slice(0, 10), revision.slice(0, 7)];
  }
}
