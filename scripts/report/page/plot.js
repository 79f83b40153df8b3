// Counters over the frames, one plot each, that zoom and show the same frame together.

const PLOT_COLORS = {
  light: { grid: "#d9dee4", axis: "#8a939d", mark: "#c2185b", pictures: "#57606a" },
  dark: { grid: "#30363d", axis: "#6e7781", mark: "#ff7eb6", pictures: "#a2abb5" },
};

/** By mouse as dygraphs does it; a finger scrolls the page, and a tap is a click. */
function makeInteraction() {
  const model = Object.assign({}, Dygraph.defaultInteractionModel);
  for (const event of ["touchstart", "touchmove", "touchend"]) delete model[event];
  return model;
}

/** A tick of the values' axis, in short: 250k, 1.5M, 0.5. */
function formatTick(value) {
  const [factor, unit] = value >= 1e6 ? [1e6, "M"] : value >= 1e4 ? [1e3, "k"] : [1, ""];
  return String(Number((value / factor).toPrecision(6))) + unit;
}

class PlotGroup {
  /** events: hover(frame or null), click(frame), zoom(first, last). */
  constructor(container, data, events) {
    this.container = container;
    this.data = data;
    this.events = events;
    this.axis = "frame";
    this.hidden = new Set();
    this.frame = null;
    this.range = null; // [first, last], or null for all frames
    this.plots = [];
    this.isLinking = false;
  }

  /** Shows a plot for each counter (a list of their descriptions). */
  show(counters) {
    for (const plot of this.plots) plot.destroy();
    this.container.replaceChildren();
    this.plots = counters.map((counter) => this.makePlot(counter));
  }

  makePlot(counter) {
    const unit = counter.unit ? ` (${counter.unit})` : "";
    const names = this.data.plotted.map((id) => this.data.label(id)).join(", ");
    const box = make("div", {
      class: "plot", role: "img", "data-counter": counter.key,
      "aria-label": `${counter.name}${unit} by ${this.axis}, of ${names}; the table below has the values`,
    });
    const title = make("p", { class: "plot-title" }, counter.name + unit);
    this.container.append(title, box);
    const plot = new Dygraph(box, this.makeRows(counter), this.makeOptions(() => plot));
    return plot;
  }

  makeRows(counter) {
    return Array.from({ length: this.data.frames }, (_, frame) => [
      frame, ...this.data.plotted.map((id) => this.data.value(counter.key, id, frame))]);
  }

  makeOptions(self) {
    return {
      // dygraphs puts labels into the page as markup: these are not those of the files.
      labels: ["frame", ...this.data.plotted.map((_, i) => `s${i}`)],
      legend: "never",
      includeZero: true,
      drawPoints: this.data.frames === 1,
      pointSize: 3,
      xRangePad: 6,
      highlightCircleSize: 4,
      interactionModel: makeInteraction(),
      dateWindow: this.range,
      axes: {
        x: { drawGrid: false, pixelsPerLabel: 55 },
        y: { pixelsPerLabel: 32, axisLabelFormatter: formatTick },
      },
      visibility: this.data.plotted.map((id) => !this.hidden.has(id)),
      ...this.makeColors(),
      underlayCallback: (context, area, plot) => this.drawMarks(context, area, plot),
      highlightCallback: (event, frame) => this.hover(self(), frame),
      unhighlightCallback: () => this.hover(self(), null),
      clickCallback: (event, frame) => {
        if (Number.isFinite(frame)) this.events.click(frame);
      },
      zoomCallback: (first, last) => this.link(self(), first, last),
    };
  }

  makeColors() {
    const dark = isDark();
    const colors = dark ? PLOT_COLORS.dark : PLOT_COLORS.light;
    const series = {};
    this.data.plotted.forEach((id, i) => {
      const style = this.data.strategy(id);
      series[`s${i}`] = {
        color: dark ? style.darkColor : style.color,
        strokePattern: style.dash.length ? style.dash : null,
        strokeWidth: style.width,
      };
    });
    return { series, gridLineColor: colors.grid, axisLineColor: colors.axis };
  }

  /** A triangle at each frame with pictures and a line at the frame that is shown. */
  drawMarks(context, area, plot) {
    const colors = isDark() ? PLOT_COLORS.dark : PLOT_COLORS.light;
    const bottom = area.y + area.h;
    const isInside = (x) => x >= area.x - 1 && x <= area.x + area.w + 1;
    context.save();
    if (this.frame !== null) {
      const x = plot.toDomXCoord(this.frame);
      context.strokeStyle = colors.mark;
      context.lineWidth = 1.5;
      if (isInside(x)) {
        context.beginPath();
        context.moveTo(x, area.y);
        context.lineTo(x, bottom);
        context.stroke();
      }
    }
    for (const frame of this.data.pictureFrames()) {
      const x = plot.toDomXCoord(frame);
      if (!isInside(x)) continue;
      context.fillStyle = frame === this.frame ? colors.mark : colors.pictures;
      context.beginPath();
      context.moveTo(x, bottom - 9);
      context.lineTo(x - 5, bottom);
      context.lineTo(x + 5, bottom);
      context.fill();
    }
    context.restore();
  }

  hover(source, frame) {
    for (const plot of this.plots) {
      if (plot === source) continue;
      if (frame === null) plot.clearSelection();
      else plot.setSelection(plot.getRowForX(frame));
    }
    this.events.hover(frame);
  }

  /** Carries a zoom of one plot over to the others. */
  link(source, first, last) {
    if (this.isLinking) return;
    const isAll = first <= 0 && last >= this.data.frames - 1;
    this.setRange(isAll ? null : [first, last], source);
  }

  /** Shows these frames, or all for null. A drag also zooms the source's values: those stay. */
  setRange(range, source = null) {
    this.range = range;
    this.isLinking = true;
    for (const plot of this.plots) {
      if (plot === source) continue;
      if (range) plot.updateOptions({ dateWindow: range });
      else plot.resetZoom();
    }
    this.isLinking = false;
    const last = this.data.frames - 1;
    const [from, to] = range || [0, last];
    this.events.zoom(Math.max(0, Math.ceil(from)), Math.min(last, Math.floor(to)));
  }

  setVisible(strategy, isVisible) {
    if (isVisible) this.hidden.delete(strategy);
    else this.hidden.add(strategy);
    const index = this.data.plotted.indexOf(strategy);
    if (index < 0) return;
    for (const plot of this.plots) plot.setVisibility(index, isVisible);
  }

  /** Scales what is drawn to a width in pixels, or back with null. Plots of another size would have
      to be drawn anew, which comes too late for the printer. */
  scaleTo(width) {
    for (const box of this.container.querySelectorAll(".plot")) {
      const drawn = box.offsetWidth;
      box.style.width = width ? `${drawn}px` : "";
      box.style.zoom = width ? String(width / drawn) : "";
    }
  }

  /** Marks the frame that the viewer shows. */
  mark(frame) {
    this.frame = frame;
    this.redraw();
  }

  redraw() {
    const colors = this.makeColors();
    for (const plot of this.plots) plot.updateOptions(colors);
  }
}
