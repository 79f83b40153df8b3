"""Subjects of commits, where git in this checkout knows them."""

import re
import subprocess

REVISION = re.compile(r"([0-9a-f]{7,40})(\W.*)?")  # with whatever says that it was changed


def find_subjects(root, revisions):
    """{revision: subject} of those that the repository at `root` has; without git, of none."""
    known = {}
    for revision in dict.fromkeys(revisions):
        match = REVISION.fullmatch(revision)
        if match:
            known[revision] = match[1]
    if not known:
        return {}
    asked = "".join(f"{name}^{{commit}}\n" for name in known.values())
    try:
        done = subprocess.run(["git", "-C", root, "cat-file", "--batch"], input=asked.encode(),
                              capture_output=True, check=False)
    except OSError:
        return {}
    subjects = _split(done.stdout, len(known))
    return {revision: subject for revision, subject in zip(known, subjects) if subject}


def _split(output, count):
    """The subjects in what git printed of so many objects, None for what it does not know."""
    place = 0
    for _ in range(count):
        end = output.find(b"\n", place)
        words = output[place:end].split()
        place = end + 1
        if end < 0 or len(words) != 3 or words[1] != b"commit":
            yield None
            continue
        size = int(words[2])
        _, _, message = output[place : place + size].partition(b"\n\n")
        place += size + 1
        paragraph = message.lstrip(b"\n").partition(b"\n\n")[0]
        yield " ".join(paragraph.decode("utf-8", "replace").split())
