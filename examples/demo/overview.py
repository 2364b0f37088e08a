"""The picture at the head of the README: loops, a worn tip, a shaken mass."""

import ball
import numpy as np
import shaken_mass
import worn_tip
from plotting import BLUE, GIGA, INK, MICRO, figure, save_picture, shades


def draw(loops, lives, motion, envelope, path):
    """Four panels from the three cases of the demo."""
    fig, axes = figure(2, 2, figsize=(10.5, 7.2))
    draw_loops(axes[0, 0], loops)
    draw_tip(axes[0, 1], axes[1, 0], lives[0])
    draw_motion(axes[1, 1], motion, envelope)
    return save_picture(fig, path)


def draw_loops(axes, loops):
    for (theta, loop), colour in zip(loops.items(), ball.COLOURS):
        every = slice(None, None, max(1, loop["force"].size // 25))
        axes.plot(loop["displacement"] * MICRO, loop["force"], color=colour, label=f"{theta:g}")
        axes.plot(
            loop["displacement"][every] * MICRO,
            loop["exact"][every],
            "o",
            ms=3.5,
            mfc="none",
            mec=INK,
            mew=0.7,
        )
    axes.plot([], [], "o", ms=3.5, mfc="none", mec=INK, mew=0.7, label="closed form")
    axes.set(
        title="Steel ball, R = 10 mm, μ = 0.6, 100 N: FMU",
        xlabel="displacement (µm)",
        ylabel="tangential force (N)",
    )
    axes.set_xlim(right=6.4)
    axes.legend(loc="lower right", title="amplitude / u_max")


def draw_tip(shape, pressure, life):
    fields = life["fields"]
    reach = 1.12 * life["history"]["contact_radius"].max() * MICRO
    for state, colour in zip(fields, shades(len(fields))):
        radius = np.concatenate([-state["radius"][::-1], state["radius"]]) * MICRO
        height = (state["unworn"] + state["worn"]) * MICRO
        shape.plot(
            radius,
            np.concatenate([height[::-1], height]),
            color=colour,
            label=f"{state['cycles']:,.0f}",
        )
        values = state["pressure"] * GIGA
        pressure.plot(
            radius,
            np.concatenate([values[::-1], values]),
            color=colour,
            label=f"{state['cycles']:,.0f}",
        )
    amplitude = life["regime"].amplitude * MICRO
    shape.set(
        title=f"Synthetic worn tip, R = 10 mm, ±{amplitude:g} µm",
        xlabel="radius (µm)",
        ylabel="height (µm)",
        xlim=(-reach, reach),
    )
    shape.set_ylim(
        0,
        1.05
        * np.interp(
            reach, fields[-1]["radius"] * MICRO, (fields[-1]["unworn"] + fields[-1]["worn"]) * MICRO
        ),
    )
    shape.legend(loc="upper center", title="cycles")
    pressure.legend(loc="lower center", title="cycles", ncols=2)
    pressure.set(
        title="Its contact pressure, 100 N, μ = 0.6",
        xlabel="radius (µm)",
        ylabel="pressure (GPa)",
        xlim=(-reach, reach),
    )
    worn_tip.limit_pressure(pressure, fields)


def draw_motion(axes, motion, envelope):
    period = (np.arange(envelope.size) + 0.5) / shaken_mass.RIG.frequency
    axes.plot(period, envelope * MICRO, color=BLUE, label="half of the peak-to-peak displacement")
    axes.legend(loc="lower right")
    axes.set(
        title="Shaken mass, wearing ball joint (μ = 0.6)",
        xlabel="time (s)",
        ylabel="amplitude (µm)",
        xlim=(0, motion["time"][-1]),
        ylim=(0, None),
    )
