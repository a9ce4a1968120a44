"""Animations: the right pose at the right time, a frame that stands still, files that anybody can open."""

from __future__ import annotations

import base64
import io
import json
import math
import re
import subprocess
import sys
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from PIL import Image
from scipy.integrate import solve_ivp

import engdyn as ed
from engdyn import EngdynError, shapes
from engdyn.plots import films
from engdyn.plots.animation import Animation
from engdyn.plots.look import new_axes
from engdyn.plots.motion import checked_motion, shown_speed
from engdyn.plots.projection import box_faces
from engdyn.plots.stage import lasting_ground
from engdyn.plots.strobe import apart

BODY = np.array([0xD3, 0xE3, 0xEE])

STARTS = {
    "S07": ([0.0, 0.6], [0.0, 0.0]),
    "S03": ([0.5], [0.0]),
    "S23": ([0.1, 0.05, -0.02, 0.03], [0.0] * 4),
    "W5": ([0.0, 0.5, 0.0], [0.0, 0.0, 150.0]),
}


@cache
def system(key):
    return ed.systems.load(key)


@cache
def history(key, duration=1.0):
    one, (q, u) = system(key), STARTS[key]
    f = one.equations.function(one.values())
    run = solve_ivp(lambda t, x: f(t, x), (0.0, duration), [*q, *u], rtol=1e-8, atol=1e-10)
    return SimpleNamespace(time=run.t, q=run.y[: len(q)].T)


@cache
def moving(key):
    """An animation of 26 frames, as what is shown of it costs time."""
    return ed.plots.animate(system(key), history(key), speed=1.0)


def sliding(*positions, speed=1.0):
    """The crane with its payload hanging straight down, at one position per second."""
    x = np.array(positions, float)
    return ed.plots.animate(system("S07"), (np.arange(len(x)), np.column_stack([x, 0.0 * x])), speed=speed)


def filled(picture):
    """Center of the bodies in pixels: (right, down)."""
    rows, columns = np.nonzero(np.max(abs(picture.astype(int) - BODY), axis=-1) < 3)
    return columns.mean(), rows.mean()


def rim(picture):
    return np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])


# Poses and times


def test_frames_follow_real_time_whatever_the_steps_of_the_solver():
    animation = moving("S07")
    assert len(history("S07").time) < 40
    assert len(animation) == 26
    assert np.diff(animation.time) == pytest.approx(np.full(25, 0.04))
    assert animation.time[[0, -1]] == pytest.approx([0.0, 1.0])


def test_poses_between_the_steps_are_interpolated():
    time = np.array([0.0, 0.1, 0.13, 0.7, 1.0])
    q = np.column_stack([3.0 * time - 1.0, 0.5 * time])
    animation = ed.plots.animate(system("S07"), (time, q), speed=1.0)
    assert animation.q == pytest.approx(np.column_stack([3.0 * animation.time - 1.0, 0.5 * animation.time]))


def test_a_body_that_moves_steadily_moves_steadily_in_the_picture():
    animation = sliding(0.0, 2.0, 4.0)
    start, middle, end = (np.array(filled(animation.frame(k))) for k in (0, 25, 50))
    assert end[0] - start[0] > 50.0
    assert middle - start == pytest.approx(end - middle, abs=0.3)
    assert (end - start)[1] == pytest.approx(0.0, abs=0.1)


def test_the_picture_is_that_of_the_pose():
    # Mirror images: theta and -theta put the payload at equal distances right and left of the cable's pin.
    time, theta = np.array([0.0, 1.0, 2.0]), np.array([0.4, 0.0, -0.4])
    animation = ed.plots.animate(system("S07"), (time, np.column_stack([0.0 * theta, theta])), speed=1.0)
    right, down, left = (filled(animation.frame(k)) for k in (0, 25, 50))
    assert right[0] - down[0] > 20.0
    assert right[0] - down[0] == pytest.approx(down[0] - left[0], abs=0.5)
    assert right[1] == pytest.approx(left[1], abs=0.5)
    assert right[1] < down[1] - 3.0


