"""Finds what Fig. 5 of the paper shows: where a predicting strategy looks worst against Bool."""

from dataclasses import dataclass

from result_folder import find_worst_region

REFERENCE = "bool"
COMPARED = ("simp-b", "coh-b")
DETAILS_A_SIDE = 8  # a detail is an eighth of the picture, each way


@dataclass(frozen=True)
class Detail:
    """A window of a picture, in pixels from the top left."""

    strategy: str
    frame: int
    left: int
    top: int
    width: int
    height: int
    error: float  # mean squared difference of luminance to Bool's picture, in 8-bit steps
    rarn: int  # nodes that the strategy rendered and then refined; 0 if unknown
    searched: int  # pictures that were compared

    def crop(self, picture):
        """This window of a (height, width, ...) picture."""
        return picture[self.top : self.top + self.height, self.left : self.left + self.width]


def find_detail(run, by="error"):
    """The worst detail over all frames and both strategies, or None if nothing can be compared.

    by: "error": where a window of an eighth of the picture each way differs most from Bool's;
    "rarn": such a window of the picture with the most nodes rendered and then refined. Of equals
    the worse by the other measure, then the earlier frame, and Simp(B) before Coh(B).
    """
    details = []
    for frame in run.image_frames():
        reference = run.image(REFERENCE, frame)
        for strategy in COMPARED if reference is not None else ():
            picture = run.image(strategy, frame)
            if picture is None:
                continue
            size = [max(n // DETAILS_A_SIDE, 1) for n in (picture.shape[1], picture.shape[0])]
            left, top, error = find_worst_region(picture, reference, *size)
            rarn = run.image_entry(strategy, frame).get("rarn_nodes")
            rarn = rarn if isinstance(rarn, int) else 0
            details.append((strategy, frame, left, top, *size, error, rarn))
    if not details:
        return None
    measures = [(d[6], d[7]) for d in details]
    if by == "rarn":
        measures = [m[::-1] for m in measures]
    return Detail(*details[measures.index(max(measures))], searched=len(details))
