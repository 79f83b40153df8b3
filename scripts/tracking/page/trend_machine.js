// One machine: its plot, its change points, and the night that is shown.

class TrendMachine {
  constructor(section, shared) {
    this.section = section;
    this.data = new TrendData(section.id, shared);
    this.night = this.data.frames - 1;
    this.hovered = null;
    this.plots = null; // while the machine is hidden, or has nothing to plot
    this.hidden = new Set(); // strategies
    for (const [name, step] of [["previous", -1], ["next", 1]])
      part(section, name).addEventListener("click", () => this.step(step));
    const reset = part(section, "reset");
    reset.disabled = this.data.frames < 2;
    reset.addEventListener("click", () => this.plots && this.plots.setRange(null));
  }

  /** Shows or hides the machine, and plots what is chosen. hidden: a Set of strategies. */
  show(isShown, scene, counter, hidden) {
    this.section.hidden = !isShown;
    if (this.plots) this.plots.show([]);
    this.plots = null;
    if (!isShown) return;
    this.data.choose(scene, counter);
    this.hidden = hidden;
    part(this.section, "nothing").hidden = this.data.plotted.length > 0;
    if (this.data.plotted.length) {
      this.plots = new TrendPlots(part(this.section, "plots"), this.data, {
        hover: (night) => {
          this.hovered = night;
          this.fillNight();
        },
        click: (night) => {
          // dygraphs lets the focus be, and in a list the arrow keys would choose from it.
          document.activeElement.blur();
          this.choose(night);
        },
        zoom: () => {},
      });
      this.plots.hidden = hidden;
      this.plots.frame = this.night;
      this.plots.show([this.data.counter]);
    }
    this.fillChanges();
    this.fillNight();
  }

  choose(night) {
    this.night = night;
    if (this.plots) this.plots.mark(night);
    this.fillNight();
  }

  /** ← and →. */
  step(direction) {
    if (!this.data.frames) return;
    this.hovered = null;
    this.choose(Math.min(this.data.frames - 1, Math.max(0, this.night + direction)));
  }

  strategies() {
    return this.data.plotted.filter((id) => !this.hidden.has(id));
  }

  name(id) {
    return [paintSwatch(make("span", { class: "swatch" }), this.data.strategy(id)), " " + id];
  }

  format(value) {
    return formatValue(value, this.data.counter.digits);
  }

  fillChanges() {
    const changes = this.data.changes(this.strategies());
    part(this.section, "no-changes").hidden = changes.length > 0;
    const table = part(this.section, "changes");
    table.parentElement.hidden = changes.length === 0;
    fillTable(table, ["night", "revision", "strategy", "before", "after", "change", "subject"],
              changes.map(({ strategy, night, before, after }) => {
                const button = make("button", { type: "button" }, this.data.shortName(night)[0]);
                button.addEventListener("click", () => this.choose(night));
                const { revision, subject } = this.data.nights[night];
                const share = before ? 100 * (after / before - 1) : NaN;
                const sign = share > 0 ? "+" : "";
                return [button, revision, make("span", {}, ...this.name(strategy)),
                        this.format(before), this.format(after),
                        Number.isFinite(share) ? `${sign}${share.toPrecision(3)} %` : DASH,
                        subject];
              }));
  }

  /** The night at the pointer, else the one chosen. */
  fillNight() {
    const index = this.hovered === null ? this.night : this.hovered;
    const night = this.data.nights[index];
    if (!night) return;
    part(this.section, "night-title").textContent =
      `Night ${index + 1} of ${this.data.frames}: ${night.time}`;
    const about = [make("code", {}, night.revision), ` ${night.subject}`, make("br"),
                   make("span", { class: night.regression ? "worse" : "" }, night.verdict)];
    for (const [text, url] of night.links) about.push(" · ", make("a", { href: url }, text));
    for (const entry of night.accepted)
      about.push(make("br"), `accepted by ${entry.who}, ${entry.time_utc}: ${entry.why} ` +
                             `(${entry.cells.join(", ")})`);
    part(this.section, "night-about").replaceChildren(...about);
    fillTable(part(this.section, "night"),
              ["strategy", this.data.counter.name, "95 %", "exact", "times", "why"],
              this.strategies().map((id) => {
                const interval = this.data.interval(id, index);
                const [exact, timing, why] = this.data.verdict(id, index);
                return [this.name(id), this.format(this.data.value(null, id, index)),
                        interval ? interval.map((v) => this.format(v)).join(" to ") : DASH,
                        exact || DASH, timing || DASH, why];
              }));
  }

  /** Takes over the colours of the page. */
  recolor() {
    if (!this.plots) return;
    this.plots.redraw();
    this.fillChanges();
    this.fillNight();
  }
}