@pytest.mark.parametrize("key", STARTS)
def test_nothing_leaves_the_page_and_the_page_stays(key):
    animation = moving(key)
    pictures = [animation.frame(k) for k in range(0, len(animation), 5)]
    assert len({picture.shape for picture in pictures}) == 1
    assert all(np.all(rim(picture) == 255) for picture in pictures)
    assert any(np.any(picture != pictures[0]) for picture in pictures[1:])


def test_the_ground_stands_still():
    animation = sliding(0.0, 2.5, 5.0)
    gray = np.array([0x5A, 0x5F, 0x66])
    grounds = [np.all(animation.frame(k) == gray, axis=-1) for k in (0, 20, 50)]
    rows = [np.argmax(ground.sum(axis=1)) for ground in grounds]
    assert len(set(rows)) == 1
    ends = {tuple(np.nonzero(ground[rows[0]])[0][[0, -1]]) for ground in grounds}
    assert len(ends) == 1, "the drawing ends its rail near the trolley; the film must not"


def test_a_reused_figure_keeps_no_trace_of_other_frames():
    fresh = sliding(0.0, 1.0).frame(10)
    animation = sliding(0.0, 1.0)
    for k in (3, 20, 0):
        animation.frame(k)
    assert np.array_equal(animation.frame(10), fresh)
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(animation.png(10)))), fresh)


def test_the_picture_shows_the_time():
    # Nothing moves but the clock, above everything else.
    time = np.array([0.0, 1.0])
    animation = ed.plots.animate(system("S03"), (time, np.full((2, 1), 0.7)), speed=1.0)
    a, b = animation._picture(0.0), animation._picture(0.5)
    rows = np.nonzero(np.any(a != b, axis=(1, 2)))[0]
    assert len(rows)
    assert rows.max() < 27


def test_frames_are_quick():
    from time import perf_counter

    animation = moving("S23")
    animation.frame(0)
    took = []
    for k in range(1, 12):
        start = perf_counter()
        animation.frame(k)
        took.append(perf_counter() - start)
    assert min(took) < 0.06


def test_systems_in_space_are_seen_from_the_chosen_side():
    from_above = ed.plots.animate(
        system("W5"), history("W5"), speed=1.0, view=ed.plots.View(0.0, math.pi / 2)
    )
    assert from_above.frame(5).shape != moving("W5").frame(5).shape


# Speed


@pytest.mark.parametrize(
    ("duration", "speed"),
    [
        (2.0, 1.0),
        (60.0, 1.0),
        (1.9, 0.5),
        (0.1, 0.05),
        (0.4, 0.2),
        (61.0, 2.0),
        (600.0, 10.0),
        (0.00123, 5e-4),
    ],
)
def test_a_film_lasts_neither_too_short_nor_too_long(duration, speed):
    assert shown_speed(duration) == pytest.approx(speed)
    assert 2.0 <= duration / shown_speed(duration) <= 60.0


def test_slow_motion_has_more_frames_and_says_so():
    slow = ed.plots.animate(system("S07"), history("S07"), speed=0.25)
    assert len(slow) == 101
    assert "0.25 × real time" in slow.words
    assert "shown in real time" in moving("S07").words


def test_the_last_pose_is_shown_and_a_closed_motion_has_no_frame_twice():
    odd = ed.plots.animate(system("S07"), ([0.0, 1.013], [[0.0, 0.1], [1.0, 0.0]]), speed=1.0)
    assert odd.q[-1] == pytest.approx([1.0, 0.0])
    assert not odd.repeats
    period = ed.plots.animate(system("S07"), ed.plots.mode_motion([0.0, 0.0], [0.0, 1.0], 0.5))
    assert period.repeats
    assert len(period) == 50
    assert period.time[-1] == pytest.approx(2.0 - 0.04)


