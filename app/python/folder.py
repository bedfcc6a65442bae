"""Prints where a prefix keeps Python modules, relative to it."""
import os
import site
import sys

prefix = os.path.abspath(sys.argv[1])
# of the folders where this Python looks the one in the prefix, as dist-packages of Debian
inside = [place for place in site.getsitepackages() if place.startswith(os.path.join(prefix, "lib") + os.sep)]
version = f"python{sys.version_info.major}.{sys.version_info.minor}"
print(os.path.relpath(inside[0], prefix) if inside else f"lib/{version}/site-packages")
