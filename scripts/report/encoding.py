"""Pictures as data URIs: how good, how large, and each different one only once."""

import base64
import io
from dataclasses import dataclass

import numpy as np
from PIL import Image

AMPLIFY = 8  # of difference pictures

ALL_OVERLAYS = 99


@dataclass(frozen=True)
class Level:
    """How pictures are embedded; a step down costs quality and saves space."""

    quality: int  # of WebP, 0 to 100
    overlays: int = ALL_OVERLAYS  # how many of each picture's, in the order of images.json
    stride: int = 1  # every so many frames with pictures


# Tried from the first on until the report is small enough. Overlays go before the pictures get so
# coarse that artefacts could be taken for errors of a strategy; frames go last.
LEVELS = (
    Level(92), Level(86), Level(80), Level(86, overlays=1), Level(80, overlays=1),
    Level(90, overlays=0), Level(80, overlays=0), Level(70, overlays=0),
    *(Level(70, overlays=0, stride=2**i) for i in range(1, 12)),
)


class Album:
    """The different pictures of one scene: add() gives the index of each."""

    def __init__(self):
        self.uris = []
        self.size = 0  # bytes of all URIs
        self._places = {}

    def add(self, picture, quality=None):
        """The index of the (height, width, 3) uint8 picture; without quality it is kept exactly."""
        uri = encode(picture, quality)
        if uri not in self._places:
            self._places[uri] = len(self.uris)
            self.uris.append(uri)
            self.size += len(uri)
        return self._places[uri]


def encode(picture, quality=None):
    """The picture as a data URI of WebP; lossless without quality."""
    data = io.BytesIO()
    options = {"lossless": True, "quality": 60} if quality is None else {"quality": quality}
    Image.fromarray(picture).save(data, "WEBP", method=4, **options)
    return "data:image/webp;base64," + base64.b64encode(data.getvalue()).decode("ascii")


def compute_difference(picture, reference, factor=AMPLIFY):
    """|picture - reference| · factor for each colour, at most 255: (h, w, 3) uint8."""
    difference = np.abs(picture.astype(np.int16) - reference.astype(np.int16)) * factor
    return np.minimum(difference, 255).astype(np.uint8)


def cut(picture, left, top, width, height):
    """A window of the picture, as an array of its own."""
    return np.ascontiguousarray(picture[top : top + height, left : left + width])
