"""The page: the demo's tables as one interactive HTML file, which needs no network.

python page.py target/demo       # draws it again from the CSV files in a folder

The numbers come from the CSV files, rounded to six digits. Pictures are drawn in the browser by
Vega-Lite, which vl-convert brings.
"""

import csv
import html
import json
import os
import sys
from pathlib import Path

import numpy as np
import running_map
import worn_tip
from plotting import GIGA, MICRO
from shaken_mass import RIG
from theory import Sphere

PARTS = Path(__file__).with_name("page")
GUIDE = Path(__file__).resolve().parents[2] / "docs"
#: Pages of the guide that the page links to: place in page.html, file.
LINKS = {
    "guide": "README.md",
    "first_steps": "first_steps.md",
    "theory": "theory.md",
    "settings": "settings.md",
    "coupling": "coupling.md",
    "accuracy": "accuracy.md",
}
CUBIC = 1e15  # m³ → 10⁻⁶ mm³
LOOPS_SHOWN = 5  # of the shaken mass


class NoLibrary(Exception):
    """The drawing library is not installed."""


def write(folder):
    """Writes index.html into the folder of the CSV files; returns its path."""
    parts = {
        "style": (PARTS / "page.css").read_text(encoding="utf-8"),
        "library": library(),
        "data": json.dumps(
            data(folder), allow_nan=False, ensure_ascii=False, separators=(",", ":")
        ).replace("</", "<\\/"),
        "pictures": (PARTS / "pictures.js").read_text(encoding="utf-8"),
        "script": (PARTS / "page.js").read_text(encoding="utf-8"),
        "numbers": numbers(folder / "headlines.csv"),
        "tables": "\n".join(
            f'<li><a href="{path.name}">{path.name}</a></li>'
            for path in sorted(folder.glob("*.csv"))
        ),
        "licences": html.escape((PARTS / "licences.txt").read_text(encoding="utf-8")),
    }
    parts |= {f"link:{name}": link(folder, file) for name, file in LINKS.items()}
    text = (PARTS / "page.html").read_text(encoding="utf-8")
    for name, part in parts.items():
        text = text.replace("{{" + name + "}}", part)
    path = folder / "index.html"
    path.write_text(text, encoding="utf-8")
    return path


def link(folder, file):
    """Address of a page of the guide, relative to the folder where that is possible."""
    try:
        return Path(os.path.relpath(GUIDE / file, folder.resolve())).as_posix()
    except ValueError:  # another drive
        return (GUIDE / file).as_uri()


def library():
    """Vega, Vega-Lite and Vega-Embed in one script, which leaves `vegaEmbed`."""
    try:
        import vl_convert
    except ImportError as problem:
        raise NoLibrary(f"vl-convert is not installed ({problem})") from problem
    bundle = vl_convert.javascript_bundle("window.vegaEmbed = vegaEmbed;")
    return bundle.replace("</script", "<\\/script")


def data(folder):
    """What the pictures show, in the units of their axes."""
    return {
        "loops": loops(folder),
        "varying": varying(folder),
        "film": film(folder),
        "lives": lives(folder),
        "map": running(folder),
        "mass": mass(folder),
    }


