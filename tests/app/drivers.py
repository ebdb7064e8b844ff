"""Which OpenGL drivers a run of weft loads, as the dynamic linker of glibc tells it (LD_DEBUG): whether a command opened OpenGL."""
import os
import pathlib
import re

# OpenGL into memory, what stands behind EGL and GLX, and the compiler inside of them.
DRIVER = re.compile(r"(?:lib(?:OSMesa|EGL_\w+|GLX_\w+|LLVM[-\w]*|gallium[-\w]*)|\w+_dri)\.so")


def watched(folder):
    """The environment of runs whose drivers drivers_of() tells. Each wants a folder of its own."""
    return {**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": f"{folder}/loaded"}


def drivers_of(folder):
    """The drivers; None where the linker says nothing of what it loads."""
    texts = [file.read_text(errors="replace") for file in pathlib.Path(folder).glob("loaded.*")]
    return sorted({found for text in texts for found in DRIVER.findall(text)}) if any("libc.so" in text for text in texts) else None
