"""hlodbench as the tracking runs it."""

import functools
import pathlib
import re
import subprocess
from dataclasses import dataclass

from result_folder import ResultError, read_run
from sweeping.cell import Attempt, CellFailed

from .build import last_line, run
from .core import on_core
from .errors import ProgramCrashed, TrackingError, run_again_once
from .machine import is_software
from .matrix import LATENCY, PICTURES, REFERENCE
from .measure import read_replay

NO_GL = 3
STRATEGY = re.compile(r"^  ([a-z][a-z0-9-]*) ", re.MULTILINE)
TURN_FRAMES = 8
PROBE_SIZE = "64x48"  # pixels


@dataclass(frozen=True)
class Program:
    """hlodbench, and the hierarchies that it has built."""

    path: pathlib.Path
    cache: pathlib.Path
    name: str  # in messages
    out: pathlib.Path  # logs and results go here
    sessions: pathlib.Path
    context: str = "auto"
    environment: dict | None = None  # of its runs; None: ours
    core: int | None = None  # of the processor, for timed runs; None: any

    def build_hierarchy(self, scene):
        """Makes cache/SCENE.hlod, unless it is there and up to date."""
        self.cache.mkdir(parents=True, exist_ok=True)
        log = self.out / f"{self.name}.{scene}.build.log"
        code = run([self.path, "build", self.sessions / f"{scene}.scene.json", "-o",
                    self._hierarchy(scene)], None, log)
        if code != 0:
            raise TrackingError(f"{self.name}: hierarchy of {scene}: hlodbench ended with code "
                                f"{code}: {last_line(log)}")

    def list_strategies(self):
        """Their ids."""
        done = self._ask("list")
        section = done.stdout.partition("Strategies")[2].partition("\n\n")[0]
        found = STRATEGY.findall(section)
        if done.returncode != 0 or not found:
            raise TrackingError(f"{self.path} list: expected strategies, found none")
        return found

    @functools.cached_property
    def takes_turns(self):
        """Whether it knows --turns; a baseline may be older."""
        return "--turns " in self._ask("run", "--help").stdout

    def exact_folder(self, scene):
        """Where run_exact() leaves its results."""
        return self.out / "exact" / scene

    def run_exact(self, scene, strategies, note):
        """The exact tier of a scene; its result folder. note: called with a line if the program
        crashed and was run again."""
        return run_again_once(lambda _: self._run_exact(scene, strategies), note)

    def _run_exact(self, scene, strategies):
        folder = self.exact_folder(scene)
        names = list(dict.fromkeys([REFERENCE, *strategies]))
        with self._start(scene, names, folder, "--latency", LATENCY, "--images", PICTURES) as made:
            made.finish()
        return folder

    def start_timed(self, cell, folder, turns=None):
        """Starts a replay with the driver's latency; a TimedRun. turns: descriptor of a socket, see
        `hlodbench run --turns`."""
        scene, strategy = cell.split("/")
        shared = () if turns is None else ("--turns", str(turns), "--turn-frames", str(TURN_FRAMES))
        with on_core(self.core):
            return self._start(scene, [strategy], folder, "--latency", "gl", "--images", "none",
                               *shared, kind=TimedRun, pass_fds=() if turns is None else (turns,))

    def run_timed(self, cell, folder):
        """One replay, alone; a Replay."""
        with self.start_timed(cell, folder) as started:
            return started.finish()

    def draws_on_gpu(self, scene):
        """Whether its OpenGL does, seen by a small replay of a scene."""
        folder = self.out / "probe" / self.name
        with self._start(scene, [REFERENCE], folder, "--latency", "gl", "--images", "none", "--size",
                         PROBE_SIZE) as made:
            made.finish()
        try:
            gl = read_run(folder, frames=False).data["context"]["gl"]
        except (ResultError, KeyError) as error:
            raise TrackingError(f"{folder}: expected an OpenGL context: {error}") from None
        return not is_software(gl["renderer"])

    def _hierarchy(self, scene):
        return self.cache / f"{scene}.hlod"

    def _ask(self, *arguments):
        try:
            return subprocess.run([self.path, *arguments], capture_output=True, text=True,
                                  check=False, stdin=subprocess.DEVNULL)
        except (OSError, UnicodeDecodeError) as error:
            raise TrackingError(f"{self.path}: cannot be run: {error}") from None

    def _start(self, scene, strategies, folder, *options, kind=None, pass_fds=()):
        context = [] if self.context == "auto" else ["--context", self.context]
        command = [self.path, "run", "--scene", self._hierarchy(scene), "--session",
                   self.sessions / f"{scene}.session.json", "--strategy", ",".join(strategies),
                   "--repetitions", "1", *context, *options]
        what = f"{self.name}: {scene}/{','.join(strategies)}"
        return (kind or Started)(command, folder, what, env=self.environment, pass_fds=pass_fds)


class Started:
    """A run that has been started, of which a result folder is to come. A context manager."""

    def __init__(self, command, folder, what, **options):
        self.folder, self._what = folder, what
        folder.parent.mkdir(parents=True, exist_ok=True)
        self._log = folder.with_name(f"{folder.name}.log")
        try:
            with open(self._log, "wb") as file:
                self._attempt = Attempt(command, folder, stdout=file, stderr=file,
                                        stdin=subprocess.DEVNULL, **options)
        except OSError as error:
            raise TrackingError(f"{error.filename or command[0]}: {error.strerror}") from None

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self._attempt.__exit__(*error)

    def finish(self):
        """Waits for its end. Raises TrackingError."""
        try:
            self._attempt.finish()
        except CellFailed as error:
            what = "no usable OpenGL" if error.code == NO_GL else str(error)
            kind = TrackingError
            if error.code is not None and error.code < 0:
                what, kind = f"hlodbench was ended by signal {-error.code}", ProgramCrashed
            raise kind(f"{self._what}: {what}: {last_line(self._log)} ({self._log})") from None
        except OSError as error:
            raise TrackingError(f"{self.folder}: {error.strerror}") from None


class TimedRun(Started):
    """A replay that has been started. A context manager."""

    def finish(self):
        """Waits for its end; the Replay. Raises TrackingError."""
        super().finish()
        folder = self.folder
        try:
            result = read_run(folder)
            (case,) = result.cases
        except (ResultError, ValueError) as error:
            raise TrackingError(f"{folder}: expected one replay: {error}") from None
        replay = None if case.error else read_replay(case, result.data["scene"].get("hash"))
        if replay is None:
            raise TrackingError(f"{folder}: {case.strategy}: {case.error or 'no frame rate'}")
        return replay
