"""Two programs that replay a session at once and take turns: who waits for whom, and that all else
stays as it is."""

import contextlib
import json
import os
import signal
import socket
import subprocess

import pytest
from small_scene import past_the_walls, write_session

FRAMES = 6
SOON_S = 1.0  # nothing comes meanwhile
LATE_S = 120.0


class Player:
    """A program that has been started with an end of a socket pair; `end` is the other one."""

    def __init__(self, walls_hlod, folder, *arguments):
        session = write_session(folder / "session.json", past_the_walls(FRAMES))
        self.out = folder / "out"
        self.end, theirs = socket.socketpair()
        self.process = subprocess.Popen(
            [os.environ["HLODBENCH_EXE"], "run", "--scene", walls_hlod, "--session", session,
             "--out", self.out, "--strategy", "coh-b", "--warm-up", "0", "--latency", "draws:3",
             "--images", "none", "--turns", str(theirs.fileno()), *arguments],
            pass_fds=[theirs.fileno()], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        theirs.close()

    def give(self):
        self.end.send(b"t")

    def has_passed(self, seconds):
        """Whether it passes its turn in this time."""
        self.end.settimeout(seconds)
        try:
            return self.end.recv(1) != b""
        except TimeoutError:
            return False

    def end_all(self):
        self.end.close()
        self.process.kill()
        self.process.communicate()


@pytest.fixture
def play(hlodbench, walls_hlod, tmp_path):
    """Starts one."""
    del hlodbench  # skips without the program
    with contextlib.ExitStack() as stack:

        def start(*arguments):
            player = Player(walls_hlod, tmp_path, *arguments)
            stack.callback(player.end_all)
            return player
        yield start


def counts(out):
    data = json.loads((out / "run.json").read_text(encoding="utf-8"))
    (case,) = data["cases"]
    means = {key: value["mean"] for key, value in case["summary"]["counters"].items()}
    return data["options"]["turn_frames"], {k: v for k, v in means.items() if not k.endswith("_ms")}


def test_it_waits_for_its_turns_and_passes_each_of_them(play, hlodbench, walls_hlod, tmp_path):
    player = play("--turn-frames", "4")
    assert not player.has_passed(SOON_S)
    player.give()
    assert player.has_passed(LATE_S)  # four frames
    assert not player.has_passed(SOON_S) and player.process.poll() is None
    player.give()
    assert player.has_passed(LATE_S)  # the other two
    assert player.process.wait(LATE_S) == 0
    turn_frames, with_turns = counts(player.out)
    assert turn_frames == 4

    plain = hlodbench("run", "--scene", walls_hlod, "--session", tmp_path / "session.json", "--out",
                      tmp_path / "plain", "--strategy", "coh-b", "--warm-up", "0", "--latency",
                      "draws:3", "--images", "none")
    assert plain.returncode == 0, plain.stderr
    assert counts(tmp_path / "plain") == (None, with_turns)


def test_every_replay_of_a_run_takes_turns(play):
    player = play("--turn-frames", "3", "--repetitions", "2")
    for _ in range(4):
        player.give()
        assert player.has_passed(LATE_S)
    assert player.process.wait(LATE_S) == 0


@pytest.mark.parametrize("after", [0, 1])
def test_when_the_other_program_is_gone_it_goes_on_alone(play, after):
    player = play("--turn-frames", "2")
    for _ in range(after):
        player.give()
        assert player.has_passed(LATE_S)
    player.end.close()
    assert player.process.wait(LATE_S) == 0


def test_interrupted_while_it_waits_it_ends(play):
    player = play("--turn-frames", "2")
    player.give()
    assert player.has_passed(LATE_S)
    player.process.send_signal(signal.SIGINT)
    assert player.process.wait(LATE_S) == 1
    assert "interrupted; 0 of 1 replays" in player.process.stderr.read()


@pytest.mark.parametrize("arguments, words", [
    (("--turns", "0"), "--turns: expected the descriptor of an inherited socket, found 0"),
    (("--turns", "1000"), "--turns: expected the descriptor of an inherited socket, found 1000"),
    (("--turns", "-1"), "--turns"), (("--turn-frames", "0"), "--turn-frames")])
def test_what_is_no_socket_is_refused(hlodbench, walls_hlod, tmp_path, arguments, words):
    session = write_session(tmp_path / "session.json", past_the_walls(FRAMES))
    done = hlodbench("run", "--scene", walls_hlod, "--session", session, "--out", tmp_path / "out",
                     *arguments, stdin=subprocess.DEVNULL)
    assert done.returncode == 2 and words in done.stderr
    assert not (tmp_path / "out").exists()
