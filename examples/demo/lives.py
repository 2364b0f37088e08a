"""Case (d): four lives to the final state, as in the paper: profile, image and tractions.

The counterparts of figures 2 to 5 of Dimaki et al. 2014, at the same Ñ = N/N₀ with N₀ = π a₀² d₀ /
((k/σ₀) μ F_N U₀): the amplitude U₀ is such that the unworn contact sticks up to 0.4 a₀. The FMU
computes whole cycles at a time (loading = cyclic), one communication step from one curve to the
next.
"""

from dataclasses import dataclass

import numpy as np
from bodies import STEEL, BluntedParabola, Cone, FinalShape, Parabola
from fretting_contact.component import ContactFmu
from outcome import Headline, Outcome
from plotting import GREY, INK, figure, save_picture, save_table, shades

WEAR_PER_WORK = 4e-14  # m³/J, 52100 steel on steel
HARDNESS = 8e9  # Pa
STICK_RATIO = 0.4  # c/a₀ of the unworn contact; for the worn tip a choice, the paper gives none
FIELDS = ("radius_probe", "worn_depth", "image", "pressure", "shear_traction")


@dataclass(frozen=True)
class Case:
    """One of the paper's figures."""

    body: object
    control: str  # what is prescribed: force or indentation
    stops: tuple  # Ñ
    file: str
    volume: float | None = None  # V/(a₀² d₀) at the last stop, where it is known

    @property
    def title(self):
        return f"{self.body.name}, constant {'force' if self.control == 'force' else 'depth'}"

    @property
    def depth(self):
        """d₀, m."""
        return self.body.image(self.body.contact_radius)

    @property
    def amplitude(self):
        """U₀ = μ (E*/G*) (d₀ − g₀(c)), m."""
        ratio = STEEL.friction * STEEL.plane_modulus / STEEL.shear_modulus
        return ratio * (self.depth - self.body.image(STICK_RATIO * self.body.contact_radius))

    @property
    def life_unit(self):
        """N₀, cycles."""
        worn = np.pi * self.body.contact_radius**2 * self.depth
        return worn / (WEAR_PER_WORK * STEEL.limit * self.amplitude)

    @property
    def final(self):
        """The final shape, where it has a closed form."""
        if self.control == "force":
            return None
        return FinalShape(self.depth, STICK_RATIO * self.body.contact_radius)

    @property
    def mean_pressure(self):
        """Of the unworn contact, Pa: the peak is infinite for the cone."""
        return STEEL.normal_force / (np.pi * self.body.contact_radius**2)


# Volumes at the last stop: independent runs, good to 0.3 % at constant force, the closed form at
# constant depth.
CASES = (
    Case(Parabola(), "force", (0, 0.04, 0.16, 0.36, 0.64, 1.0), "life_parabola", 1.748),
    Case(Cone(), "force", (0, 0.1, 0.4, 0.9, 1.6, 2.5), "life_cone", 2.456),
    Case(
        Parabola(), "indentation", (0, 0.16, 0.36, 0.64, 1.0, 9.0), "life_constant_depth", 1.131108
    ),
    Case(BluntedParabola(), "force", (0, 0.04, 0.16, 0.36, 0.64, 1.44), "life_worn_tip"),
)


def run(fmu, out, quick):
    """Runs the case, writes its files into the folder `out`. A life takes a few steps: `quick`
    makes no difference.
    """
    outcome = Outcome("(d) lives to the end of wear")
    lives = [live(fmu, case) for case in CASES]
    for life in lives:
        outcome.headlines += headlines(life)
        outcome.files.append(draw(life, out / f"{life['case'].file}.png"))
    outcome.files.append(save_table(out / "lives.csv", table(lives)))
    outcome.series = {"lives": lives}
    return outcome


