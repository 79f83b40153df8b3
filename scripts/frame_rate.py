"""The frame rate over a session, as figures and videos show it. Needs only numpy."""

import numpy as np

SMOOTHING_FRAMES = 9  # of the running median; a third of a second at 30 frames a second


def warm_up_frames(run):
    """How many frames at the start of each replay are not measured; 0 if that is not known."""
    count = run.data.get("warm_up_frames")
    return count if isinstance(count, int) and count > 0 else 0


def frame_rates(run, strategy):
    """1000 / frame_ms by frame, (frames,), 1/s, of the median of repetitions; NaN where absent."""
    times = run.frame_means(strategy, "frame_ms")
    rates = np.full(len(times), np.nan)
    known = times > 0  # false for NaN, too
    rates[known] = 1000 / times[known]
    return rates


def running_median(values, window=SMOOTHING_FRAMES):
    """The median of the `window` (odd) values around each, (n,) as `values`.

    At the ends, and beside NaN, it is of the values there are. Where the value is NaN it is NaN.
    """
    half = window // 2
    padded = np.pad(np.asarray(values, dtype=float), half, constant_values=np.nan)
    medians = np.full(len(values), np.nan)
    for i in np.flatnonzero(~np.isnan(values)):
        medians[i] = np.nanmedian(padded[i : i + window])
    return medians


def smooth_frame_rates(run, strategy):
    """The running median of the measured frames' rates, (frames,), 1/s; NaN in the warm-up."""
    rates = frame_rates(run, strategy)
    rates[: warm_up_frames(run)] = np.nan
    return running_median(rates)
