"""Case (c): the FMU as the friction joint of a larger system.

A 20 kg unit sits on a mount (spring and damper) on a shaking base; a ball, clamped against it by a
leaf spring, locates it. The mount is soft, the stuck joint is stiff: its friction decides how much
the unit moves. As the ball wears, the clamp relaxes, the joint holds less, and the unit shakes
more.

Coupling: a Gauss–Seidel scheme with a fixed communication step and a linear model of the joint.
Over each step the joint is T ≈ T_n + k_n (z − z_n), from the FMU's outputs tangential_force and
tangential_stiffness, but never more than μ F_N; an adaptive Runge–Kutta solver takes the mass
through the step; the FMU then moves to where the mass has arrived and reports its true force.
Taking the stiffness along makes the scheme second order and stable although the joint is far
stiffer than the mount: holding T_n alone would feed energy into the stuck joint. The clamp does the
same with normal_stiffness. The step is 1/96 of a period of the shaking: half of it changes the
amplitude by well under 1 %, and the friction work that the FMU counts agrees as well with what the
ODE solver finds missing (both printed).
"""

from dataclasses import dataclass

import numpy as np
from fretting_contact.component import ContactFmu
from outcome import Headline, Outcome
from plotting import (
    BLUE,
    GREEN,
    GREY,
    INK,
    MICRO,
    ORANGE,
    RED,
    figure,
    save_picture,
    save_table,
    shades,
)
from scipy.integrate import solve_ivp
from theory import Sphere

JOINT = Sphere(normal_force=100.0)
WEAR_PER_WORK = 4e-14  # m³/J, 52100 steel on steel
HARDNESS = 8e9  # Pa
ACCELERATION_OF_WEAR = 100.0  # one second of vibration represents a hundred


@dataclass(frozen=True)
class Rig:
    """The mass, its mount, the clamp of the joint and the shaking of the base."""

    mass: float = 20.0  # kg
    mount: float = 2e6  # N/m
    damping: float = 250.0  # N s/m, 2 % of critical on the mount alone
    clamp: float = 30e6  # N/m, stiffness of the leaf spring that presses the ball
    shake: float = 2.4  # m/s², amplitude of the base's acceleration
    frequency: float = 100.0  # Hz
    ramp: float = 0.02  # s, over which the shaking sets in

    def push(self, time):
        """Inertia force on the mass in the moving frame, N."""
        return (
            -self.mass
            * self.shake
            * min(time / self.ramp, 1.0)
            * np.sin(2 * np.pi * self.frequency * time)
        )

    def amplitude_with_spring(self, stiffness):
        """Amplitude of the steady motion if the joint were a plain spring, m."""
        omega = 2 * np.pi * self.frequency
        return (
            self.mass
            * self.shake
            / abs(self.mount + stiffness - self.mass * omega**2 + 1j * omega * self.damping)
        )


RIG = Rig()
OUTPUTS = (
    "tangential_force",
    "tangential_stiffness",
    "normal_stiffness",
    "indentation_depth",
    "wear_volume",
    "dissipated_energy",
)


def run(fmu, out, quick):
    """Runs the case, writes its files into the folder `out`."""
    cycles, steps = (24, 96) if quick else (300, 96)
    outcome = Outcome("(c) shaken mass with the FMU as its friction joint")
    motion = shake(fmu, cycles, steps)
    envelope = amplitudes(motion, steps)
    check = cycles // 4
    coarse, fine = envelope[check - 1], amplitudes(shake(fmu, check, 2 * steps), 2 * steps)[-1]

    stored = (
        0.5 * RIG.mass * motion["velocity"][-1] ** 2
        + 0.5 * RIG.mount * motion["displacement"][-1] ** 2
    )
    into_joint = motion["work_in"][-1] - motion["work_damper"][-1] - stored
    outcome.headlines += [
        Headline(
            "amplitude if the joint could not slip",
            RIG.amplitude_with_spring(JOINT.stiffness) * MICRO,
            "µm",
        ),
        Headline("amplitude without the joint", RIG.amplitude_with_spring(0.0) * MICRO, "µm"),
        Headline(
            f"amplitude with friction, cycle {check}; expected: with half the step",
            coarse * MICRO,
            "µm",
            fine * MICRO,
        ),
        Headline(f"amplitude at the end, cycle {cycles}", envelope[-1] * MICRO, "µm"),
        Headline("normal force at the end (100 N at first)", motion["load"][-1], "N"),
        Headline(
            "friction work: counted by the FMU, by the ODE solver",
            motion["dissipated_energy"][-1] * 1e3,
            "mJ",
            into_joint * 1e3,
        ),
        Headline(
            "worn volume against (k/σ₀) · friction work",
            motion["wear_volume"][-1] * 1e18,
            "µm³",
            ACCELERATION_OF_WEAR * WEAR_PER_WORK * motion["dissipated_energy"][-1] * 1e18,
        ),
    ]
    outcome.files.append(draw(motion, envelope, steps, out / "shaken_mass.png"))
    outcome.files.append(save_table(out / "shaken_mass.csv", motion_table(motion)))
    outcome.series = {"motion": motion, "envelope": envelope, "steps": steps}
    return outcome


