"""Changes as tables, states and reports that other processes receive, pictures after a fork."""
import os
import pickle
import runpy
import subprocess
import sys

import numpy as np
import pytest

import gridshell as gs

SMALL = {"footprint": {"rods": 6, "radius_mm": 63}, "actuation.radius_mm": 50}


def test_changes_may_be_tables_in_tables():
    session = gs.Session("s1_actuation", SMALL)
    flat = {"footprint.rods": 6, "footprint.radius_mm": 63, "actuation.radius_mm": 50}
    assert session.preset == gs.Session("s1_actuation", flat).preset
    with pytest.raises(gs.BadInput, match="footprint.*unknown key"):
        gs.Session("s1_actuation", {"footprint": {"rodds": 6}})


def test_states_and_reports_are_pickled():
    session = gs.Session("s1_actuation", SMALL)
    session.actuate(1)
    report = session.push((0, 0), depth_mm=1)
    state, again = session.state, pickle.loads(pickle.dumps(session.state))
    np.testing.assert_array_equal(again.nodes, state.nodes)
    np.testing.assert_array_equal(again.layout.joints, state.layout.joints)
    np.testing.assert_array_equal(again.reactions_N, state.reactions_N)
    assert again.energies == state.energies and again.force_N == state.force_N
    assert again.held == state.held == [(0, 0)] and again.directions == state.directions
    assert again.certificate.residual_N == state.certificate.residual_N
    assert repr(again) == repr(state) and "joints" in repr(state)
    assert repr(state.layout).startswith(f"Layout({len(state.layout.rods)} rods, ")
    copy = pickle.loads(pickle.dumps(report))
    assert repr(copy) == repr(report) and copy.seconds == report.seconds
    assert [event.t for event in copy.events] == [event.t for event in report.events]


FORK = """
import multiprocessing as mp
import sys
import gridshell as gs

def draw(name):
    session = gs.Session("s1_actuation", {"footprint.rods": 6, "footprint.radius_mm": 63,
                                          "actuation.radius_mm": 50})
    session.actuate(1)
    session.picture(name, size=(80, 60))
    return session.state

if len(sys.argv) > 1:
    draw("parent.png")
with mp.get_context("fork").Pool(2) as pool:
    try:
        print([state.height_mm > 0 for state in pool.map_async(draw, ["a.png", "b.png"]).get(50)])
    except gs.IOFailure as error:
        print("refused:", error)
"""


def drawn_in_a_pool(tmp_path, *first):
    (tmp_path / "fork.py").write_text(FORK)
    return subprocess.run([sys.executable, "fork.py", *first], cwd=tmp_path, timeout=55, check=True,
                          capture_output=True, text=True).stdout


def test_processes_of_a_pool_draw_and_send_states(tmp_path):
    assert drawn_in_a_pool(tmp_path) == "[True, True]\n"
    assert (tmp_path / "b.png").exists()


def test_a_fork_of_a_process_that_has_drawn_refuses_to_draw(tmp_path):
    said = drawn_in_a_pool(tmp_path, "first")
    assert said.startswith("refused: this process was forked from one that had drawn")
    assert 'get_context("spawn")' in said


def test_the_example_of_a_fit_finds_what_was_measured():
    example = os.path.join(os.environ["GRIDSHELL_SOURCE"], "app/python/examples/fit.py")
    fit = runpy.run_path(example)
    assert fit["fit"](fit["joints"](64.3), 66) == pytest.approx(64.3, abs=1e-5)
    # central differences over 0.01 mm and over 0.02 mm agree to five digits
    slopes = [(fit["joints"](64 + h) - fit["joints"](64 - h)) / (2 * h) for h in (0.01, 0.02)]
    assert np.linalg.norm(slopes[0] - slopes[1]) < 1e-5 * np.linalg.norm(slopes[0])
