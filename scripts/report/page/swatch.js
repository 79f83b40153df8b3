// How lines look, beside their names.

/** A line with dashes (pixels on, off, on, ...) as a CSS background. */
function makeDashes(color, dash) {
  let end = 0;
  const stops = dash.map((length, i) => {
    const start = end;
    end += length;
    return `${i % 2 ? "transparent" : color} ${start}px ${end}px`;
  });
  return stops.length ? `repeating-linear-gradient(90deg, ${stops.join(", ")})` : color;
}

/** Shows in a swatch how a strategy's line looks. */
function paintSwatch(swatch, style) {
  if (style)  // a name with a NUL, say, does not come through HTML
    swatch.style.background = makeDashes(isDark() ? style.darkColor : style.color, style.dash);
  return swatch;
}
