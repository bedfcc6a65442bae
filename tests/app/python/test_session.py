"""Sessions: their states are those of the program, and arrays of a state never change."""
import gc
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import gridshell as gs

SMALL = {"footprint.rods": 6, "footprint.radius_mm": 63, "actuation.radius_mm": 50,
         "movie.frames": 2}


def small(**more):
    return gs.Session("s1_actuation", {**SMALL, **{k.replace("__", "."): v for k, v in more.items()}})


@pytest.fixture(scope="module")
def formed():
    """One formed shell for all tests that only read it, or restore its state."""
    session = small()
    session.actuate()
    return session


def test_comes_to_the_state_of_the_program(formed, small_run):
    run = gs.load(small_run)
    assert formed.energy_mJ == pytest.approx(run.energy_mJ[-1], rel=1e-9)
    np.testing.assert_allclose(formed.nodes, run[-1].nodes, rtol=0, atol=1e-6)
    assert formed.certificate.stable and formed.certificate.residual_N < 1e-6
    assert formed.height_mm == pytest.approx(run.summary["height_mm"], rel=1e-9)


def test_is_flat_until_it_is_actuated():
    session = small()
    assert session.progress == 0 and session.energy_mJ == 0
    assert np.ptp(session.nodes[:, 2]) == 0
    with pytest.raises(gs.BadInput, match="still flat"):
        session.push((0, 0), 1)
    with pytest.raises(gs.BadInput, match="still flat"):
        session.actuate(0, edge_points=[[0, 5, 0, 0]])
    session.actuate(0.3)
    assert session.progress == pytest.approx(0.3)
    assert session.boundary_radius_mm == pytest.approx(63 - 0.3 * 13)
    session.actuate(radius_mm=56)
    assert session.boundary_radius_mm == pytest.approx(56)


def test_errors_name_the_method_and_no_line(formed):
    with pytest.raises(gs.BadInput) as error:
        formed.actuate(-1)
    assert str(error.value).startswith("actuate(): progress: got -1")


def test_a_network_that_is_restored_as_drawn_follows_the_same_path():
    session = gs.Session("network_space")
    drawn = session.save()
    first = session.actuate()
    nodes = session.nodes.copy()
    session.restore(drawn)
    again = session.actuate()
    np.testing.assert_allclose(session.nodes, nodes, rtol=0, atol=1e-9)
    assert again.limit_reason == again.told == first.limit_reason
    assert again.newton_iterations == first.newton_iterations


def test_a_network_in_space_begins_at_rest_as_it_is_drawn():
    session = gs.Session("network_space")
    assert session.progress == 0 and session.certificate.stable
    drawn = session.energy_mJ
    assert drawn > 1 and np.ptp(session.nodes[:, 2]) > 50
    session.push((17, 0), 5)
    assert session.energy_mJ > drawn
    # actuated at once or after a push, the network reaches the same state
    session.release((17, 0))
    session.actuate()
    first = gs.Session("network_space")
    first.actuate()
    assert first.progress == 1 and first.energy_mJ > 1.2 * drawn
    assert session.energy_mJ == pytest.approx(first.energy_mJ, rel=1e-3)


def test_a_push_resists_and_comes_back(formed):
    kept = formed.save()
    before, height = formed.nodes, formed.height_mm
    corner = next(k for k, joint in enumerate(formed.layout.joints) if tuple(joint) == (0, 0))
    x, y, z = before[corner]
    energies = []
    for depth in (1.99, 2, 2.01):
        report = formed.push((0, 0), to_mm=(x, y, z - depth), along=(0, 0, -1))
        assert report.certificate.stable and formed.held == [(0, 0)]
        assert formed.depth_mm == pytest.approx(depth, abs=1e-6)
        energies.append(formed.energy_mJ)
        if depth == 2:
            force = formed.force_N
    # the force is the derivative of the energy with respect to the depth
    assert force > 0 and force == pytest.approx((energies[2] - energies[0]) / 0.02, rel=1e-3)
    formed.release()
    assert formed.held == [] and np.isnan(formed.force_N)
    assert formed.height_mm == pytest.approx(height, abs=1e-3)
    formed.restore(kept)
    np.testing.assert_allclose(formed.nodes, before, rtol=0, atol=1e-12)


def test_a_step_past_the_tolerance_is_made_on_finer_meshes():
    session = small(footprint__radius_mm=66, actuation__radius_mm=64)
    session.actuate()
    session.actuate(radius_mm=45)
    assert session.state.boundary_radius_mm == pytest.approx(45)
    assert session.state.error_estimate_mm < 1e-3 * 66