# Modes


def linearized(key="W7"):
    one = system(key)
    at = one.equilibria()[0]
    return one, at, ed.linearize(one.equations, at)


def test_a_mode_is_a_free_vibration_of_the_undamped_linear_system():
    one, at, linear = linearized()
    squares, vectors = np.linalg.eig(np.linalg.solve(linear.mass, linear.stiffness))
    for square, phi in zip(squares, vectors.T, strict=True):
        time, q = ed.plots.mode_motion(at.q, phi, math.sqrt(square) / (2.0 * math.pi), system=one)
        acceleration = (q[2:] - 2.0 * q[1:-1] + q[:-2]) / (time[1] - time[0]) ** 2
        force = (q[1:-1] - at.q) @ linear.stiffness.T
        assert acceleration @ linear.mass.T == pytest.approx(-force, rel=2e-3, abs=2e-3 * np.max(abs(force)))
        assert time[-1] == pytest.approx(2.0 * math.pi / math.sqrt(square))
        assert np.array_equal(q[0], q[-1])


def test_a_complex_mode_shows_its_phases():
    one, at, linear = linearized()
    eigenvalues, vectors = np.linalg.eig(linear.state_matrix)
    k = int(np.argmax(eigenvalues.imag))
    _, q = ed.plots.mode_motion(at.q, vectors[:, k], abs(eigenvalues[k]) / (2.0 * math.pi), system=one)
    harmonic = np.fft.rfft(q[:-1] - at.q, axis=0)[1]
    expected = vectors[: len(at.q), k]
    assert harmonic[1] / harmonic[0] == pytest.approx(expected[1] / expected[0], rel=1e-9)
    assert abs((expected[1] / expected[0]).imag) > 1e-3, "the case must be a complex one"
    largest = int(np.argmax(abs(expected)))
    assert q[0, largest] - at.q[largest] == pytest.approx(np.max(abs(q - at.q)))


@pytest.mark.parametrize("key", ["W7", "S07", "S23"])
def test_the_amplitude_can_be_seen_and_stays_within_bounds(key):
    one = system(key)
    pose = np.array([0.0] * len(one.coordinates))
    for i, coordinate in enumerate(one.coordinates):
        shape = np.zeros(len(pose))
        shape[i] = -7.0
        _, q = ed.plots.mode_motion(pose, shape, 1.0, system=one)
        low, high = coordinate.bounds or (-np.inf, np.inf)
        assert low < q[:, i].min() < q[:, i].max() < high
        assert q[:, i].max() > (0.1 if coordinate.unit == "rad" else 0.02)
    _, q = ed.plots.mode_motion(pose, np.ones(len(pose)), 1.0, amplitude=0.01)
    assert np.max(q) == pytest.approx(0.01)


def test_narrow_bounds_do_not_hide_a_mode():
    one = system("S10")
    q0 = [c.bounds[1] - 1e-3 for c in one.coordinates]
    animation = ed.plots.animate(one, ed.plots.mode_motion(q0, [1.0, 1.0], 0.5, system=one))
    up, down = (filled(animation.frame(k))[1] for k in (0, 25))
    assert down - up > 8.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.0, 0.0], [1.0], 1.0), "shape"),
        (([0.0, 0.0], [1.0, np.nan], 1.0), "not finite"),
        (([0.0, 0.0], [0.0, 0.0], 1.0), "nothing moves"),
        (([0.0, 0.0], [1.0, 0.0], 0.0), "above 0 Hz"),
        (([0.0, 0.0], [1.0, 0.0], 2.0 + 1.0j), "above 0 Hz"),
        (([0.0, 0.0], [1.0, 0.0], np.nan), "above 0 Hz"),
    ],
)
def test_what_is_no_mode_is_refused(arguments, message):
    with pytest.raises(EngdynError, match=message):
        ed.plots.mode_motion(*arguments)


