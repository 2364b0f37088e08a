"""Case (a): a steel ball on a steel flat: partial slip, gross slip, and a load that varies.

Wear is switched off here, so that the loops can be laid over the closed forms.
"""

import numpy as np
from fretting_contact.component import ContactFmu
from outcome import Headline, Outcome
from plotting import (
    BLUE,
    GIGA,
    GREEN,
    GREY,
    INK,
    MICRO,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    figure,
    save_picture,
    save_table,
    shades,
)
from theory import Sphere

SPHERE = Sphere()
THETAS = (0.25, 0.5, 0.75, 1.0, 1.5)  # amplitude / displacement at which sliding begins
COLOURS = (SKY, BLUE, GREEN, ORANGE, RED)
PHASES = (
    ("in phase", 0.0, BLUE),
    ("a quarter cycle ahead", np.pi / 2, ORANGE),
    ("in anti-phase", np.pi, PURPLE),
)
LOAD_SWING = 0.5  # share of the mean load by which it rises and falls
VARYING_THETA = 0.9
TRACTION_THETA = 0.75


def run(fmu, out, quick):
    """Runs the case, writes its files into the folder `out`."""
    steps = 80 if quick else 200
    outcome = Outcome("(a) ball on flat: loops")
    loops = {theta: constant_load_loop(fmu, theta, steps) for theta in THETAS}
    swings = {name: varying_load_loop(fmu, phase, steps) for name, phase, _ in PHASES}

    tractions = traction_fields(fmu)

    outcome.headlines += normal_headlines(fmu)
    for theta, loop in loops.items():
        exact = SPHERE.loop_work(theta * SPHERE.full_slip)
        outcome.headlines.append(
            Headline(
                f"friction work of a loop, θ = {theta:g}", loop["work"] * MICRO, "µJ", exact * MICRO
            )
        )
    worst = max(np.max(np.abs(loop["force"] - loop["exact"])) for loop in loops.values())
    outcome.headlines.append(
        Headline("largest error of T on any loop, of μF", worst / SPHERE.limit, "")
    )
    for name, swing in swings.items():
        work = np.trapezoid(
            swing["force"][-2 * steps - 1 :], swing["displacement"][-2 * steps - 1 :]
        )
        outcome.headlines.append(
            Headline(
                f"work of a cycle, load {name}: from the FMU, from ∮T dU",
                swing["work"] * MICRO,
                "µJ",
                work * MICRO,
            )
        )

    outcome.files.append(draw(loops, swings, tractions, steps, out / "ball_loops.png"))
    outcome.files.append(save_table(out / "ball_loops.csv", loop_table(loops)))
    outcome.files.append(save_table(out / "ball_varying_load.csv", swing_table(swings)))
    outcome.series = {"loops": loops}
    return outcome


def normal_headlines(fmu):
    """Contact radius, depth and peak pressure under the constant load, against Hertz."""
    with ContactFmu(fmu) as contact:
        contact.start(normal_force=SPHERE.normal_force)
        radius, depth, pressure = contact.get("contact_radius", "indentation_depth", "max_pressure")
    return [
        Headline("contact radius a", radius * MICRO, "µm", SPHERE.contact_radius * MICRO),
        Headline("indentation depth d", depth * MICRO, "µm", SPHERE.depth * MICRO),
        Headline("peak pressure p₀", pressure * 1e-9, "GPa", SPHERE.peak_pressure * 1e-9),
    ]