def test_a_push_by_a_depth_goes_inward(formed):
    kept = formed.save()
    joint = [tuple(one) for one in formed.layout.joints].index((0, 0))
    before = formed.nodes[joint].copy()
    formed.push(np.array([0, 0]), depth_mm=3)
    assert formed.depth_mm == pytest.approx(3, abs=1e-6) and formed.force_N > 0
    moved = formed.nodes[joint] - before
    assert moved[2] < -2
    formed.restore(kept)


def test_pushes_along_the_first_direction_are_one_push(formed):
    kept = formed.save()
    formed.push((0, 0), depth_mm=10)
    once, force = formed.nodes.copy(), formed.force_N
    formed.restore(kept)
    formed.push((0, 0), depth_mm=2)
    joint = [tuple(one) for one in formed.layout.joints].index((0, 0))
    way = np.array(formed.directions[0])
    assert np.linalg.norm(way) == pytest.approx(1)
    start = formed.nodes[joint] - 2 * way
    for depth in (4, 6, 8, 10):
        formed.push((0, 0), to_mm=start + depth * way, along=way)
        assert formed.depth_mm == pytest.approx(depth, abs=1e-6)
    np.testing.assert_allclose(formed.nodes, once, rtol=0, atol=1e-3)
    assert formed.force_N == pytest.approx(force, rel=1e-4)
    formed.restore(kept)


def test_arrays_look_into_their_state_and_outlive_it(formed):
    kept = formed.save()
    first = formed.nodes
    assert np.shares_memory(first, formed.nodes) and not first.flags.owndata
    assert np.shares_memory(first, formed.state.nodes)
    copy = first.copy()
    for write in (lambda: first.__setitem__((0, 0), 1.0), lambda: first.setflags(write=True)):
        with pytest.raises(ValueError):
            write()
    formed.push((1, 0), 1)
    assert not np.shares_memory(first, formed.nodes)
    assert (first == copy).all() and (formed.nodes != copy).any()
    formed.restore(kept)
    session = small()
    nodes, rod, joints = session.nodes, session.layout.rods[0], session.layout.joints
    expected = nodes.copy(), rod.copy(), joints.copy()
    del session
    gc.collect()
    junk = [np.ones(nodes.size) for _ in range(100)]
    assert all((a == b).all() for a, b in zip((nodes, rod, joints), expected)) and junk


def test_shapes_fit_each_other(formed):
    state, layout = formed.state, formed.layout
    assert state.nodes.shape[1] == 3 and layout.joints.shape[1] == 2 and layout.cells.shape[1] == 4
    assert len(layout.rods) == len(layout.families)
    assert state.axial_force_N.size == sum(len(rod) - 1 for rod in layout.rods)
    assert state.curvature_per_mm.size == sum(len(rod) for rod in layout.rods)
    assert state.bending_mJ_per_m.size == state.curvature_per_mm.size
    assert state.reactions_N.shape == (layout.supports.size, 3)
    assert state.cell_K.size == len(layout.cells)
    assert state.total_K == pytest.approx(state.cell_K.sum())
    # nothing is loaded, so the reactions of the supports are in balance
    np.testing.assert_allclose(state.reactions_N.sum(axis=0), 0, atol=1e-6)
    radius = np.linalg.norm(state.nodes[layout.edge_points], axis=1)
    np.testing.assert_allclose(radius, 50, atol=1e-9)


@pytest.mark.parametrize("wrong, said", [
    (lambda s: s.push((40, 0), 1), r"expected \[i, j\] of one of"),
    (lambda s: s.push((0, 0, 1), 1), r"expected \[i, j\]"),
    (lambda s: s.push((0, 0.5), 1), "joint"),
    (lambda s: s.push((0, 0)), "to_mm"),
    (lambda s: s.push((0, 0), float("nan")), "depth_mm: got nan"),
    (lambda s: s.push((0, 0), float("inf")), "depth_mm: got inf"),
    (lambda s: s.push((0, 0), np.ones((2, 2))), "depth_mm"),
    (lambda s: s.push((0, 0), to_mm=(1, 2)), r"expected \[x, y, z\]"),
    (lambda s: s.push((0, 0), 1, along=(0, 0, 0)), "no direction"),
    (lambda s: s.push((0, 0), 1, lateral='no"\n'), "lateral"),
    (lambda s: s.actuate(float("nan")), "progress: got nan"),
    (lambda s: s.actuate(-1), "progress"),
    (lambda s: s.actuate(radius_mm=1000), "larger than the footprint"),
    (lambda s: s.actuate(edge_points=[(10000, 0, 0, 1)]), "got edge point 10000"),
    (lambda s: s.release((0, 0)), "got no prescribed joint"),
    (lambda s: s.refine(-1), "above 0"),
    (lambda s: s.restore(small().save()), "another session"),
    (lambda s: gs.Session("s1_actuaton"), "did you mean 's1_actuation'"),
    (lambda s: gs.Session("s1_actuation", {"footprint.radus_mm": 82}), "did you mean 'radius_mm'"),
    (lambda s: gs.Session("s1_actuation", {"rod.diameter_mm": float("nan")}), "diameter_mm: got nan"),
    (lambda s: gs.Session("fig3_hemisphere", {"accuracy.model": "net", "accuracy.tolerance": 0.1}),
     "geometry alone"),
    (lambda s: gs.Session("s1_actuation", case="third"), "case: expected"),
    (lambda s: gs.Session("fig3_caps"), "case: expected one of"),
])
def test_mistakes_are_answered(formed, wrong, said):
    before = formed.nodes.copy()
    with pytest.raises(gs.BadInput, match=said):
        wrong(formed)
    assert isinstance(gs.BadInput("x"), gs.Error)
    assert isinstance(gs.BadInput("x"), ValueError)
    assert (formed.nodes == before).all() and formed.held == []