def test_an_amplitude_must_be_positive():
    with pytest.raises(EngdynError, match="amplitude"):
        ed.plots.mode_motion([0.0], [1.0], 1.0, amplitude=-1.0)


# What is refused

GOOD = np.zeros((3, 2))


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        (([0.0, 1.0, 1.0], GOOD), r"must increase, but 1 s follows 1 s \(entry 2\)"),
        (([0.0, 2.0, 1.0], GOOD), "must increase"),
        (([0.0, 1.0, np.nan], GOOD), "time 2 of the motion is not finite"),
        (([0.0], GOOD[:1]), "two times or more"),
        (([0.0, 1.0, 2.0], np.zeros((3, 3))), r"ask for\s+\(3, 2\)"),
        (([0.0, 1.0, 2.0], np.zeros((3, 4))), r"x\[:, :2\]"),
        (([0.0, 1.0, 2.0], GOOD.T), r"give q\.T"),
        (([0.0, 1.0, 2.0], np.zeros(3)), "shape"),
        (([0.0, 1.0, 2.0], [[0, 0], [0, np.inf], [0, 0]]), "theta = inf at t = 1 s"),
        (([0.0, 1.0, 2.0], [[0, 0], [0, 1j], [0, 0]]), "no real number"),
        ((["a", "b", "c"], GOOD), "no real number"),
        (GOOD, "no motion"),
        (None, "no motion"),
    ],
)
def test_what_is_no_motion_of_the_system_is_refused(motion, message):
    with pytest.raises(EngdynError, match=message):
        ed.plots.animate(system("S07"), motion)


def test_one_coordinate_may_come_as_a_row_of_numbers():
    assert checked_motion(system("S03"), ([0.0, 1.0], [0.5, 0.6])).q.shape == (2, 1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0.0}, "speed"),
        ({"speed": math.nan}, "speed"),
        ({"rate": 0.0}, "rate"),
        ({"rate": 1000.0}, "rate"),
        ({"speed": 1e-6}, "choose a speed of 0.0017 or more"),
        ({"values": {"L": -1.0}}, "greater than zero"),
    ],
)
def test_options_without_sense_are_refused(options, message):
    with pytest.raises(EngdynError, match=message):
        ed.plots.animate(system("S07"), history("S07"), **options)


def test_a_frame_that_does_not_exist_is_refused():
    with pytest.raises(EngdynError, match="frames 0 to 25"):
        moving("S07").frame(26)
    assert np.array_equal(moving("S07").frame(-1), moving("S07").frame(25))


# The strobe picture


def test_a_strobe_shows_poses_from_faint_to_strong_and_tells_them():
    ax = moving("S07").strobe(poses=4)
    bodies = sorted(
        (c for c in ax.collections if isinstance(c, PolyCollection)), key=lambda c: c.get_zorder()
    )
    opacity = [c.get_facecolor()[0, 3] for c in bodies]
    assert opacity == sorted(opacity)
    assert len(set(opacity)) == 4
    assert opacity[-1] == 1.0
    words = ed.plots.alt(ax)
    assert words.startswith("Strobe picture, 4 poses")
    assert "theta begins at 0.600" in words
    assert "t = 0.00 s to 1.00 s" in words


def test_a_strobe_at_chosen_times_shows_those_poses_in_given_axes():
    own, times = new_axes(), [0.1, 0.5, 0.93]
    assert moving("S07").strobe(own, poses=times) is own
    drawn = [path.vertices for c in own.collections for path in c.get_paths()]
    for time in times:
        q = [np.interp(time, history("S07").time, column) for column in history("S07").q.T]
        boxes = [shape for shape in system("S07").shapes(q) if isinstance(shape, shapes.Box)]
        assert boxes
        for box in boxes:
            corners = box_faces(box)[0]
            assert any(len(v) >= 4 and np.allclose(v[:4], corners, atol=1e-9) for v in drawn)
    assert own.get_title(loc="left") == "t = 0.10 s … 0.93 s"


