// The pictures and all the numbers of one frame.

/** Rows of the table that come with pictures: heading, and the text of one strategy's entry. */
const PICTURE_ROWS = [
  ...["vs_reference", "vs_full"].flatMap((against) => ["y", "cb", "cr"].map((plane) => [
    (data) => `PSNR ${plane[0].toUpperCase()}${plane.slice(1)} against ` +
      `${data.label(against === "vs_full" ? "full" : data.pictures.reference)} (dB)`,
    (values) => formatPsnr(values[against], plane)])),
  [() => "wrong pixels", (values) => formatValue(values.wrong_pixels, 0)],
  [() => "crack pixels", (values) => formatValue(values.crack_pixels, 0)],
  [() => "RARN in the picture's frame", (values) => formatValue(values.rarn_nodes, 0)],
];

/** What the colours of an overlay say. */
const OVERLAYS = {
  bias: "how much refinement is modulated: blue weak, magenta moderate, red strong",
  level: "a colour for each level of the nodes drawn",
  node: "a colour for each node drawn",
  rarn: "red: nodes rendered and then refined; orange: what was drawn over them",
};

/** Planes that are equal have no finite PSNR: images.json has null for them. */
function formatPsnr(planes, plane) {
  const value = planes ? planes[plane] : undefined;
  if (value === null) return "identical";
  return Number.isFinite(value) ? value.toFixed(2) : DASH;
}

class Viewer {
  /** onFrame(frame) is called when the viewer's own controls choose another frame. */
  constructor(root, data, onFrame) {
    this.root = root;
    this.data = data;
    this.frame = null;
    if (!data.pictures) return;
    this.comparison = new Comparison(part(root, "compare"));
    this.fillControls();
    part(root, "frame").addEventListener("change", (event) => onFrame(Number(event.target.value)));
    part(root, "previous").addEventListener("click", () => onFrame(this.neighbour(-1)));
    part(root, "next").addEventListener("click", () => onFrame(this.neighbour(1)));
    for (const name of ["strategy", "reference", "overlay"])
      part(root, name).addEventListener("change", () => this.update());
  }

  fillControls() {
    const { pictures, strategies } = this.data;
    const has = (id) => pictures.frames.some((entry) => id in entry.values || id in entry.shown);
    const shown = strategies.filter((strategy) => has(strategy.id));
    fillSelect(part(this.root, "frame"), this.data.pictureFrames().map((f) => [f, f]));
    fillSelect(part(this.root, "strategy"), shown.map((s) => [s.id, s.label]));
    // The paper's method first, else the last: the first is the reference.
    const first = shown.find((s) => s.id === "coh-b") || shown[shown.length - 1];
    if (first) part(this.root, "strategy").value = first.id;
    const references = pictures.reference ? [pictures.reference, "full"] : ["full"];
    fillSelect(part(this.root, "reference"), references.map((id) => [id, this.data.label(id)]));
    fillSelect(part(this.root, "overlay"), pictures.overlays.map((name) => [name, name]));
    part(this.root, "overlay-label").hidden = pictures.overlays.length === 0;
  }

  /** The frame with pictures before (-1) or after (1) this one; the same at the ends. */
  neighbour(step) {
    const frames = this.data.pictureFrames();
    const index = frames.indexOf(this.frame) + step;
    return frames[Math.min(frames.length - 1, Math.max(0, index))];
  }

  /** Shows a frame, with pictures if the run has any, and a note to it. */
  show(frame, note = "") {
    this.frame = frame;
    part(this.root, "frame-title").textContent = `Frame ${frame}`;
    part(this.root, "frame-note").textContent = note;
    if (this.data.pictures) {
      const frames = this.data.pictureFrames();
      part(this.root, "frame").value = String(frame);
      part(this.root, "previous").disabled = frame === frames[0];
      part(this.root, "next").disabled = frame === frames[frames.length - 1];
      this.update();
    }
    this.fillValues();
  }

