# SPDX-License-Identifier: Apache-2.0
"""Long work: progress, Ctrl-C, other threads of Python."""
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import spheretree
from conftest import ball


def test_progress_never_falls_and_ends_at_one():
    seen = []
    threads = set()

    def progress(done, stage):
        seen.append((done, stage))
        threads.add(threading.get_ident())

    spheretree.build(ball(40), [256, 64, 8], progress=progress)
    fractions = [done for done, _ in seen]
    assert fractions == sorted(fractions) and fractions[-1] == 1 and 0 <= fractions[0]
    assert threads == {threading.get_ident()}
    assert all(isinstance(stage, str) for _, stage in seen)


def test_an_exception_of_progress_stops_the_work_and_comes_out():
    class Enough(Exception):
        pass

    def progress(done, stage):
        raise Enough(stage)

    with pytest.raises(Enough):
        spheretree.build(ball(60), [512, 64, 8], quality="best", progress=progress)
    assert spheretree.build(ball(5), [1], progress=None)  # and all goes on


def test_ctrl_c_is_a_keyboard_interrupt():
    """Of work that takes minutes: who waits for its end instead is too late."""
    program = """
import signal
import numpy, spheretree
signal.signal(signal.SIGINT, signal.default_int_handler)  # whatever the tests run under
v = numpy.indices((90,) * 3).sum(axis=0) % 7 < 4
print("begins", flush=True)
try:
    spheretree.build(v, [4096, 512], quality="best")
except KeyboardInterrupt:
    print("interrupted", spheretree.build(v[:9, :9, :9], [1]) is not None)
"""
    run = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert run.stdout.readline() == "begins\n"
    time.sleep(0.3)
    run.send_signal(signal.SIGINT)
    assert run.communicate(timeout=60)[0] == "interrupted True\n" and run.returncode == 0


def test_ctrl_c_stops_the_reading_of_a_mesh(tmp_path):
    """Of polygons that take minutes to cut into triangles: a zigzag below a parabola, again and again."""
    corners, faces = 2000, 10000
    points = np.zeros((corners, 3), "<f4")
    points[:, 0] = np.arange(corners)
    points[::2, 1] = np.arange(0, corners, 2) ** 2
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {corners}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {faces}\nproperty list ushort ushort vertex_indices\nend_header\n")
    face = np.array([corners, *range(corners)], "<u2")
    (tmp_path / "slow.ply").write_bytes(header.encode() + points.tobytes() + np.tile(face, faces).tobytes())
    program = """
import signal, sys
import spheretree
signal.signal(signal.SIGINT, signal.default_int_handler)
print("begins", flush=True)
try:
    spheretree.volume(sys.argv[1])
except KeyboardInterrupt:
    print("interrupted")
"""
    run = subprocess.Popen([sys.executable, "-c", program, tmp_path / "slow.ply"], stdout=subprocess.PIPE, text=True)
    assert run.stdout.readline() == "begins\n"
    time.sleep(0.5)
    run.send_signal(signal.SIGINT)
    try:
        assert run.communicate(timeout=20)[0] == "interrupted\n" and run.returncode == 0
    finally:
        run.kill()


def test_other_threads_of_python_go_on_meanwhile():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.005):
            ticks.append(None)

    other = threading.Thread(target=tick)
    other.start()
    begin = time.perf_counter()
    spheretree.build(ball(40), [256, 64, 8])
    seconds = time.perf_counter() - begin
    done.set()
    other.join()
    assert len(ticks) > seconds / 0.5  # two a second: of 200, on a machine that is busy


def test_several_threads_of_python_build_at_once(bone):
    expected = spheretree.build(bone, [32, 4]).centers
    results = [None] * 4

    def work(i):
        results[i] = spheretree.build(bone, [32, 4], progress=lambda done, stage: None).centers

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(result, expected) for result in results)


def test_too_little_memory_is_said_and_python_lives_on(bone):
    with pytest.raises(spheretree.InputError, match="memory"):
        spheretree.build(np.ones((200, 200, 200), bool), [1000], memory="1MB")
    assert spheretree.build(bone, [4])


@pytest.mark.parametrize("threads", [0, 1025, 10**7, 2**31 - 1, 2**70])
def test_more_threads_than_the_command_takes_are_refused(bone, threads):
    with pytest.raises(spheretree.InputError, match="1 to 1024"):
        spheretree.build(bone, [64, 8], threads=threads)


@pytest.mark.parametrize("name", ["Tree", "Volume", "Query"])
def test_a_handle_that_nobody_has_made_is_refused(name):
    handle = getattr(spheretree._spheretree, name)
    for make in (handle, lambda: handle.__new__(handle), lambda: handle.__mro__[1].__new__(handle),
                 lambda: object.__new__(handle), lambda: type("Mine", (handle,), {})()):
        with pytest.raises(TypeError):
            make()
