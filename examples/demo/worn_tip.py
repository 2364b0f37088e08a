"""Case (b): a ball with a synthetic worn tip (profile file), worn over thousands of cycles.

Two amplitudes under the same load: one in partial slip, where a ring wears around a centre that
sticks, and one in gross slip, where the whole contact wears. The FMU computes whole cycles at a
time (loading = cyclic); some of the life is repeated by following every cycle (loading = transient)
to show that both agree.
"""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fretting_contact.component import ContactFmu
from outcome import Headline, Outcome
from plotting import GIGA, GREY, INK, MICRO, figure, save_picture, save_table, shades

PROFILE_FILE = Path(__file__).parent.parent / "profiles" / "worn_ball_tip.txt"
LOAD = 100.0  # N
FRICTION = 0.6
WEAR_PER_WORK = 4e-14  # m³/J, 52100 steel on steel
HARDNESS = 8e9  # Pa
FREQUENCY = 20.0  # Hz


@dataclass(frozen=True)
class Regime:
    """An amplitude, and the cycles at which the profile is shown."""

    name: str
    amplitude: float  # m
    stops: tuple  # cycles


REGIMES = (
    Regime("Partial slip", 1.2e-6, (0, 5_000, 20_000, 60_000, 200_000)),
    Regime("Gross slip", 15e-6, (0, 500, 2_000, 5_000, 10_000)),
)


def run(fmu, out, quick):
    """Runs the case, writes its files into the folder `out`."""
    outcome = Outcome("(b) synthetic worn tip: wear over thousands of cycles")
    lives = []
    for regime in REGIMES:
        life = wear_out(fmu, regime, 5 if quick else 25)
        lives.append(life)
        cycles, volume, work = (
            life["history"][key] for key in ("cycles", "wear_volume", "dissipated_energy")
        )
        outcome.headlines += [
            Headline(
                f"{regime.name}, {cycles[-1]:,.0f} cycles: deepest wear",
                life["history"]["wear_depth"][-1] * MICRO,
                "µm",
            ),
            Headline(
                f"{regime.name}: worn volume against (k/σ₀) · friction work",
                volume[-1] * 1e18,
                "µm³",
                WEAR_PER_WORK * work[-1] * 1e18,
            ),
            Headline(
                f"{regime.name}: volume from the depth at the probes",
                probe_volume(life["fields"][-1]) * 1e18,
                "µm³",
                volume[-1] * 1e18,
            ),
        ]
        cyclic, transient = short_life(fmu, regime, 3 if quick else 10)
        outcome.headlines.append(
            Headline(
                f"{regime.name}: cycle by cycle against whole cycles, worn volume",
                transient * 1e18,
                "µm³",
                cyclic * 1e18,
            )
        )

    outcome.files.append(draw(lives, out / "worn_tip.png"))
    outcome.files.append(save_table(out / "worn_tip_fields.csv", field_table(lives)))
    outcome.files.append(save_table(out / "worn_tip_film.csv", field_table(lives, "film")))
    outcome.files.append(save_table(out / "worn_tip_history.csv", history_table(lives)))
    outcome.series = {"lives": lives}
    return outcome


def parameters(**others):
    """The scene: steel on steel, the tip from the file."""
    return {
        "profile": "table",
        "profile_file": str(PROFILE_FILE),
        "friction_coefficient": FRICTION,
        "hardness": HARDNESS,
        "wear_coefficient": WEAR_PER_WORK * HARDNESS,
        "normal_force": LOAD,
    } | others


