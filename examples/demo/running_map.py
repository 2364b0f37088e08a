"""Case (e): a fretting map: stick, partial slip and gross slip, and what wears.

Each field of the map is a contact of its own that runs for a hundred thousand cycles.
`examples/sweep` does the same for thousands of sets, on all cores or on a cluster.
"""

import numpy as np
from fretting_contact.component import ContactFmu
from matplotlib.colors import LogNorm
from outcome import Headline, Outcome
from plotting import INK, MICRO, figure, save_picture, save_table
from theory import Sphere

LOADS = (10.0, 300.0)  # N
AMPLITUDES = (0.1, 8.0)  # µm
CYCLES = 1e5
STICKS = 0.95  # share of the contact radius from which on the contact counts as stuck
REGIMES = ("stick", "partial slip", "gross slip")
PALE = "#ffffffcc"


def run(fmu, out, quick):
    """Runs the case, writes its files into the folder `out`."""
    outcome = Outcome("(e) running conditions: load against amplitude")
    # edges of the fields, evenly spaced in the logarithm
    loads, amplitudes = (
        np.geomspace(*LOADS, 9 if quick else 17),
        np.geomspace(*AMPLITUDES, 11 if quick else 21) / MICRO,
    )
    rows = [
        life(fmu, load, amplitude) for load in middles(loads) for amplitude in middles(amplitudes)
    ]
    table = {name: [row[name] for row in rows] for name in rows[0]}

    expected = [
        closed_form(load, amplitude) for load, amplitude in zip(table["load"], table["amplitude"])
    ]
    agree = sum(found == known for found, known in zip(table["regime"], expected))
    outcome.headlines.append(
        Headline("fields of the map whose regime is Mindlin's", agree, "", len(rows))
    )
    steady = [row for row in rows if row["regime"] == "gross slip"]
    ratio = np.array(
        [row["first"] / Sphere(row["load"]).loop_work(row["amplitude"]) for row in steady]
    )
    outcome.headlines.append(
        Headline(
            "friction work of the first cycle in gross slip, of Mindlin's", np.mean(ratio), "", 1.0
        )
    )

    outcome.files.append(draw(table, loads, amplitudes, out / "running_map.png"))
    units = {"load": "N", "amplitude": "m", "first": "J", "wear_volume": "m3", "wear_depth": "m"}
    named = {"first": "work_of_first_cycle"}
    columns = {f"{named.get(key, key)} ({unit})": table[key] for key, unit in units.items()}
    outcome.files.append(save_table(out / "running_map.csv", {"regime": table["regime"]} | columns))
    return outcome


def middles(edges):
    return np.sqrt(edges[1:] * edges[:-1])


def life(fmu, load, amplitude):
    """One contact: its regime in the first cycle, its wear after all."""
    with ContactFmu(fmu) as contact:
        contact.start(
            normal_force=load, loading="cyclic", displacement_amplitude=amplitude, frequency=1.0
        )
        contact.step(1.0)
        stick, radius, work = contact.get("stick_radius", "contact_radius", "dissipated_energy")
        contact.step(CYCLES - 1.0)
        volume, depth = contact.get("wear_volume", "wear_depth")
    return {
        "regime": regime(stick / radius),
        "load": load,
        "amplitude": amplitude,
        "first": work,
        "wear_volume": volume,
        "wear_depth": depth,
    }


def regime(stick_share):
    """By the share of the contact radius that sticks."""
    return REGIMES[2 if stick_share == 0.0 else 0 if stick_share > STICKS else 1]


def closed_form(load, amplitude):
    """The regime by Mindlin: c/a = √(1 − U/u_max)."""
    return regime(np.sqrt(max(0.0, 1 - amplitude / Sphere(load).full_slip)))


def boundaries(loads):
    """Amplitudes at which 1 − STICKS of the radius slips, and all of it, m."""
    slides = np.array([Sphere(load).full_slip for load in loads])
    return (1 - STICKS**2) * slides, slides


def draw(table, loads, amplitudes, path):
    """Worn volume as colour, the regimes' boundaries by their closed forms."""
    fig, axes = figure(figsize=(8, 5.6))
    volume = np.array(table["wear_volume"]).reshape(loads.size - 1, -1) * 1e15
    norm = LogNorm(np.percentile(volume, 2), volume.max())
    fields = axes.pcolormesh(
        amplitudes * MICRO, loads, volume, norm=norm, cmap="viridis", rasterized=True
    )
    fine = np.geomspace(*LOADS, 100)
    names = f"stick radius is {STICKS:g} a", "whole contact slips"
    for line, style, name in zip(boundaries(fine), ("--", "-"), names):
        axes.plot(line * MICRO, fine, color=PALE, lw=4)
        axes.plot(line * MICRO, fine, color=INK, lw=1.6, ls=style, label=f"{name} (Mindlin)")
    axes.legend(loc="lower right", frameon=True, facecolor="white", framealpha=0.85)
    middle = np.sqrt(LOADS[0] * LOADS[1])
    stuck, slides = (line[0] * MICRO for line in boundaries([middle]))
    low, high = AMPLITUDES
    for name, left, right in zip(REGIMES, (low, stuck, slides), (stuck, slides, high)):
        place = np.sqrt(left * right), middle * (1 if name != "stick" else 2.2)
        box = {"facecolor": PALE, "edgecolor": "none", "boxstyle": "round,pad=0.3"}
        axes.text(*place, name, ha="center", va="center", color=INK, bbox=box)
    axes.set(
        xscale="log", yscale="log", xlabel="displacement amplitude (µm)", ylabel="normal force (N)"
    )
    axes.set(
        xlim=AMPLITUDES,
        ylim=LOADS,
        title=f"Steel ball, R = 10 mm, μ = 0.6: wear after {CYCLES:,.0f} cycles",
    )
    for axis, ticks in (
        (axes.xaxis, (0.1, 0.2, 0.5, 1, 2, 5)),
        (axes.yaxis, (10, 20, 50, 100, 200)),
    ):
        axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axes.grid(False)
    fig.colorbar(fields, label="worn volume (10⁻⁶ mm³)", extend="min")
    return save_picture(fig, path)