def live(fmu, case):
    """Follows one case: the fields and some outputs at each of its stops."""
    states = []
    with ContactFmu(fmu) as contact:
        contact.start(
            **case.body.parameters,
            loading="cyclic",
            normal_control=case.control,
            normal_force=STEEL.normal_force,
            indentation=case.depth,
            displacement_amplitude=case.amplitude,
            frequency=1.0,
            friction_coefficient=STEEL.friction,
            hardness=HARDNESS,
            wear_coefficient=WEAR_PER_WORK * HARDNESS,
        )
        # to stand at +U₀ at the first stop, too; the wear of this part of a cycle is negligible
        contact.step(1e-6)
        done = 0.0
        for stop in case.stops:
            if stop:
                contact.step((stop - done) * case.life_unit)
                done = stop
            names = (
                "indentation_depth",
                "contact_radius",
                "stick_radius",
                "normal_reaction",
                "wear_volume",
            )
            state = dict(zip(names, contact.get(*names)))
            states.append(state | {"life": stop} | {name: contact.field(name) for name in FIELDS})
    return {"case": case, "states": states}


def headlines(life):
    """What is known of the last state."""
    case, last = life["case"], life["states"][-1]
    where = f"Ñ = {last['life']:g}, {case.title[0].lower()}{case.title[1:]}"
    radius = case.body.contact_radius
    quantity = (
        "worn volume /(a₀² d₀)"
        if case.volume
        else "worn volume, nothing to compare with, /(a₀² d₀)"
    )
    known = [
        Headline(
            f"{quantity} at {where}",
            last["wear_volume"] / (radius**2 * case.depth),
            "",
            case.volume,
        ),
        Headline(
            f"force from the image at {where}", image_force(last), "N", last["normal_reaction"]
        ),
    ]
    if case.final:
        known.append(
            Headline(
                f"stick radius c/a₀ at {where}", last["stick_radius"] / radius, "", STICK_RATIO
            )
        )
        known.append(
            Headline(
                f"last force at {where}", last["normal_reaction"], "N", case.final.normal_force
            )
        )
        known.append(
            Headline(
                f"largest miss of the final shape, of d₀, at {where}", final_miss(case, last), ""
            )
        )
    return known


def image_force(state):
    """2E* ∫ (d − g) dx by the trapezium rule over the probes, N."""
    carried = np.clip(state["indentation_depth"] - state["image"], 0, None)
    return 2 * STEEL.plane_modulus * np.trapezoid(carried, state["radius_probe"])


def final_miss(case, state):
    """Largest difference from the closed final shape at the probes, in d₀."""
    r = state["radius_probe"]
    return (
        np.max(np.abs(case.body.height(r) + state["worn_depth"] - case.final.height(r)))
        / case.depth
    )