def constant_load_loop(fmu, theta, steps):
    """First loading to +U₀, then one closed loop back over −U₀."""
    amplitude = theta * SPHERE.full_slip
    back = np.linspace(amplitude, -amplitude, steps + 1)[1:]
    first = np.linspace(0, amplitude, steps // 2 + 1)
    with ContactFmu(fmu) as contact:
        contact.start(normal_force=SPHERE.normal_force, wear_coefficient=0.0)
        path = contact.follow(["tangential_force"], tangential_displacement=first[1:])
        before = contact.get("dissipated_energy")
        loop = contact.follow(
            ["tangential_force"], tangential_displacement=np.concatenate([back, -back])
        )
        work = contact.get("dissipated_energy") - before
    there = SPHERE.reversal(back, amplitude)
    return {
        "displacement": np.concatenate([first, back, -back]),
        "force": np.concatenate([[0.0], path["tangential_force"], loop["tangential_force"]]),
        "exact": np.concatenate([SPHERE.loading(first), there, -there]),
        "work": work,
    }


def varying_load_loop(fmu, phase, steps):
    """Three cycles of U = U₀ sin ωt, F = F₀ (1 + s sin(ωt + phase)); the last is periodic."""
    cycles = 3
    angle = np.linspace(0, 2 * np.pi * cycles, 2 * steps * cycles + 1)
    displacement = VARYING_THETA * SPHERE.full_slip * np.sin(angle)
    load = SPHERE.normal_force * (1 + LOAD_SWING * np.sin(angle + phase))
    names = ["tangential_force", "dissipated_energy", "stick_radius", "contact_radius"]
    with ContactFmu(fmu) as contact:
        contact.start(
            normal_force=load[0], tangential_displacement=displacement[0], wear_coefficient=0.0
        )
        start = contact.get(*names)
        result = contact.follow(
            names, normal_force=load[1:], tangential_displacement=displacement[1:]
        )
    states = {name: np.concatenate([[first], result[name]]) for name, first in zip(names, start)}
    return {
        "angle": angle,
        "displacement": displacement,
        "load": load,
        "force": states["tangential_force"],
        "stick": states["stick_radius"],
        "contact": states["contact_radius"],
        "work": states["dissipated_energy"][-1] - states["dissipated_energy"][-2 * steps - 1],
    }


def traction_fields(fmu):
    """Shear traction on the way back from +U₀ to −U₀: U/U₀ → (radii, τ, μp), m and Pa."""
    fields = {}
    amplitude = TRACTION_THETA * SPHERE.full_slip
    with ContactFmu(fmu) as contact:
        contact.start(normal_force=SPHERE.normal_force, wear_coefficient=0.0)
        for share in (1.0, 0.5, 0.0, -0.5, -1.0):
            contact.step(tangential_displacement=share * amplitude)
            names = ("radius_probe", "shear_traction", "pressure")
            radius, traction, pressure = (contact.field(name) for name in names)
            fields[share] = radius, traction, SPHERE.friction * pressure
    return fields


def draw(loops, swings, tractions, steps, path):
    """Loops at constant load with tractions along one of them; loops under a varying load."""
    fig, ((loop_axes, swing_axes), (traction_axes, share_axes)) = figure(
        2, 2, figsize=(12, 8.4), height_ratios=(1.55, 1)
    )
    for (theta, loop), colour in zip(loops.items(), COLOURS):
        displacement = loop["displacement"] * MICRO
        loop_axes.plot(displacement, loop["force"], color=colour, label=f"θ = {theta:g}")
        every = slice(None, None, max(1, steps // 10))
        loop_axes.plot(
            displacement[every], loop["exact"][every], "o", ms=4, mfc="none", mec=INK, mew=0.8
        )
    loop_axes.plot([], [], "o", ms=4, mfc="none", mec=INK, mew=0.8, label="closed form")
    for sign in (-1, 1):
        loop_axes.axhline(sign * SPHERE.limit, color=GREY, lw=1, ls="--")
    loop_axes.annotate("μF", (-3.7, SPHERE.limit), (0, -13), textcoords="offset points", color=GREY)
    loop_axes.set(
        title="Constant load, 100 N", xlabel="displacement U (µm)", ylabel="tangential force T (N)"
    )
    loop_axes.set_xlim(right=6.3)
    loop_axes.legend(loc="lower right", bbox_to_anchor=(1, 0.06), title="amplitude U₀ = θ u_max")
    draw_tractions(traction_axes, tractions)

    last = slice(-2 * steps - 1, None)
    for name, _, colour in PHASES:
        swing = swings[name]
        displacement, force = swing["displacement"] * MICRO, swing["force"]
        swing_axes.plot(
            displacement[: -2 * steps], force[: -2 * steps], color=colour, lw=0.8, alpha=0.45
        )
        swing_axes.plot(displacement[last], force[last], color=colour, label=f"load {name}")
        turn = np.linspace(0, 1, 2 * steps + 1)
        share = force[last] / (SPHERE.friction * swing["load"][last])
        share_axes.plot(turn, share, color=colour, label=f"load {name}")
    swing_axes.set(
        title=f"Load swings between {100 * (1 - LOAD_SWING):g} and "
        f"{100 * (1 + LOAD_SWING):g} N, θ = {VARYING_THETA:g}",
        xlabel="displacement U (µm)",
        ylabel="tangential force T (N)",
    )
    swing_axes.plot([], [], color=GREY, lw=0.8, label="first cycles (thin)")
    swing_axes.legend(loc="upper left")
    share_axes.legend(loc="upper right", fontsize=8.5)
    for sign in (-1, 1):
        share_axes.axhline(sign, color=GREY, lw=1, ls="--")
    share_axes.set(
        title="Share of the friction limit in use",
        xlabel="cycles",
        ylabel="T / (μ F_N)",
        ylim=(-1.1, 1.8),
    )
    fig.suptitle("Steel ball (R = 10 mm) on a steel flat, μ = 0.6", x=0.01, ha="left", fontsize=14)
    return save_picture(fig, path)


def draw_tractions(axes, tractions):
    """τ(r) between the friction bounds ±μp."""
    for (share, (radius, traction, _)), colour in zip(tractions.items(), shades(len(tractions))):
        axes.plot(
            radius * MICRO,
            traction * GIGA,
            color=colour,
            label=f"U = {share:+g} U₀" if share else "U = 0",
        )
    radius, _, bound = tractions[0.0]
    for sign in (1, -1):
        label = "±μp" if sign > 0 else None
        axes.plot(radius * MICRO, sign * bound * GIGA, color=GREY, lw=1, ls="--", label=label)
    axes.set(
        title=f"Shear traction on the way back, θ = {TRACTION_THETA:g}",
        xlabel="radius r (µm)",
        ylabel="traction τ (GPa)",
        xlim=(0, SPHERE.contact_radius * MICRO * 1.42),
    )
    axes.legend(loc="center right")


def loop_table(loops):
    sizes = [loop["force"].size for loop in loops.values()]
    return {
        "theta": np.repeat(list(loops), sizes),
        "displacement (m)": np.concatenate([loop["displacement"] for loop in loops.values()]),
        "tangential_force (N)": np.concatenate([loop["force"] for loop in loops.values()]),
        "closed_form (N)": np.concatenate([loop["exact"] for loop in loops.values()]),
    }


def swing_table(swings):
    columns = {
        "time (cycles)": ("angle", 1 / (2 * np.pi)),
        "normal_force (N)": ("load", 1),
        "displacement (m)": ("displacement", 1),
        "tangential_force (N)": ("force", 1),
        "stick_radius (m)": ("stick", 1),
        "contact_radius (m)": ("contact", 1),
    }
    table = {"load": [name for name, swing in swings.items() for _ in swing["angle"]]}
    for header, (key, factor) in columns.items():
        table[header] = np.concatenate([swing[key] for swing in swings.values()]) * factor
    return table
