"""The picture at the head of the README: loops, a worn tip, a shaken mass."""

import ball
import numpy as np
import shaken_mass
import worn_tip
from plotting import BLUE, GIGA, GREY, INK, MICRO, figure, save_picture, shades


def draw(loops, lives, motion, envelope, path):
    """Four panels from the three cases of the demo."""
    fig, axes = figure(2, 2, figsize=(10.5, 7.2))
    draw_loops(axes[0, 0], loops)
    draw_tip(axes[0, 1], axes[1, 0], lives[0])
    draw_motion(axes[1, 1], motion, envelope)
    return save_picture(fig, path)


def draw_loops(axes, loops):
    for loop, colour in zip(loops.values(), ball.COLOURS):
        every = slice(None, None, max(1, loop["force"].size // 25))
        axes.plot(loop["displacement"] * MICRO, loop["force"], color=colour)
        axes.plot(loop["displacement"][every] * MICRO, loop["exact"][every], "o", ms=3.5, mfc="none", mec=INK, mew=0.7)
    axes.plot([], [], color=INK, label="FMU")
    axes.plot([], [], "o", ms=3.5, mfc="none", mec=INK, mew=0.7, label="closed form")
    axes.set(
        title="Stick and slip: steel ball, 10 mm, 100 N", xlabel="displacement (µm)", ylabel="tangential force (N)"
    )
    axes.legend(loc="lower right")


def draw_tip(shape, pressure, life):
    fields = life["fields"]
    reach = 1.12 * life["history"]["contact_radius"].max() * MICRO
    for state, colour in zip(fields, shades(len(fields))):
        radius = np.concatenate([-state["radius"][::-1], state["radius"]]) * MICRO
        height = (state["unworn"] + state["worn"]) * MICRO
        shape.plot(radius, np.concatenate([height[::-1], height]), color=colour, label=f"{state['cycles']:,.0f}")
        values = state["pressure"] * GIGA
        pressure.plot(radius, np.concatenate([values[::-1], values]), color=colour)
    amplitude = life["regime"].amplitude * MICRO
    shape.set(
        title=f"Fretting wear of a measured tip, ±{amplitude:g} µm",
        xlabel="radius (µm)",
        ylabel="height (µm)",
        xlim=(-reach, reach),
    )
    shape.set_ylim(
        0, 1.05 * np.interp(reach, fields[-1]["radius"] * MICRO, (fields[-1]["unworn"] + fields[-1]["worn"]) * MICRO)
    )
    shape.legend(loc="upper center", title="cycles")
    pressure.set(title="Its contact pressure", xlabel="radius (µm)", ylabel="pressure (GPa)", xlim=(-reach, reach))
    worn_tip.limit_pressure(pressure, fields)


def draw_motion(axes, motion, envelope):
    period = (np.arange(envelope.size) + 0.5) / shaken_mass.RIG.frequency
    axes.fill_between(period, -envelope * MICRO, envelope * MICRO, color=BLUE, alpha=0.25, lw=0)
    axes.plot(period, envelope * MICRO, color=BLUE)
    axes.plot(period, -envelope * MICRO, color=BLUE)
    axes.axhline(0, color=GREY, lw=0.8)
    axes.set(
        title="A shaken mass whose friction joint wears",
        xlabel="time (s)",
        ylabel="amplitude (µm)",
        xlim=(0, motion["time"][-1]),
    )