def draw(life, path):
    """Profile, image, pressure and traction of one case, in the units of its unworn contact."""
    case, states = life["case"], life["states"]
    a, d = case.body.contact_radius, case.depth
    fig, ((profile, image), (pressure, traction)) = figure(2, 2, figsize=(11, 8.2))
    reach = 1.12 * states[-1]["contact_radius"] / a
    beyond = np.linspace(0, reach * a, 400)
    colours = shades(len(states))
    for state, colour in zip(states, colours):
        r, worn = state["radius_probe"], state["worn_depth"]
        outside = beyond[beyond > r[-1]]
        profile.plot(
            np.concatenate([r, outside]) / a,
            np.concatenate([case.body.height(r) + worn, case.body.height(outside)]) / d,
            color=colour,
            label=f"Ñ = {state['life']:g}",
        )
        inside = r <= state["contact_radius"] * (1 + 1e-9)
        image.plot(r[inside] / a, state["image"][inside] / d, color=colour)
        image.plot(
            state["contact_radius"] / a, state["indentation_depth"] / d, "o", ms=4, color=colour
        )
        for axes, name in ((pressure, "pressure"), (traction, "shear_traction")):
            values = np.where(
                np.isfinite(state[name]), state[name], np.nan
            )  # the apex of an unworn cone
            axes.plot(r / a, values / case.mean_pressure, color=colour)
    image.plot(beyond / a, case.body.image(beyond) / d, color=GREY, lw=1, ls="--", label="unworn")
    image.plot([], [], "o", ms=4, color=INK, label="contact edge, g = d")
    if case.final:
        end = case.final
        profile.plot(
            beyond / a,
            end.height(beyond) / d,
            color=INK,
            lw=2.2,
            ls=":",
            label="closed final shape",
        )
        c = end.stick_radius
        stuck = np.linspace(0, c, 50)
        steps = np.concatenate([stuck, [c, states[-1]["contact_radius"]]])
        flat = np.concatenate([case.body.image(stuck), [end.depth, end.depth]])
        image.plot(steps / a, flat / d, color=INK, lw=2.2, ls=":", label="closed final image")
    top = max(state["indentation_depth"] for state in states) / d
    profile.set(
        title="Profile", xlabel="r / a₀", ylabel="f / d₀", xlim=(0, reach), ylim=(0, 1.1 * top)
    )
    image.set(
        title="Its 1-D image",
        xlabel="x / a₀",
        ylabel="g / d₀",
        xlim=(0, reach),
        ylim=(0, 1.1 * top),
    )
    lines, names = profile.get_legend_handles_labels()
    fig.legend(lines, names, loc="outside right upper")
    image.legend(loc="lower right")
    for axes, name, title, label in (
        (pressure, "pressure", "Pressure", "p / (F₀/πa₀²)"),
        (traction, "shear_traction", "Traction at +U₀", "τ / (F₀/πa₀²)"),
    ):
        axes.set(title=title, xlabel="r / a₀", ylabel=label, xlim=(0, reach))
        limit(
            axes,
            [state[name] / case.mean_pressure for state in states],
            states[-1]["radius_probe"] / a,
        )
    held = f"{STEEL.normal_force:g} N" if case.control == "force" else f"{d * 1e6:.3g} µm"
    title = (
        f"{case.title} ({held}): {case.body.dimensions}, μ = {STEEL.friction:g}, "
        f"c₀ = {STICK_RATIO:g} a₀,"
        f" amplitude U₀ = {case.amplitude * 1e6:.3g} µm\n"
        "Ñ = N/N₀, N cycles, N₀ = π a₀² d₀ / ((k/σ₀) μ F₀ U₀) = "
        f"{case.life_unit:,.0f}; a₀, d₀, F₀: radius, depth and load at N = 0"
    )
    fig.suptitle(title, x=0.01, ha="left", fontsize=12)
    return save_picture(fig, path)


def limit(axes, curves, radii):
    """Shows the bulk of the curves: at a stick edge that no longer moves the field is singular."""
    finite = [curve[np.isfinite(curve)] for curve in curves]
    top = 1.25 * max(np.percentile(curve, 90) for curve in finite)
    top = max(top, 1.1 * finite[0][1:].max() if finite[0].size == curves[0].size else top)
    axes.set_ylim(0, top)
    last = np.where(np.isfinite(curves[-1]), curves[-1], 0)
    peak = 1 + last[1:].argmax()
    if last[peak] > top:
        axes.annotate(
            f"singular at the\nstick edge: {last[peak]:.2g}\nat the nearest probe",
            (radii[peak], 0.97 * top),
            (16, 0),
            textcoords="offset points",
            va="top",
            color=INK,
        )


def table(lives):
    states = [(life["case"], state) for life in lives for state in life["states"]]
    columns = {
        "radius (m)": "radius_probe",
        "worn_depth (m)": "worn_depth",
        "image (m)": "image",
        "pressure (Pa)": "pressure",
        "shear_traction (Pa)": "shear_traction",
    }
    size = states[0][1]["radius_probe"].size
    rows = {
        "case": [case.title for case, _ in states for _ in range(size)],
        "life (N/N0)": np.concatenate([np.full(size, float(state["life"])) for _, state in states]),
        "unworn_height (m)": np.concatenate(
            [case.body.height(state["radius_probe"]) for case, state in states]
        ),
    }
    return rows | {
        header: np.concatenate([state[key] for _, state in states])
        for header, key in columns.items()
    }
