// Heat-maps of a sweep: two of its parameters across and down, one map for each strategy and each
// combination of the others.

// Of viridis (matplotlib), which the colour-blind can read and a print in grey keeps in order.
const HEAT = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
              [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]];
const CELL_HEIGHT = 26;
const CHARACTER = 7.3; // pixels that one takes at most, on average
const MOST_MAPS = 24; // a strategy

/** The colour of a share of the scale, 0 to 1, as [r, g, b]. */
function heatColor(share) {
  const place = Math.min(Math.max(share, 0), 1) * (HEAT.length - 1);
  const low = Math.min(Math.floor(place), HEAT.length - 2);
  return HEAT[low].map((v, i) => Math.round(v + (HEAT[low + 1][i] - v) * (place - low)));
}

function css(color) {
  return `rgb(${color.join(", ")})`;
}

/** An SVG element with attributes and children. */
function makeSvg(tag, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

class Sweep {
  constructor(section) {
    this.section = section;
    this.data = readJson(`${section.id}-data`);
    this.choices = ["counter", "across", "down"].map((name) => part(section, name));
    for (const element of section.querySelectorAll("select, input"))
      element.addEventListener("change", () => this.draw());
    this.draw();
  }

  draw() {
    const [counter, across, down] = this.choices.map((select) => Number(select.value));
    const shown = [...this.section.querySelectorAll("input:checked")].map((box) => box.value);
    const rows = this.data.rows.filter((row) => shown.includes(row.strategy));
    const values = rows.map((row) => row.values[counter]).filter((value) => value !== null);
    const range = [Math.min(...values), Math.max(...values)];
    this.drawScale(this.data.counters[counter], values.length ? range : null);
    part(this.section, "maps").replaceChildren(
      ...this.data.strategies.filter((strategy) => shown.includes(strategy.id)).map((strategy) =>
        this.makeRow(strategy, rows.filter((row) => row.strategy === strategy.id), counter, across,
                     down, range)));
  }

  drawScale(counter, range) {
    const stops = HEAT.map(css).join(", ");
    const bar = make("span", { class: "heat-scale", "aria-hidden": "true" });
    bar.style.background = `linear-gradient(to right, ${stops})`;
    const unit = counter.unit ? `, ${counter.unit}` : "";
    const ends = range ? range.map((value) => formatValue(value, counter.digits)) : [DASH, DASH];
    part(this.section, "scale").replaceChildren(
      make("strong", {}, counter.name + unit), ends[0], bar, ends[1]);
  }

  /** All maps of one strategy. */
  makeRow(strategy, rows, counter, across, down, range) {
    const others = this.data.parameters.map((_, i) => i).filter((i) => i !== across && i !== down);
    const groups = new Map();
    const before = (a, b) => others.map((i) => a.places[i] - b.places[i]).find((d) => d !== 0) || 0;
    for (const row of [...rows].sort(before)) {
      const name = others.map((i) => this.describe(i, row.places[i])).join(", ");
      if (!groups.has(name)) groups.set(name, []);
      groups.get(name).push(row);
    }
    const maps = [...groups].slice(0, MOST_MAPS).map(([name, group]) =>
      this.makeMap(strategy, name, group, counter, across, down, range));
    const left = groups.size - maps.length;
    return make("div", {}, make("h3", {}, strategy.label), make("div", { class: "heat-row" }, ...maps),
                ...(left > 0 ? [make("p", { class: "muted" }, `${left} more are not shown.`)] : []));
  }

  describe(parameter, place) {
    return `${this.data.parameters[parameter].name} ${this.data.parameters[parameter].values[place]}`;
  }

  makeMap(strategy, name, rows, counter, across, down, range) {
    const { digits } = this.data.counters[counter];
    const xs = this.data.parameters[across];
    const ys = across === down ? { name: "", values: [""] } : this.data.parameters[down];
    const texts = rows.map((row) => formatValue(row.values[counter], digits));
    const widest = Math.max(...[...texts, ...xs.values].map((text) => text.length));
    const width = Math.max(44, widest * CHARACTER + 10);
    const left = Math.max(...ys.values.map((text) => text.length), ys.name.length) * CHARACTER + 10;
    const height = (ys.values.length + 2) * CELL_HEIGHT;
    const total = Math.max(left + xs.values.length * width, left + xs.name.length * CHARACTER);
    const svg = makeSvg("svg", { width: total, height, role: "img",
                                 "aria-label": `${strategy.label} ${name}` });
    const write = (text, x, y, attributes) => svg.append(
      makeSvg("text", { x, y: y + CELL_HEIGHT / 2 + 4, ...attributes }, text));
    write(xs.name, left, 0, { class: "name" });
    write(ys.name, left - 6, CELL_HEIGHT, { class: "name", "text-anchor": "end" });
    xs.values.forEach((text, i) =>
      write(text, left + (i + 0.5) * width, CELL_HEIGHT, { "text-anchor": "middle" }));
    ys.values.forEach((text, j) =>
      write(text, left - 6, (j + 2) * CELL_HEIGHT, { "text-anchor": "end" }));
    ys.values.forEach((_, j) => xs.values.forEach((__, i) => {
      const found = rows.find((row) => row.places[across] === i &&
                              (across === down || row.places[down] === j));
      const value = found ? found.values[counter] : null;
      const box = { x: left + i * width, y: (j + 2) * CELL_HEIGHT, width: width - 1,
                    height: CELL_HEIGHT - 1 };
      const middle = { "text-anchor": "middle" };
      if (value === null) {
        svg.append(makeSvg("rect", { ...box, class: "absent" }));
        write(DASH, box.x + width / 2, box.y, { ...middle, class: "name" });
        return;
      }
      const [low, high] = range;
      const color = heatColor(high > low ? (value - low) / (high - low) : 0.5);
      const bright = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
      svg.append(makeSvg("rect", { ...box, fill: css(color) }));
      write(formatValue(value, digits), box.x + width / 2, box.y,
            { ...middle, style: `fill: ${bright > 120 ? "#000" : "#fff"}` });
    }));
    return make("figure", { class: "heat-map" }, make("figcaption", {}, name), svg);
  }
}