def wear_out(fmu, regime, steps_between):
    """The life of the tip in whole cycles: history and fields ("film") at every step, fields at the
    regime's stops.
    """
    names = [
        "wear_volume",
        "wear_depth",
        "dissipated_energy",
        "contact_radius",
        "stick_radius",
        "tangential_force",
    ]
    rows, film, fields = [], [], []
    with ContactFmu(fmu) as contact:
        contact.start(
            **parameters(
                loading="cyclic", displacement_amplitude=regime.amplitude, frequency=FREQUENCY
            )
        )
        # to have slipped at the beginning, too; this little of a cycle wears nothing that could be
        # seen
        contact.step(1e-6 / FREQUENCY)
        done = 0.0
        for stop in regime.stops:
            # Equal steps in the square root of N: wear is fastest at the beginning.
            targets = (
                np.linspace(np.sqrt(done), np.sqrt(stop), steps_between + 1)[1:] ** 2
                if stop
                else [0.0]
            )
            for target in targets:
                if target > done:
                    contact.step((target - done) / FREQUENCY)
                done = target
                rows.append([done, *contact.get(*names)])
                film.append(read_fields(contact, done))
            fields.append(film[-1])
    history = dict(zip(["cycles", *names], np.array(rows).T))
    return {"regime": regime, "history": history, "fields": fields, "film": film}


def read_fields(contact, cycles):
    radius = contact.field("radius_probe")
    return {
        "cycles": cycles,
        "radius": radius,
        "worn": contact.field("worn_depth"),
        "pressure": contact.field("pressure"),
        "unworn": unworn_height(radius),
    }


@functools.cache
def profile_points():
    """r and f of the profile file, m."""
    return np.loadtxt(PROFILE_FILE).T


def unworn_height(radius):
    """The profile file between its points, linear in r² as the FMU reads it."""
    r, f = profile_points()
    return np.interp(np.asarray(radius) ** 2, r**2, f)


def probe_volume(fields):
    """∫ 2π r Δf dr by the trapezium rule in r² over the probes, m³."""
    return np.pi * np.trapezoid(fields["worn"], fields["radius"] ** 2)


def short_life(fmu, regime, cycles):
    """Worn volume of some first cycles, from whole cycles and from following each: (cyclic,
    transient), m³.

    Wear is made faster, so that the contact changes visibly within these few cycles.
    """
    life = regime.stops[2] / cycles
    faster = {"wear_coefficient": WEAR_PER_WORK * HARDNESS * life}
    with ContactFmu(fmu) as contact:
        contact.start(
            **parameters(
                loading="cyclic", displacement_amplitude=regime.amplitude, frequency=1.0, **faster
            )
        )
        for _ in range(cycles):
            contact.step(1.0)
        cyclic = contact.get("wear_volume")
    half = regime.amplitude * np.cos(np.linspace(0, np.pi, 101)[1:])
    with ContactFmu(fmu) as contact:
        # The way from rest to the first reversal is no part of a cycle: it is made before counting
        # starts.
        contact.start(**parameters(loading="transient", **faster))
        contact.step(tangential_displacement=regime.amplitude)
        before = contact.get("wear_volume")
        for displacement in np.tile(np.concatenate([half, -half]), cycles):
            contact.step(tangential_displacement=displacement)
        transient = contact.get("wear_volume") - before
    return cyclic, transient


