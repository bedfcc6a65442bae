"""Run folders as arrays."""
import csv
import shutil

import numpy as np
import pytest

import gridshell as gs


def test_arrays_are_what_the_folder_says(small_run):
    run = gs.load(small_run)
    with open(small_run / "frames.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(run) == len(rows) == 3
    for name in ("progress", "boundary_radius_mm", "height_mm", "total_K", "residual_N"):
        np.testing.assert_array_equal(getattr(run, name), [float(row[name] or "nan") for row in rows])
    np.testing.assert_array_equal(run.energies["bend"],
                                  [float(row["energy_bend_mJ"]) for row in rows])
    np.testing.assert_array_equal(run.negative_pivots, [int(row["negative_pivots"]) for row in rows])
    assert run.stable.dtype == bool and np.isnan(run.force_N).all()
    assert run.summary["joints"] == len(run.layout.joints) and run.summary["finished"] is True
    with open(small_run / "joints.csv", newline="") as file:
        joints = [[float(row[k]) for k in ("x_mm", "y_mm", "z_mm")] for row in csv.DictReader(file)]
    np.testing.assert_array_equal(run.nodes[-1, :len(joints)], joints)


def test_frames_csv_is_a_table_for_numpy(small_run):
    run = gs.load(small_run)
    frames = np.genfromtxt(small_run / "frames.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(frames["energy_mJ"], run.energy_mJ)
    assert frames.dtype.names[-1] == "event"
    assert sum(frames[name] for name in frames.dtype.names
               if name.startswith("energy_") and name != "energy_mJ") == pytest.approx(
                   frames["energy_mJ"], rel=1e-12)


def test_frames_are_states_that_outlive_the_run(small_run):
    run = gs.load(str(small_run))
    nodes, last = run.nodes, run[-1]
    assert not nodes.flags.writeable and np.shares_memory(nodes, run.nodes)
    assert not last.nodes.flags.owndata
    copy = last.nodes.copy()
    view = last.nodes
    del run, last
    assert (view == copy).all() and (nodes[-1] == copy).all()
    run = gs.load(small_run)
    assert [state.progress for state in run] == list(run.progress)
    for k in (3, -4):
        with pytest.raises(IndexError):
            run[k]


def test_a_session_goes_on_from_the_preset_of_a_run(small_run):
    run = gs.load(small_run)
    file = small_run.parent / "again.toml"
    file.write_text(run.preset)
    session = gs.Session(file)
    session.actuate()
    assert session.energy_mJ == pytest.approx(run.energy_mJ[-1], rel=1e-9)


def cut(file):
    file.write_bytes(file.read_bytes()[:-100])


def flip(file):
    data = bytearray(file.read_bytes())
    data[len(data) // 2] ^= 0xFF
    file.write_bytes(data)


@pytest.mark.parametrize("name, damage", [
    ("trajectory.h5", cut), ("trajectory.h5", flip), ("trajectory.h5", lambda f: f.unlink()),
    ("summary.json", lambda f: f.write_text("{")), ("preset.toml", lambda f: f.write_text("= 1")),
])
def test_a_damaged_run_says_what_is_wrong(small_run, tmp_path, name, damage):
    folder = tmp_path / "damaged"
    shutil.copytree(small_run, folder)
    damage(folder / name)
    with pytest.raises(gs.BadInput, match=name):
        gs.load(folder)


def test_what_is_no_run_says_so(small_run, tmp_path):
    for folder in (tmp_path, tmp_path / "missing"):
        with pytest.raises(gs.BadInput, match="is no run"):
            gs.load(folder)
    with pytest.raises(gs.BadInput, match="case: expected one of"):
        gs.load(small_run, case="third")
    with pytest.raises(TypeError):
        gs.load(None)


def test_a_changed_trajectory_is_read_where_that_is_asked(small_run, tmp_path):
    shutil.copytree(small_run, tmp_path / "run")
    file = tmp_path / "run" / "trajectory.h5"
    bytes_ = file.read_bytes()
    at = bytes_.index(b"CRC-32 ") + 7
    file.write_bytes(bytes_[:at] + bytes([bytes_[at] ^ 1]) + bytes_[at + 1 :])
    with pytest.raises(gs.BadInput, match="no_checksum=True"):
        gs.load(tmp_path / "run")
    for how in ({"no_checksum": True}, {"unsealed": True}):  # the old name
        assert np.array_equal(gs.load(tmp_path / "run", **how).nodes, gs.load(small_run).nodes)
