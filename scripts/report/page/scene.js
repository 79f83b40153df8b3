// One scene: its controls, its plots and its viewer.

class Scene {
  constructor(section) {
    this.section = section;
    this.data = new SceneData(section.dataset.scene);
    this.hovered = null;
    this.viewer = new Viewer(part(section, "viewer"), this.data, (frame) => this.show(frame));
    if (part(section, "plots")) this.setUpPlots();
    this.show(this.data.pictureFrames()[0] || 0);
  }

  setUpPlots() {
    this.plots = new PlotGroup(part(this.section, "plots"), this.data, {
      hover: (frame) => {
        this.hovered = frame;
        this.fillReadout();
      },
      click: (frame) => this.choose(frame),
      zoom: (first, last) => this.fillRange(first, last),
    });
    for (const box of this.inputs("counter"))
      box.addEventListener("change", () => this.showCounters());
    for (const box of this.inputs("strategy"))
      box.addEventListener("change", () => this.plots.setVisible(box.value, box.checked));
    for (const name of ["from", "to"])
      this.inputs(name)[0].addEventListener("change", () => this.readRange());
    part(this.section, "reset").addEventListener("click", () => this.plots.setRange(null));
    this.fillRange(0, this.data.frames - 1);
    this.showCounters();
  }

  inputs(name) {
    return [...this.section.querySelectorAll(`input[name="${name}"]`)];
  }

  counters() {
    const chosen = this.inputs("counter").filter((box) => box.checked).map((box) => box.value);
    return this.data.counters.filter((counter) => chosen.includes(counter.key));
  }

  showCounters() {
    this.plots.show(this.counters());
    this.fillReadout();
  }

  fillRange(first, last) {
    this.inputs("from")[0].value = first;
    this.inputs("to")[0].value = last;
  }

  /** Zooms to the frames typed in; nonsense is put right rather than refused. */
  readRange() {
    const last = this.data.frames - 1;
    const [from, to] = ["from", "to"].map((name, i) => {
      const typed = this.inputs(name)[0].valueAsNumber;
      return Number.isFinite(typed) ? Math.min(last, Math.max(0, Math.round(typed))) : [0, last][i];
    });
    if (from < to && (from > 0 || to < last)) this.plots.setRange([from, to]);
    else this.plots.setRange(null);
  }

  /** A frame was clicked: shows it, or the nearest one with pictures. */
  choose(frame) {
    if (!this.data.pictures) return this.show(frame);
    const nearest = this.data.nearestPictureFrame(frame);
    return this.show(nearest, nearest === frame ? "" :
      `Frame ${frame} has no pictures; this is the nearest frame that has some.`);
  }

  show(frame, note = "") {
    this.viewer.show(frame, note);
    if (!this.plots) return;
    this.plots.mark(frame);
    this.fillReadout();
  }

  /** ← and →: the frame with pictures before or after. */
  step(direction) {
    if (this.data.pictures) this.show(this.viewer.neighbour(direction));
  }

  /** The values at the pointer, else at the frame shown. */
  fillReadout() {
    const frame = this.hovered === null ? this.viewer.frame : this.hovered;
    if (frame === null) return;
    const counters = this.counters();
    const header = [`frame ${frame}`, ...counters.map((c) => c.name)];
    fillTable(part(this.section, "readout"), header, this.data.plotted.map((id) => [
      [paintSwatch(make("span", { class: "swatch" }), this.data.strategy(id)),
       " " + this.data.label(id)],
      ...counters.map((c) => formatValue(this.data.value(c.key, id, frame), c.digits))]));
  }

  /** Takes over the colours of the page. */
  recolor() {
    for (const swatch of this.section.querySelectorAll("[data-swatch]"))
      paintSwatch(swatch, this.data.strategy(swatch.dataset.swatch));
    if (!this.plots) return;
    this.plots.redraw();
    this.fillReadout();
  }
}
