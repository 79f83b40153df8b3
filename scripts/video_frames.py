"""Composes the frames of a video: strategies side by side, each under a line of its counters."""

import math

import numpy as np
from frame_rate import smooth_frame_rates
from matplotlib.font_manager import findfont
from PIL import Image, ImageDraw, ImageFont
from strategy_style import styles_of

BACKGROUND, BAR, TEXT, DIM = (30, 30, 30), (20, 20, 20), (255, 255, 255), (150, 150, 150)
MIN_POINTS = 6  # smaller is no use; then the captions of tiny pictures are cut off
GAP = 4  # pixels between pictures


class FrameComposer:
    """Makes one video frame of each session frame.

    size: (width, height) of every video frame, pixels, both even; font: of the captions.
    """

    def __init__(self, run, strategies):
        self._run = run
        self._strategies = strategies
        self._styles = styles_of(strategies)
        self._counters = {s: _read_counters(run, s) for s in strategies}
        width, height = run.images["width"], run.images["height"]
        self._label_width = max(len(run.label(s)) for s in strategies) + 2
        self.font = self._choose_font(width)
        self._bar = round(self.font.size * 1.7)
        self._columns = math.ceil(math.sqrt(len(strategies)))
        rows = math.ceil(len(strategies) / self._columns)
        self._cell = (width + GAP, height + self._bar + GAP)
        full = (self._columns * self._cell[0] - GAP, rows * self._cell[1] - GAP)
        self.size = tuple(n + n % 2 for n in full)  # what video codecs want

    def compose(self, frame):
        """The video frame of one session frame: an RGB image of `size`."""
        canvas = Image.new("RGB", self.size, BACKGROUND)
        draw = ImageDraw.Draw(canvas)
        for place, strategy in enumerate(self._strategies):
            left = place % self._columns * self._cell[0]
            top = place // self._columns * self._cell[1]
            self._draw_bar(draw, left, top, strategy, frame)
            picture = self._run.image(strategy, frame)
            if picture is not None:
                canvas.paste(Image.fromarray(picture), (left, top + self._bar))
            else:
                draw.text((left + self._bar, top + 2 * self._bar), "no picture", DIM, self.font)
        return canvas

    def picture_box(self, strategy):
        """Where the strategy's picture lies: left, top, right, bottom, in pixels."""
        place = self._strategies.index(strategy)
        left = place % self._columns * self._cell[0]
        top = place // self._columns * self._cell[1] + self._bar
        return left, top, left + self._run.images["width"], top + self._run.images["height"]

    def caption(self, strategy, frame):
        """The line above a picture; "-" stands for what is not known."""
        dn, rarn, fps = (_format(values, frame, decimals)
                         for values, decimals in zip(self._counters[strategy], (0, 0, 1)))
        label = self._run.label(strategy).ljust(self._label_width)
        return f"{label}frame {frame:<6}DN {dn:<7}RARN {rarn:<4}{fps:>6} FPS"

    def _choose_font(self, width):
        """The largest fixed-width font in which every caption fits above a picture."""
        longest = len(self.caption(self._strategies[0], 10**5 - 1)) + 1
        path = findfont("DejaVu Sans Mono")
        sample = ImageFont.truetype(path, 100).getlength("0" * longest) / 100
        # The coloured square in front takes about as much as two letters and a half.
        return ImageFont.truetype(path, max(int(width / (sample + 1.7)), MIN_POINTS))

    def _draw_bar(self, draw, left, top, strategy, frame):
        right, bottom = left + self._cell[0] - GAP - 1, top + self._bar - 1
        draw.rectangle((left, top, right, bottom), fill=BAR)
        side = self._bar // 2  # the strategy's colour, as in the figures
        corner = (left + side // 2, top + (self._bar - side) // 2)
        draw.rectangle((*corner, corner[0] + side, corner[1] + side), outline=TEXT,
                       fill=self._styles[strategy].color)
        draw.text((left + 2 * side, top + self._bar / 2), self.caption(strategy, frame), TEXT,
                  self.font, anchor="lm")


def _read_counters(run, strategy):
    """DN and RARN of the replay that the pictures show, and the smoothed rate, each by frame."""
    cases = [c for c in run.cases if c.strategy == strategy and c.columns]
    columns = min(cases, key=lambda c: c.repetition).columns if cases else {}
    nothing = np.empty(0)
    return (columns.get("dn", nothing), columns.get("rarn", nothing),
            smooth_frame_rates(run, strategy))


def _format(values, frame, decimals):
    known = frame < len(values) and not math.isnan(values[frame])
    return f"{values[frame]:.{decimals}f}" if known else "-"