  update() {
    const entry = this.data.pictureEntry(this.frame);
    const strategy = part(this.root, "strategy").value;
    const reference = part(this.root, "reference").value;
    const text = (id) => `Frame ${this.frame} as ${this.data.label(id)} shows it`;
    const left = this.data.uri(entry.shown[reference]);
    const right = strategy === reference ? null : this.data.uri(entry.shown[strategy]);
    this.comparison.show(left, text(reference), right, text(strategy));
    part(this.root, "compare-caption").textContent =
      this.describePair(strategy, reference, left, right);
    const compared = (entry.against[reference] || {})[strategy];
    this.showDifference(compared, strategy, reference);
    this.showWorst(compared, strategy, reference);
    this.showOverlay(entry, strategy);
  }

  describePair(strategy, reference, left, right) {
    const [one, other] = [this.data.label(reference), this.data.label(strategy)];
    if (strategy === reference) return `${one} is what the others are compared with.`;
    if (left && right) return `Left of the edge: ${one}; right: ${other}.`;
    const missing = [left ? null : one, right ? null : other].filter(Boolean).join(" and of ");
    return `There is no usable picture of ${missing} in this frame.`;
  }

  showDifference(compared, strategy, reference) {
    const { width, height, amplify } = this.data.pictures;
    const pair = `${this.data.label(strategy)} and ${this.data.label(reference)}`;
    const caption = part(this.root, "difference-caption");
    setPicture(part(this.root, "difference-picture"),
               this.data.uri(compared && compared.difference),
               `Difference of ${pair} in frame ${this.frame}, amplified ${amplify} times`);
    placeRegion(part(this.root, "difference-region"), compared && compared.region, width, height);
    placeRegion(part(this.root, "region"), compared && compared.region, width, height);
    part(this.root, "difference").hidden = compared === undefined;
    caption.textContent = compared
      ? `Difference of ${pair}, ×${amplify}: black is equal. The rectangle is the worst region.`
      : `${pair}: the two pictures are identical.`;
  }

  showWorst(compared, strategy, reference) {
    part(this.root, "worst").hidden = !compared;
    if (!compared) return;
    const [left, top, width, height] = compared.region;
    const { amplify } = this.data.pictures;
    const names = [this.data.label(reference), this.data.label(strategy), `difference ×${amplify}`];
    part(this.root, "crops").replaceChildren(...names.map((name, i) => {
      const alternative = `${name}, the worst region, magnified`;
      const picture = make("img", { src: this.data.uri(compared.crops[i]), alt: alternative });
      return make("div", {}, picture,
                  make("span", {}, name));
    }));
    part(this.root, "worst-caption").textContent =
      `Worst region, ${width}×${height} pixels at (${left}, ${top}), magnified, exact pixels: ` +
      `mean squared difference of luminance ${formatValue(compared.error, 2)}.`;
  }

  showOverlay(entry, strategy) {
    const name = part(this.root, "overlay").value;
    const uri = this.data.uri((entry.overlays[strategy] || {})[name]);
    const label = this.data.label(strategy);
    part(this.root, "overlay-figure").hidden = !uri;
    setPicture(part(this.root, "overlay-picture"), uri,
               `Overlay ${name} of ${label} in frame ${this.frame}`);
    const meaning = Object.hasOwn(OVERLAYS, name) ? `: ${OVERLAYS[name]}` : "";
    part(this.root, "overlay-caption").textContent = `Overlay “${name}” of ${label}${meaning}.`;
  }

  /** All counters of the frame, and what images.json says of its pictures. */
  fillValues() {
    const { data, frame } = this;
    const columns = data.strategies.map((strategy) => strategy.id);
    const rows = data.counters.map((counter) => [
      counter.unit === "ms" ? `${counter.name} (ms)` : counter.name,
      ...columns.map((id) => data.plotted.includes(id)
        ? formatValue(data.value(counter.key, id, frame), counter.digits) : DASH)]);
    const values = data.pictures ? data.pictureEntry(frame).values : {};
    if (data.pictures)
      for (const [heading, format] of PICTURE_ROWS) {
        const texts = columns.map((id) => (id in values ? format(values[id]) : DASH));
        if (texts.some((text) => text !== DASH)) rows.push([heading(data), ...texts]);
      }
    fillTable(part(this.root, "values"), [`frame ${frame}`, ...columns.map((id) => data.label(id))],
              rows);
  }
}