def shake(fmu, cycles, steps):
    """Solves the motion over `cycles` periods with `steps` communication steps each."""
    h = 1 / (RIG.frequency * steps)
    states = np.zeros((cycles * steps + 1, 4))  # z, dz/dt, work of the base, work of the damper
    joint = np.zeros((cycles * steps + 1, len(OUTPUTS)))
    load = np.full(cycles * steps + 1, JOINT.normal_force)
    with ContactFmu(fmu) as contact:
        wear = ACCELERATION_OF_WEAR * WEAR_PER_WORK * HARDNESS
        contact.start(normal_force=JOINT.normal_force, wear_coefficient=wear, hardness=HARDNESS)
        joint[0] = contact.get(*OUTPUTS)
        depth_at_rest = joint[0, OUTPUTS.index("indentation_depth")]
        for n in range(cycles * steps):
            force, stiffness, normal_stiffness, depth = joint[n, :4]
            states[n + 1] = move_mass(
                n * h, h, states[n], (force, stiffness, JOINT.friction * load[n])
            )
            load[n + 1] = relax_clamp(load[n], depth - depth_at_rest, normal_stiffness)
            contact.step(h, tangential_displacement=states[n + 1, 0], normal_force=load[n + 1])
            joint[n + 1] = contact.get(*OUTPUTS)
    motion = dict(zip(("displacement", "velocity", "work_in", "work_damper"), states.T)) | dict(
        zip(OUTPUTS, joint.T)
    )
    return motion | {"time": h * np.arange(cycles * steps + 1), "load": load}


def move_mass(time, h, state, joint):
    """The mass through one communication step, with the joint as a spring about its last state that
    may slide.
    """
    start, (force, stiffness, limit) = state[0], joint

    def rates(t, y):
        z, velocity = y[0], y[1]
        push = RIG.push(t)
        friction = min(max(force + stiffness * (z - start), -limit), limit)
        acceleration = (push - RIG.damping * velocity - RIG.mount * z - friction) / RIG.mass
        return velocity, acceleration, push * velocity, RIG.damping * velocity**2

    return solve_ivp(rates, (time, time + h), state, rtol=1e-8, atol=1e-12).y[:, -1]


def relax_clamp(load, approach, normal_stiffness):
    """The clamp's force once the ball has worn in by `approach`; one Newton step with the contact's
    stiffness.
    """
    wanted = JOINT.normal_force - RIG.clamp * approach
    ratio = RIG.clamp / normal_stiffness
    return max((wanted + ratio * load) / (1 + ratio), 0.0)


def amplitudes(motion, steps):
    """Half the peak-to-peak displacement of each period, m."""
    cycles = motion["displacement"][1:].reshape(-1, steps)
    return (cycles.max(axis=1) - cycles.min(axis=1)) / 2


def draw(motion, envelope, steps, path):
    """Amplitude, clamp force and wear against time; the joint's loop early and late."""
    fig, axes = figure(2, 2, figsize=(12, 7.8), width_ratios=(1.35, 1))
    (amplitude_axes, loop_axes), (wear_axes, force_axes) = axes
    time = motion["time"]
    period = (np.arange(envelope.size) + 0.5) / RIG.frequency

    amplitude_axes.fill_between(
        period, -envelope * MICRO, envelope * MICRO, color=BLUE, alpha=0.18, lw=0
    )
    amplitude_axes.plot(
        time, motion["displacement"] * MICRO, color=BLUE, lw=0.25, label="displacement (thin)"
    )
    amplitude_axes.plot(
        period, envelope * MICRO, color=BLUE, label="amplitude (half of peak to peak)"
    )
    amplitude_axes.legend(loc="upper left")
    amplitude_axes.set(
        title=f"The unit shakes more as its joint wears ({RIG.frequency:g} Hz)",
        xlabel="time (s)",
        ylabel="displacement (µm)",
        xlim=(0, time[-1]),
    )

    early = min(envelope.size // 4, 15)
    shown = np.unique(np.linspace(early, envelope.size, 5).astype(int))
    for last, colour in zip(shown, shades(shown.size)):
        cycle = slice((last - 1) * steps, last * steps + 1)
        loop_axes.plot(
            motion["displacement"][cycle] * MICRO,
            motion["tangential_force"][cycle],
            color=colour,
            label=f"{last / RIG.frequency:.2f} s",
        )
    loop_axes.set(
        title="Force of the joint", xlabel="displacement (µm)", ylabel="tangential force T (N)"
    )
    loop_axes.set_xlim(right=1.5 * loop_axes.get_xlim()[1])
    loop_axes.legend(loc="center right", title="after")

    wear_axes.plot(time, motion["wear_volume"] * 1e15, color=RED, label="wear_volume")
    wear_axes.legend(loc="upper left")
    wear_axes.set(
        title=f"Wear, {ACCELERATION_OF_WEAR:g} × faster than steel's",
        xlabel="time (s)",
        ylabel="worn volume (10⁻⁶ mm³)",
        xlim=(0, time[-1]),
        ylim=(0, None),
    )

    force_axes.plot(time, motion["load"], color=GREEN, label="normal force")
    friction = motion["tangential_force"][1:].reshape(-1, steps)
    force_axes.plot(
        period, np.abs(friction).max(axis=1), color=ORANGE, label="peak tangential force"
    )
    force_axes.axhline(
        RIG.mass * RIG.shake, color=GREY, lw=1, ls="--", label="inertia force of the shaking"
    )
    force_axes.set(
        title="The clamp relaxes",
        xlabel="time (s)",
        ylabel="force (N)",
        xlim=(0, time[-1]),
        ylim=(0, 1.12 * JOINT.normal_force),
    )
    force_axes.legend(loc="lower left")
    fig.suptitle(
        f"A {RIG.mass:g} kg unit on its mount, located by a clamped steel ball (R "
        f"= 10 mm, μ = {JOINT.friction:g})",
        x=0.01,
        ha="left",
        fontsize=14,
        color=INK,
    )
    return save_picture(fig, path)


def motion_table(motion):
    units = {
        "time": "s",
        "displacement": "m",
        "velocity": "m/s",
        "tangential_force": "N",
        "load": "N",
        "indentation_depth": "m",
        "wear_volume": "m3",
        "dissipated_energy": "J",
    }
    return {f"{key} ({unit})": motion[key] for key, unit in units.items()}
