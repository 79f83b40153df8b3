"""What a night measures. The names of cells, SCENE/STRATEGY, are what histories compare by."""

from .errors import TrackingError

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b", "reuse-b")
REFERENCE = "bool"  # whose pictures the others' are compared with: in every exact run
DEFAULT_SCENES = ("courtyard",)
PAPER_SCENES = ("scene1", "scene2")
LATENCY = "draws:12"  # of the exact tier
PICTURES = "10"


def list_cells(paper, chosen):
    """Cells in the order of the report: all of the matrix, or those of `chosen` if it has any."""
    scenes = PAPER_SCENES if paper else DEFAULT_SCENES
    cells = [f"{scene}/{strategy}" for scene in scenes for strategy in STRATEGIES]
    for cell in chosen:
        if cell not in cells:
            raise TrackingError(f"--cell: expected one of {', '.join(cells)}, found '{cell}'")
    return [cell for cell in cells if not chosen or cell in chosen]


def list_scenes(cells):
    """The scenes of cells, each once."""
    return list(dict.fromkeys(cell.split("/")[0] for cell in cells))


def strategies_of(cells, scene):
    """The strategies that are wanted of a scene."""
    return [cell.split("/")[1] for cell in cells if cell.split("/")[0] == scene]