def test_poses_of_a_strobe_lie_apart_even_if_the_motion_repeats():
    angle = np.linspace(0.0, 12.0 * math.pi, 601)
    features = np.column_stack([np.cos(angle), np.sin(angle)])
    chosen = apart(features, 6)
    assert chosen == sorted(set(chosen))
    assert chosen[0] == 0
    gaps = np.linalg.norm(features[chosen][:, None] - features[chosen][None], axis=-1)
    inner = gaps[:-1, :-1][~np.eye(len(chosen) - 1, dtype=bool)]
    assert inner.min() > 0.5
    assert apart(np.zeros((50, 2)), 5) == [0, 49]
    assert apart(features, 1) == [0]


@pytest.mark.parametrize("poses", [0, [], [0.0, 1.5], [-0.1], [math.nan]])
def test_poses_that_do_not_exist_are_refused(poses):
    with pytest.raises(EngdynError, match="poses"):
        moving("S07").strobe(poses=poses)


def test_ground_that_grows_is_shown_at_its_longest_and_ground_that_moves_is_left_alone():
    def drawing(end, height):
        return [shapes.Ground((0.0, 0.0), (end, 0.0)), shapes.Ground((0.0, height), (1.0, height))]

    found = lasting_ground([drawing(2.0, 0.0), drawing(3.5, 0.2), drawing(1.0, 0.4)])
    assert list(found) == [0]
    assert found[0].end == pytest.approx((3.5, 0.0))
    assert lasting_ground([drawing(2.0, 0.0), drawing(2.0, 0.0)[:1]]) == {}


# Files


@cache
def short():
    """Six frames."""
    return sliding(0.0, 2.0, speed=5.0)


def opened(path):
    image = Image.open(path)
    frames, durations = [], []
    for k in range(image.n_frames):
        image.seek(k)
        frames.append(np.asarray(image.convert("RGB"), int))
        durations.append(image.info["duration"])
    return image, frames, durations


def test_a_gif_holds_the_frames_at_their_pace(tmp_path):
    slow = sliding(0.0, 1.0, speed=3.0)
    assert len(slow) == 9
    image, frames, durations = opened(slow.save(tmp_path / "film.gif"))
    assert len(frames) == len(slow)
    for k, frame in enumerate(frames):
        wanted = slow.frame(k).astype(int)
        assert np.max(abs(frame - wanted)) < 40
        plain = np.all(wanted == 255, axis=-1) | np.all(wanted == BODY, axis=-1)
        assert np.array_equal(frame[plain], wanted[plain])
    # A frame of 41.7 ms cannot be told in hundredths of a second; the sum of all can.
    assert sum(durations) == pytest.approx(1000.0 / 3.0 * 9.0 / 8.0, abs=5.0)
    assert image.info["loop"] == 0
    assert image.info["comment"].decode() == slow.words


@pytest.mark.parametrize("name", ["film.gif", "film.html"])
def test_the_same_film_is_the_same_file(tmp_path, name):
    first = short().save(tmp_path / name).read_bytes()
    again = sliding(0.0, 2.0, speed=5.0).save(tmp_path / name, overwrite=True).read_bytes()
    assert first == again


def test_a_page_holds_everything_it_needs(tmp_path):
    page = short().save(tmp_path / "film.html").read_text("utf-8")
    assert not re.search(r"(src|href)\s*=\s*[\"'](?!data:)|https?://|@import|url\(", page)
    pictures = json.loads(re.search(r"pictures = (\[.*?\]), ends", page).group(1))
    assert len(pictures) == len(short())
    last = np.asarray(Image.open(io.BytesIO(base64.b64decode(pictures[-1]))).convert("RGB"), int)
    assert np.max(abs(last - short().frame(-1))) < 40
    ends = json.loads(re.search(r"ends = (\[.*?\])", page).group(1))
    assert ends == pytest.approx(0.04 * np.arange(7))
    for part in ('<html lang="en">', "<button", 'type="range"', "<label", 'alt="Gantry crane', "<title>"):
        assert part in page
    assert "autoplay" not in page