def loops(folder):
    table = read(folder / "ball_loops.csv")
    displacement, force, exact = (
        table[name] for name in ("displacement (m)", "tangential_force (N)", "closed_form (N)")
    )
    lines, points = [], []
    for theta in dict.fromkeys(table["theta"]):
        here = table["theta"] == theta
        rows = zip(*(rounded(column[here]) for column in (displacement * MICRO, force, exact)))
        of_loop = [
            {"theta": f"{theta:g}", "n": n, "u": u, "t": t, "e": e}
            for n, (u, t, e) in enumerate(rows)
        ]
        lines += [{key: row[key] for key in ("theta", "n", "u", "t")} for row in of_loop]
        points += [
            {key: row[key] for key in ("theta", "u", "e")}
            for row in of_loop[:: max(1, len(of_loop) // 25)]
        ]
    return {"lines": lines, "points": points, "limit": Sphere().limit}


def varying(folder):
    """Loops under a load that varies with the motion: the last cycle of each phase."""
    table = read(folder / "ball_varying_load.csv")
    columns = {"u": "displacement (m)", "t": "tangential_force (N)", "load": "normal_force (N)"}
    time = table["time (cycles)"]
    rows = []
    for phase in dict.fromkeys(table["load"]):
        here = (table["load"] == phase) & (time >= time.max() - 1 - 1e-6)
        scaled = (
            table[name][here] * (MICRO if key == "u" else 1.0) for key, name in columns.items()
        )
        for n, values in enumerate(zip(*map(rounded, scaled))):
            rows.append({"phase": str(phase), "n": n} | dict(zip(columns, values)))
    return rows


def lives(folder):
    """The worn profile of each case at its stops, in µm."""
    table = read(folder / "lives.csv")
    cases = []
    for name in dict.fromkeys(table["case"]):
        own = table["case"] == name
        curves = []
        for stop in dict.fromkeys(table["life (N/N0)"][own]):
            here = own & (table["life (N/N0)"] == stop)
            radius, unworn, worn, pressure = (
                table[column][here]
                for column in ("radius (m)", "unworn_height (m)", "worn_depth (m)", "pressure (Pa)")
            )
            columns = radius * MICRO, (unworn + worn) * MICRO, worn * MICRO, pressure * GIGA
            for r, h, w, p in zip(*map(rounded, columns)):
                row = {"stop": f"{stop:g}", "r": r, "h": h, "w": w}
                # at the apex of an unworn cone the pressure is infinite
                curves.append(row | ({"p": p} if np.isfinite(p) else {}))
        cases.append({"name": str(name), "curves": curves})
    return cases


def film(folder):
    """Of each life: a frame for every step that was written, and the unworn body."""
    fields, history = read(folder / "worn_tip_film.csv"), read(folder / "worn_tip_history.csv")
    lives = []
    for regime in worn_tip.REGIMES:
        rows = history["regime"] == regime.name
        states = {
            name.split(" (")[0]: column[rows]
            for name, column in history.items()
            if name != "regime"
        }
        own = fields["regime"] == regime.name
        frames = []
        for n, cycles in enumerate(states["cycles"]):
            here = own & (fields["cycles"] == cycles)
            radius, unworn, worn, pressure = (
                fields[name][here]
                for name in ("radius (m)", "unworn_height (m)", "worn_depth (m)", "pressure (Pa)")
            )
            columns = {
                "r": radius * MICRO,
                "f": unworn * MICRO,
                "h": (unworn + worn) * MICRO,
                "p": pressure * GIGA,
            }
            scalars = {
                "cycles": cycles,
                "volume": states["wear_volume"][n] * CUBIC,
                "depth": states["wear_depth"][n] * MICRO,
                "contact": states["contact_radius"][n] * MICRO,
                "stick": states["stick_radius"][n] * MICRO,
            }
            frames.append(
                {name: rounded([value])[0] for name, value in scalars.items()}
                | {name: rounded(column) for name, column in columns.items()}
            )
        reach = 1.12 * states["contact_radius"].max()
        radius = np.linspace(0, reach, 60)
        peaks = [max(frame["p"]) for frame in frames]
        lives.append(
            {
                "name": regime.name,
                "amplitude": regime.amplitude * MICRO,
                "frames": frames,
                "unworn": [
                    {"r": r, "f": f}
                    for r, f in zip(
                        rounded(radius * MICRO), rounded(worn_tip.unworn_height(radius) * MICRO)
                    )
                ],
                "reach": reach * MICRO,
                # at a stick edge that no longer moves the pressure is singular
                "top": float(min(1.05 * max(peaks), max(1.25 * peaks[0], 1.6 * np.median(peaks)))),
            }
        )
    return lives


def running(folder):
    table = read(folder / "running_map.csv")
    loads, amplitudes = (edges(table[name]) for name in ("load (N)", "amplitude (m)"))
    fields = []
    for n in range(table["load (N)"].size):
        load, amplitude = table["load (N)"][n], table["amplitude (m)"][n]
        place = np.searchsorted(loads, load), np.searchsorted(amplitudes, amplitude)
        values = {
            "n": load,
            "u": amplitude * MICRO,
            "n1": loads[place[0] - 1],
            "n2": loads[place[0]],
            "u1": amplitudes[place[1] - 1] * MICRO,
            "u2": amplitudes[place[1]] * MICRO,
            "v": table["wear_volume (m3)"][n] * CUBIC,
            "d": table["wear_depth (m)"][n] * MICRO,
        }
        fields.append({"regime": table["regime"][n]} | dict(zip(values, rounded(values.values()))))
    fine = np.geomspace(loads[0], loads[-1], 40)
    bounds = [
        {"line": name, "n": n, "u": u}
        for name, line in zip(
            ("5 % of the radius slips", "gross slip"), running_map.boundaries(fine)
        )
        for n, u in zip(rounded(fine), rounded(line * MICRO))
        if amplitudes[0] <= u / MICRO <= amplitudes[-1]
    ]
    return {"fields": fields, "bounds": bounds, "cycles": running_map.CYCLES}


def edges(middles):
    """Of fields that are evenly spaced in the logarithm, from their middles."""
    middles = np.unique(middles)
    half = np.sqrt(middles[1] / middles[0])
    return np.append(middles[0] / half, middles * half)


def mass(folder):
    """Per period: largest displacement and normal force; some loops of the joint."""
    table = read(folder / "shaken_mass.csv")
    time, displacement, force = (
        table[name] for name in ("time (s)", "displacement (m)", "tangential_force (N)")
    )
    steps = round(1 / (RIG.frequency * (time[1] - time[0])))
    count = (time.size - 1) // steps
    of_periods = displacement[1:].reshape(count, steps) * MICRO
    swing = [
        {"t": t, "low": low, "high": high, "load": load}
        for t, low, high, load in zip(
            rounded((np.arange(count) + 0.5) / RIG.frequency),
            rounded(of_periods.min(axis=1)),
            rounded(of_periods.max(axis=1)),
            rounded(table["load (N)"][steps::steps]),
        )
    ]
    shown = np.unique(np.linspace(min(count // 4, 15), count, LOOPS_SHOWN).astype(int))
    of_joint = [
        {"after": f"{last / RIG.frequency:.2f} s", "n": n, "u": u, "t": t}
        for last in shown
        for cycle in [slice((last - 1) * steps, last * steps + 1)]
        for n, (u, t) in enumerate(zip(rounded(displacement[cycle] * MICRO), rounded(force[cycle])))
    ]
    return {"swing": swing, "loops": of_joint}


def numbers(path):
    """Rows of an HTML table: results and expected values."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    lines, case = [], None
    for row in rows:
        if row["case"] != case:
            case = row["case"]
            lines.append(f'<tr><th colspan="4" scope="rowgroup">{html.escape(case)}</th></tr>')
        expected = f"{float(row['expected']):.5g}" if row["expected"] else ""
        deviation = f"{float(row['relative_deviation']):+.0e}" if row["expected"] else ""
        cells = f"{float(row['value']):.5g} {row['unit']}", expected, deviation
        text = "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
        lines.append(f'<tr><th scope="row">{html.escape(row["quantity"])}</th>{text}</tr>')
    return "\n".join(lines)


def read(path):
    """{header: column} of a CSV file, numbers as arrays of floats."""
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    table = {}
    for name, column in zip(header, zip(*rows)):
        try:
            table[name] = np.array(column, dtype=float)
        except ValueError:
            table[name] = np.array(column)
    return table


def rounded(values):
    """Six digits, as plain floats."""
    return [float(f"{value:.6g}") for value in values]


if __name__ == "__main__":
    print(write(Path(sys.argv[1])))
