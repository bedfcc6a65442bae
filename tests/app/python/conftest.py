"""The module and the program of the build, named by the environment (tests/tests.cmake)."""
import os
import subprocess
import sys

import pytest

SMALL = ["footprint.rods=6", "footprint.radius_mm=63", "actuation.radius_mm=50"]


@pytest.fixture(scope="session")
def python():
    return sys.executable


@pytest.fixture(scope="session")
def example():
    return os.path.join(os.environ["GRIDSHELL_SOURCE"], "app/python/examples/push.py")


@pytest.fixture(scope="session")
def small_run(tmp_path_factory):
    """The folder of a run of the program."""
    folder = tmp_path_factory.mktemp("runs") / "small"
    changes = [word for change in SMALL for word in ("--set", change)]
    subprocess.run([os.environ["GRIDSHELL_PROGRAM"], "run", "s1_actuation", "--quiet", "--frames",
                    "3", *changes, "-o", folder], check=True, timeout=60,
                   stdout=subprocess.DEVNULL)
    return folder