@pytest.mark.parametrize("name", ["film.gif", "film.html", "film.mp4"])
def test_a_file_that_exists_is_not_touched(tmp_path, name):
    target = tmp_path / name
    target.write_text("mine")
    with pytest.raises(EngdynError, match="not touched"):
        short().save(target)
    assert target.read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("name", ["film.avi", "film", "nowhere/film.gif"])
def test_a_file_that_cannot_be_written_is_refused(tmp_path, name):
    with pytest.raises(EngdynError, match=r"\.gif|does not exist"):
        short().save(tmp_path / name)


def test_a_film_that_fails_leaves_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.setattr(Animation, "frame", lambda self, k: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        short().save(tmp_path / "film.gif")
    assert list(tmp_path.iterdir()) == []


def test_mp4_without_ffmpeg_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(EngdynError, match=r"ffmpeg.*apt install ffmpeg.*\.html or \.gif"):
        short().save(tmp_path / "film.mp4")


def program(folder, text):
    """Put a stand-in for ffmpeg onto the path: what counts here is what it is handed."""
    target = folder / "ffmpeg"
    target.write_text(f"#!{sys.executable}\nimport sys\n{text}")
    target.chmod(0o755)
    return str(folder)


def test_mp4_hands_all_pixels_to_ffmpeg(tmp_path, monkeypatch):
    copy = "open(sys.argv[-1], 'wb').write(repr(sys.argv).encode() + b'|' + sys.stdin.buffer.read())"
    monkeypatch.setenv("PATH", program(tmp_path, copy))
    arguments, _, pixels = short().save(tmp_path / "film.mp4").read_bytes().partition(b"|")
    height, width, _ = short().frame(0).shape
    wanted = b"".join(short().frame(k).tobytes() for k in range(len(short())))
    assert pixels == wanted
    assert f"'{width}x{height}', '-framerate', '25'".encode() in arguments


def test_mp4_tells_what_ffmpeg_complains_about(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", program(tmp_path, "print('no encoder', file=sys.stderr); sys.exit(3)"))
    with pytest.raises(EngdynError, match="no encoder"):
        short().save(tmp_path / "film.mp4")
    assert not (tmp_path / "film.mp4").exists()


def test_a_real_ffmpeg_writes_a_film(tmp_path):
    import shutil

    if shutil.which("ffmpeg") is None:
        pytest.skip("no ffmpeg; on Debian: apt install ffmpeg")
    path = short().save(tmp_path / "film.mp4")
    told = subprocess.run(["ffmpeg", "-i", str(path)], capture_output=True, text=True, check=False).stderr
    assert "h264" in told
    assert "25 fps" in told


@pytest.mark.parametrize(("watched", "patience"), [(True, -1.0), (True, 1e9), (False, -1.0)])
def test_progress_is_told_to_those_who_watch_and_wait(tmp_path, monkeypatch, capsys, watched, patience):
    monkeypatch.setattr(films, "UNSEEN", patience)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: watched)
    short().save(tmp_path / "film.gif")
    out, err = capsys.readouterr()
    assert out == ""
    assert ("frame 6 of 6" in err) == (watched and patience < 0.0)
    assert bool(err) == (watched and patience < 0.0)


@pytest.mark.parametrize(("pose", "shape"), [([0, "a"], [1, 0]), ([0, 0], [[1], [1, 2]])])
def test_a_mode_of_what_are_no_numbers_is_refused(pose, shape):
    with pytest.raises(ed.EngdynError, match="must be numbers"):
        ed.plots.mode_motion(pose, shape, 1.0, system=ed.systems.load("S07"))
