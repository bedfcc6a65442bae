"""folder.py PREFIX: prints the folder for Python modules in PREFIX, relative to it."""
import os
import site
import sys

prefix = os.path.abspath(sys.argv[1])
# the first folder in the prefix that this Python searches, such as dist-packages on Debian
inside = [folder for folder in site.getsitepackages() if folder.startswith(os.path.join(prefix, "lib") + os.sep)]
version = f"python{sys.version_info.major}.{sys.version_info.minor}"
print(os.path.relpath(inside[0], prefix) if inside else f"lib/{version}/site-packages")