@pytest.mark.parametrize("wrong", [
    lambda s: s.push("corner", 1, 2), lambda s: s.push((0, 0), object()), lambda s: s.restore(None),
    lambda s: gs.Session(7), lambda s: gs.Session("s1_actuation", {7: 1}),
])
def test_wrong_types_are_type_errors(formed, wrong):
    with pytest.raises(TypeError):
        wrong(formed)


def test_a_fault_of_a_file_names_its_place(tmp_path):
    file = tmp_path / "small.toml"
    file.write_text('title = "x"\n[footprint]\nradus_mm = 82.0\n')
    with pytest.raises(gs.BadInput, match=r"small.toml:3:1: \[footprint\] radus_mm: unknown key"):
        gs.Session(file)


def test_a_path_that_ends_early_raises_and_stays_certified(formed):
    kept = formed.save()
    with pytest.raises(gs.NoEquilibrium, match="the limit of the strain or of a push's stiffness"):
        formed.push((0, 0), -60)
    assert formed.certificate.residual_N < 1e-5 and formed.held == [(0, 0)]
    formed.restore(kept)


def large():
    """A shell whose actuation takes more than ten seconds."""
    return gs.Session("s1_actuation", {"accuracy.tolerance": 1e-6, "footprint.rods": 24,
                                       "footprint.radius_mm": 252, "actuation.radius_mm": 160})


def test_control_c_stops_a_step_and_the_state_stays():
    session = large()
    before = session.nodes.copy()
    threading.Timer(0.15, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        session.actuate()
    assert time.monotonic() - begin < 5
    assert (session.nodes == before).all() and session.progress == 0


def test_what_a_handler_raises_comes_out():
    def handler(*_):
        raise RuntimeError("enough")
    session = large()
    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        begin = time.monotonic()
        with pytest.raises(RuntimeError, match="enough"):
            session.actuate()
        assert time.monotonic() - begin < 5 and session.progress == 0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_other_threads_run_meanwhile_and_are_kept_out():
    session = small(accuracy__tolerance=1e-5)
    seen = {"steps": 0, "refused": 0}
    done = threading.Event()

    def other():
        while not done.is_set():
            seen["steps"] += session.nodes.shape[1] == 3
            try:
                session.save()
            except RuntimeError:
                seen["refused"] += 1
            time.sleep(1e-4)
    thread = threading.Thread(target=other)
    thread.start()
    session.actuate()
    done.set()
    thread.join()
    assert seen["steps"] > 3 and seen["refused"] > 0


def test_the_example_draws_a_picture_in_moments(python, example, tmp_path):
    picture = tmp_path / "a.png"
    begin = time.monotonic()
    subprocess.run([python, example, picture], check=True, stdout=subprocess.DEVNULL, timeout=60)
    seconds = time.monotonic() - begin
    head = picture.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    assert [int.from_bytes(head[k:k + 4], "big") for k in (16, 20)] == [1280, 720]
    # the example takes two seconds on an idle machine, and longer on a busy one
    assert seconds < 30


def test_a_picture_that_cannot_be_written_says_so(formed, tmp_path):
    with pytest.raises(gs.IOFailure, match="nowhere"):
        formed.picture(tmp_path / "nowhere" / "a.png", size=(64, 48))
    with pytest.raises(gs.Error):
        formed.picture(tmp_path / "a.png", size=(0, -3))
    assert isinstance(gs.IOFailure("x"), OSError) and os.listdir(tmp_path) == []
