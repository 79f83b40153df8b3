// A counter over the nights, with bands for intervals and marks for what changed.

const MANY_NIGHTS = 150; // so many dots hide the line

/** Text that dygraphs puts into the page as markup: what could be any is left out. */
function makePlain(text) {
  return text.replace(/[^\w.:+-]/g, "");
}

class TrendPlots extends PlotGroup {
  constructor(container, data, events) {
    super(container, data, events);
    this.axis = "night";
  }

  makeRows(counter) {
    if (!this.data.hasBands()) return super.makeRows(counter);
    return Array.from({ length: this.data.frames }, (_, night) => [
      night, ...this.data.plotted.map((id) => {
        const interval = this.data.interval(id, night);
        return interval && [interval[0], this.data.value(counter.key, id, night), interval[1]];
      })]);
  }

  makeOptions(self) {
    const options = super.makeOptions(self);
    const label = (night) => this.data.shortName(night).map(makePlain).join("<br>");
    options.axes.x = { drawGrid: false, pixelsPerLabel: 100, axisLabelWidth: 90 };
    // Only whole nights get a tick.
    options.axes.x.ticker = (first, last, pixels) => this.makeTicks(first, last, pixels, label);
    const drawPoint = (plot, name, context, x, y, color, size, night) =>
      this.drawPoint(name, context, x, y, color, size, night);
    return {
      ...options,
      customBars: this.data.hasBands(),
      includeZero: false,
      yRangePad: 14,
      xRangePad: 12,
      xAxisHeight: 38,
      drawPoints: true,
      pointSize: this.data.frames === 1 ? 4 : this.data.frames > MANY_NIGHTS ? 1.2 : 2,
      dateWindow: this.range || (this.data.frames === 1 ? [-1, 1] : null),
      drawPointCallback: drawPoint,
    };
  }

  makeTicks(first, last, pixels, label) {
    const from = Math.max(0, Math.ceil(first));
    const to = Math.min(this.data.frames - 1, Math.floor(last));
    const step = Math.max(1, Math.ceil((to - from + 1) * 100 / Math.max(pixels, 100)));
    const ticks = [];
    for (let night = from; night <= to; night += step)
      ticks.push({ v: night, label: label(night) });
    return ticks;
  }

  /** A dot, with a ring around it where the night's verdict is a change. */
  drawPoint(name, context, x, y, color, size, night) {
    context.fillStyle = color;
    context.beginPath();
    context.arc(x, y, size, 0, 2 * Math.PI);
    context.fill();
    if (!this.data.isChanged(this.data.plotted[Number(name.slice(1))], night)) return;
    context.strokeStyle = (isDark() ? PLOT_COLORS.dark : PLOT_COLORS.light).mark;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, size + 3, 0, 2 * Math.PI);
    context.stroke();
  }

  shown() {
    return this.data.plotted.filter((id) => !this.hidden.has(id));
  }

  /** A dashed line with ▼ at each change point, ▲ at acceptances, a line at the night shown. */
  drawMarks(context, area, plot) {
    const colors = isDark() ? PLOT_COLORS.dark : PLOT_COLORS.light;
    const bottom = area.y + area.h;
    context.save();
    context.beginPath();
    context.rect(area.x - 6, area.y, area.w + 12, area.h);
    context.clip();
    const drawLine = (night, color, width, dash) => {
      const x = plot.toDomXCoord(night);
      context.strokeStyle = color;
      context.lineWidth = width;
      context.setLineDash(dash);
      context.beginPath();
      context.moveTo(x, area.y);
      context.lineTo(x, bottom);
      context.stroke();
    };
    const drawTriangle = (night, color, tip, base) => {
      const x = plot.toDomXCoord(night);
      context.fillStyle = color;
      context.beginPath();
      context.moveTo(x, tip);
      context.lineTo(x - 5, base);
      context.lineTo(x + 5, base);
      context.fill();
    };
    if (this.frame !== null) drawLine(this.frame, colors.axis, 1, []);
    for (const { strategy, night } of this.data.changes(this.shown())) {
      const style = this.data.strategy(strategy);
      const color = isDark() ? style.darkColor : style.color;
      drawLine(night, color, 1, [4, 4]);
      drawTriangle(night, color, area.y + 9, area.y);
    }
    this.data.nights.forEach((night, i) => {
      if (night.accepted.length) drawTriangle(i, colors.pictures, bottom - 9, bottom);
    });
    context.restore();
  }
}
