"""A stand-in for the program that builds nothing and leaves made-up results (fake_run.py).

Each call is a line of JSON in the file that $FAKE_LOG names: what it was, its arguments, when it
began and ended. $FAKE_FAIL=OPTION=VALUE makes the runs with that value fail. A run with a latency of
frames:N waits until another such run has begun, if $FAKE_MEET names a folder.
"""

import json
import os
import pathlib
import sys
import time
import zlib

import fake_run

PROGRAM = """#!{python}
import sys
sys.path.insert(0, {folder!r})
import fake_hlodbench
sys.exit(fake_hlodbench.main(sys.argv[1:]))
"""
BUILD_HELP = """Options:
  -h,--help                   Print this help message and exit
  -o,--output TEXT REQUIRED   hierarchy to write (.hlod)
  --preset TEXT=paper         defaults of the other options
  --max-triangles UINT:UINT in [16 - 1000000]=2000
                              split a node above this
  --threads UINT:UINT in [0 - 1024]=0
"""
RUN_HELP = BUILD_HELP.replace("  -o,--output TEXT REQUIRED   hierarchy to write (.hlod)\n", """\
  --scene TEXT REQUIRED       hierarchy
  --out TEXT REQUIRED         result folder; must be new or empty
  --strategy TEXT=[bool] ...  strategies
  --simp TEXT=last            Simp(B)
  --exponent FLOAT=2          steepness
  --gl-debug                  stop at every OpenGL error
""")
MEETING_S = 60


def main(arguments):
    command = arguments[0]
    if "--help" in arguments:
        print({"run": RUN_HELP, "build": BUILD_HELP}[command])
        return 0
    flags = [a for a in arguments if a == "--gl-debug"]
    rest = [a for a in arguments[1:] if a not in flags]
    begun = time.monotonic()
    if command == "build":
        pathlib.Path(rest[rest.index("-o") + 1]).write_text("tree", encoding="utf-8")
        code = 0
    else:
        code = run(dict(zip(rest[::2], rest[1::2])))
    line = {"command": command, "arguments": arguments[1:], "begun": begun, "code": code,
            "ended": time.monotonic(), "threads": os.environ.get("LP_NUM_THREADS")}
    with open(os.environ["FAKE_LOG"], "a", encoding="utf-8") as log:
        log.write(json.dumps(line) + "\n")
    return code


def run(values):
    failing = os.environ.get("FAKE_FAIL", "").split("=")
    if len(failing) == 2 and values.get(failing[0]) == failing[1]:
        print("context fake\nhlodbench: the reason why", file=sys.stderr)
        return 2
    if os.environ.get("FAKE_MEET") and values.get("--latency", "").startswith("frames"):
        meet(pathlib.Path(os.environ["FAKE_MEET"]))
    out = pathlib.Path(values["--out"])
    strategies = values.get("--strategy", "bool,coh-b").split(",")
    varied = {key: value for key, value in sorted(values.items()) if key not in ("--out",)}
    size = [int(v) for v in values.get("--size", "64x48").split("x")]
    images = values.get("--images", "none")
    made = fake_run.make_run(
        out, strategies, frames=12, repetitions=int(values.get("--repetitions", 1)),
        image_frames=() if images == "none" else (6, 9), size=size, overlays=(),
        scene=pathlib.Path(values["--scene"]).name.split(".")[0],
        seed=zlib.crc32(json.dumps(list(varied.items())[2:]).encode()))
    made.data["options"].update(
        latency=values.get("--latency", "gl"), seed=int(values.get("--seed", 1)), images=images,
        **{key: float(values[f"--{key}"]) for key in ("s", "t", "tau") if f"--{key}" in values})
    fake_run.write_json(out / "run.json", made.data)
    return 0


def meet(folder):
    """Waits for a second one."""
    (folder / str(os.getpid())).touch()
    end = time.monotonic() + MEETING_S
    while len(list(folder.iterdir())) < 2 and time.monotonic() < end:
        time.sleep(0.02)
