"""Files that appear under their name when they are whole."""

import contextlib
import os
import tempfile


@contextlib.contextmanager
def write_atomically(path):
    """The name of an empty file beside `path` to write to; it becomes `path` when the block ends.

    If the block raises, whatever was at `path` stays, and nothing else is left. The file gets the
    rights that a new one gets.
    """
    handle, temporary = tempfile.mkstemp(dir=os.path.dirname(path) or ".", prefix=".",
                                         suffix=".tmp")
    os.close(handle)
    try:
        yield temporary
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)  # mkstemp makes private files
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def write_text_atomically(path, text):
    """Writes UTF-8 text so that nobody ever sees half of it."""
    with write_atomically(path) as temporary, open(temporary, "w", encoding="utf-8") as out:
        out.write(text)
