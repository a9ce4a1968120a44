"""Make the pictures of the README: ``python docs/make_images.py``."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

import engdyn as ed
from engdyn.plots.look import new_figure, style

HERE = Path(__file__).parent / "images"


def gantry_crane_equilibria() -> None:
    """All equilibria of the gantry crane, at rest and in a wind of 5 kN."""
    crane = ed.systems.load("gantry_crane")
    figure = new_figure(9.0, 5.2)
    with style():
        axes = figure.subplots(1, 2)
        for ax, wind, title in ((axes[0], 0.0, "still air"), (axes[1], 5000.0, "wind of 5 kN")):
            balance = {"F": -wind, "W": wind}  # the drive holds the trolley against the wind
            ed.plots.equilibrium_poses(crane, crane.equilibria(**balance), ax=ax)
            ax.set_title(title)
    figure.savefig(HERE / "gantry_crane_equilibria.png", dpi=90)


def flyball_governor_branches() -> None:
    """The pitchfork of the flyball governor over the spindle speed."""
    governor = ed.systems.load("flyball_governor")
    branches = governor.branches("Omega", (0.0, 25.0))
    figure = new_figure(9.0, 4.6)
    with style():
        left, right = figure.subplots(1, 2, width_ratios=(1, 1.6))
        ed.plots.draw(governor, ax=left)
        ed.plots.branches(branches, "theta", right, system=governor)
    figure.savefig(HERE / "flyball_governor_branches.png", dpi=90)


def systems() -> None:
    """The whole catalogue on one page; a palette makes the file a third as large."""
    path = HERE / "systems.png"
    ed.plots.contact_sheet().savefig(path, dpi=75)
    with Image.open(path) as sheet:
        few = sheet.convert("RGB").quantize(255, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


if __name__ == "__main__":
    HERE.mkdir(exist_ok=True)
    gantry_crane_equilibria()
    flyball_governor_branches()
    systems()