def draw(lives, path):
    """For each regime: the profile, the pressure, the worn volume, all against cycles."""
    fig, rows = figure(
        len(lives), 3, figsize=(13, 7.8), width_ratios=(1.15, 1.15, 1), squeeze=False
    )
    for (shape, pressure, volume), life in zip(rows, lives):
        regime, fields = life["regime"], life["fields"]
        reach = 1.12 * life["history"]["contact_radius"].max() * MICRO
        r = np.linspace(0, reach / MICRO, 400)
        last = fields[-1]
        removed = [
            last["radius"] * MICRO,
            last["unworn"] * MICRO,
            (last["unworn"] + last["worn"]) * MICRO,
        ]
        shape.fill_between(*removed, color=GREY, alpha=0.18, lw=0, label="worn away")
        shape.plot(r * MICRO, unworn_height(r) * MICRO, color=GREY, lw=1, ls="--", label="unworn")
        for state, colour in zip(fields, shades(len(fields))):
            radius = state["radius"] * MICRO
            label = f"{state['cycles']:,.0f} cycles"
            shape.plot(radius, (state["unworn"] + state["worn"]) * MICRO, color=colour, label=label)
            pressure.plot(radius, state["pressure"] * GIGA, color=colour, label=label)
            volume.plot(
                state["cycles"] / 1e3,
                np.interp(
                    state["cycles"], life["history"]["cycles"], life["history"]["wear_volume"]
                )
                * 1e15,
                "o",
                color=colour,
                label=label,
            )
        shape.set(
            title=f"{regime.name}: amplitude U₀ = {regime.amplitude * MICRO:g} µm",
            xlabel="radius r (µm)",
            ylabel="height of the tip (µm)",
            xlim=(0, reach),
            ylim=(
                0,
                1.1
                * (unworn_height(reach / MICRO) + 0.3 * life["history"]["wear_depth"][-1])
                * MICRO,
            ),
        )
        shape.legend(loc="upper left", fontsize=8.5)
        pressure.set(
            title="Pressure",
            xlabel="radius r (µm)",
            ylabel="contact pressure (GPa)",
            xlim=(0, reach),
        )
        limit_pressure(pressure, fields)
        pressure.legend(loc="upper right")
        cycles, worn = life["history"]["cycles"], life["history"]["wear_volume"]
        volume.plot(cycles / 1e3, worn * 1e15, color=INK, lw=1.2, zorder=1, label="all steps")
        volume.legend(loc="lower right")
        volume.set(
            title="Worn volume",
            xlabel="thousand cycles",
            ylabel="worn volume (10⁻⁶ mm³)",
            xlim=(0, None),
            ylim=(0, None),
        )
    title = (
        f"Synthetic worn tip of a steel ball (R = 10 mm), μ = {FRICTION:g}, "
        f"{LOAD:g} N, k/σ₀ = {WEAR_PER_WORK:g} m³/J"
    )
    fig.suptitle(title, x=0.01, ha="left", fontsize=14)
    return save_picture(fig, path)


def limit_pressure(axes, fields):
    """Shows the bulk of the curves: at a pinned stick edge the pressure grows beyond any axis."""
    peaks = [state["pressure"].max() for state in fields]
    limit = GIGA * max(1.15 * peaks[0], 1.6 * np.median(peaks))
    axes.set_ylim(0, limit)
    state = fields[-1]
    if state["pressure"].max() * GIGA > limit:
        place = state["radius"][state["pressure"].argmax()] * MICRO
        text = "singular at the\nstick edge"
        axes.annotate(
            text,
            (place, 0.94 * limit),
            (-10, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            color=INK,
        )


def field_table(lives, which="fields"):
    """The fields at the stops of each life, or at every step ("film")."""
    states = [(life["regime"].name, state) for life in lives for state in life[which]]
    columns = {
        "radius (m)": "radius",
        "unworn_height (m)": "unworn",
        "worn_depth (m)": "worn",
        "pressure (Pa)": "pressure",
    }
    table = {
        "regime": [name for name, state in states for _ in state["radius"]],
        "cycles": np.concatenate(
            [np.full(state["radius"].size, state["cycles"]) for _, state in states]
        ),
    }
    return table | {
        header: np.concatenate([state[key] for _, state in states])
        for header, key in columns.items()
    }


def history_table(lives):
    units = {
        "cycles": "1",
        "wear_volume": "m3",
        "wear_depth": "m",
        "dissipated_energy": "J",
        "contact_radius": "m",
        "stick_radius": "m",
        "tangential_force": "N",
    }
    table = {"regime": [life["regime"].name for life in lives for _ in life["history"]["cycles"]]}
    return table | {
        f"{key} ({unit})": np.concatenate([life["history"][key] for life in lives])
        for key, unit in units.items()
    }
