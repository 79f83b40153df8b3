#!/usr/bin/env python3
"""Makes a video of a session, strategies side by side, from a folder that `hlodbench run` left.

Above each picture stand its frame, drawn nodes (DN), nodes rendered and then refined (RARN), and
frames per second (FPS, the median of 9 frames around it over all repetitions; none in the warm-up).
"""

import argparse
import math
import shutil
import signal
import subprocess
import sys
import tempfile

from atomic_file import write_atomically

try:
    from result_folder import ResultError, read_run
    from video_frames import FrameComposer
except ImportError as error:
    print(f"make_video.py: needs {error.name} (Debian: python3-matplotlib python3-numpy "
          "python3-pil)", file=sys.stderr)
    sys.exit(2)

EPILOG = """\
The video shows the frames that have pictures: make the run with --images all. It is H.264 in MP4,
BT.709, made by ffmpeg (Debian: ffmpeg), which gets the frames through a pipe: no picture is
written.
A strategy that has no picture of a frame shows none there; what is missing is said on stderr.
Exit codes: 0 the video was made; 1 ffmpeg failed; 2 wrong usage, no ffmpeg, or nothing to show.
"""


class BadInput(Exception):
    """Something wrong with what was asked for; the message is one line."""


class EncodingFailed(Exception):
    """ffmpeg failed; the message is the last line it printed."""


def frames_per_second(text):
    """An argparse type."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 1 <= value <= 240:
        raise argparse.ArgumentTypeError(f"expected 1 to 240 frames per second, found {text!r}")
    return value


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="make_video.py", description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", help="result folder of `hlodbench run`")
    parser.add_argument("--out", metavar="FILE.mp4", required=True, help="the video to write")
    parser.add_argument("--fps", type=frames_per_second, default=30.0,
                        help="frames per second of the video, 1 to 240 (default: 30)")
    parser.add_argument("--strategies", metavar="LIST",
                        help="which, and in which order: bool,coh-b (default: all with pictures)")
    options = parser.parse_args(arguments)
    if not options.out.endswith(".mp4"):
        parser.error(f"--out: expected a name that ends in .mp4, found {options.out!r}")
    return options


def choose_strategies(run, wanted):
    """The ids to show; BadInput if one of the wanted has no pictures."""
    present = run.image_strategies()
    if run.images is None or not run.images["frames"] or not present:
        raise BadInput(next((p for p in run.problems if "images.json" in p),
                            f"{run.folder}: expected pictures, found none"))
    if run.images.get("format") != "png":
        raise BadInput(f"{run.folder}/images/images.json: format: expected png, found "
                       f"{run.images.get('format')}")
    if wanted is None:
        return present
    chosen = list(dict.fromkeys(wanted.split(",")))
    for strategy in chosen:
        if strategy not in present:
            raise BadInput(f"--strategies: expected some of {','.join(present)}, found "
                           f"{strategy!r}")
    return chosen


def say(line):
    print(f"make_video.py: {line}", file=sys.stderr)


def say_gaps(frames):
    """Says it if the video will jump."""
    gaps = sum(b != a + 1 for a, b in zip(frames, frames[1:]))
    if gaps:
        say(f"the {len(frames)} frames with pictures, {frames[0]} to {frames[-1]}, are not "
            f"consecutive: the video jumps {gaps} times (--images all has every frame)")


def start_ffmpeg(program, size, fps, path, log):
    """ffmpeg, waiting for frames of `size` (width, height) as 8-bit RGB on its standard input."""
    source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}", "-r", f"{fps:g}",
              "-i", "-"]
    # The colours are converted and labelled alike, or players would guess.
    colors = ["-vf", "scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709",
              "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"]
    codec = ["-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p",
             "-movflags", "+faststart", "-fflags", "+bitexact", "-f", "mp4"]
    command = [program, "-hide_banner", "-loglevel", "error", "-y", *source, *colors, *codec]
    return subprocess.Popen([*command, f"file:{path}"], stdin=subprocess.PIPE, stdout=log,
                            stderr=log)


def encode(program, composer, frames, fps, path):
    """Writes the video of these session frames to `path`, which may exist."""
    with tempfile.TemporaryFile() as log:
        process = start_ffmpeg(program, composer.size, fps, path, log)
        try:
            for count, frame in enumerate(frames, 1):
                process.stdin.write(composer.compose(frame).tobytes())
                show_progress(count, len(frames))
            process.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg has ended, and its exit code says why
        except BaseException:
            process.kill()
            raise
        finally:
            code = process.wait()
        if code != 0:
            log.seek(0)
            lines = log.read().decode(errors="replace").strip().splitlines()
            raise EncodingFailed(lines[-1] if lines else f"exit code {code}")


def show_progress(count, total):
    """On a terminal one line that changes; elsewhere a line every tenth."""
    if sys.stderr.isatty():
        end = "\n" if count == total else ""
        print(f"\rmake_video.py: frame {count} of {total}", end=end, file=sys.stderr, flush=True)
    elif count * 10 // total > (count - 1) * 10 // total:
        say(f"frame {count} of {total}")


def write_video(run, strategies, options, program):
    """Encodes under a temporary name, so that nobody ever sees half a video."""
    composer = FrameComposer(run, strategies)
    frames = run.image_frames()
    say_gaps(frames)
    with write_atomically(options.out) as temporary:
        encode(program, composer, frames, options.fps, temporary)
    say(f"{options.out}: {len(frames)} frames of {composer.size[0]}x{composer.size[1]} pixels, "
        f"{len(frames) / options.fps:.1f} s")


def main(arguments=None):
    options = parse_arguments(arguments)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # by an exception: it cleans up
    program = shutil.which("ffmpeg")
    try:
        run = read_run(options.folder)
        strategies = choose_strategies(run, options.strategies)
        if program is None:
            raise BadInput("needs the program ffmpeg (Debian: ffmpeg)")
        write_video(run, strategies, options, program)
    except (ResultError, BadInput) as error:
        say(error)
        return 2
    except EncodingFailed as error:
        say(f"ffmpeg: {error}")
        return 1
    except OSError as error:
        say(f"{options.out}: {error.strerror}")
        return 2
    except KeyboardInterrupt:
        say("interrupted; no video was written")
        return 130
    for problem in run.problems:
        say(problem)
    return 0


if __name__ == "__main__":
    sys.exit(main())
