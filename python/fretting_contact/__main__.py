"""The command line: python -m fretting_contact demo | life | calibrate | profile."""

import argparse
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from . import Contact, ContactError, ContactWarning, ParameterError, life, loop
from .command_errors import check_output, finite, report, whole
from .quantities import in_si


def _value(text: str) -> tuple[str, Any]:
    """name=value as given on the command line."""
    name, separator, value = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError(f'{text!r}: give NAME=VALUE, such as radius="10 mm"')
    try:
        return name, int(value)
    except ValueError:
        pass
    try:
        return name, float(value)
    except ValueError:
        return name, value


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m fretting_contact", description="Friction and wear of a fretting contact."
    )
    commands = parser.add_subparsers(dest="command", required=True)

    demo = commands.add_parser(
        "demo",
        help="a friction loop and the wear of 100,000 cycles; pictures if matplotlib is there",
    )
    demo.add_argument(
        "-o",
        "--output",
        type=Path,
        default=Path("."),
        help="folder of the pictures (default: this one)",
    )

    wear = commands.add_parser("life", help="wear of a contact over many cycles as a table")
    wear.add_argument(
        "--cycles", type=finite, default=1e5, help="number of cycles (default: 100000)"
    )
    wear.add_argument("--rows", type=whole, default=10, help="rows of the table (default: 10)")
    wear.add_argument("-o", "--output", type=Path, help="CSV file to write")

    fit = commands.add_parser(
        "calibrate", help="friction, rig stiffness and wear coefficient from a measured loop"
    )
    fit.add_argument(
        "loop",
        type=Path,
        help="two columns: displacement of the drive and tangential force, evenly in time",
    )
    fit.add_argument("--normal-force", required=True, help='such as "100 N"')
    fit.add_argument("--loop-cycles", type=whole, default=1, help="cycles in the file (default: 1)")
    fit.add_argument("--displacement-unit", default="m", choices=["m", "mm", "um", "nm"])
    fit.add_argument("--force-unit", default="N", choices=["N", "mN", "kN"])
    fit.add_argument("--volume", help='worn volume of a wear test, such as "0.01 mm3"')
    fit.add_argument("--amplitude", help='of the drive in the wear test, such as "8 um"')
    fit.add_argument("--cycles", type=finite, help="of the wear test")
    fit.add_argument(
        "-o", "--output", type=Path, help="picture of the measured and the fitted loop"
    )

    for command in wear, fit:
        command.add_argument(
            "parameters",
            nargs="*",
            type=_value,
            metavar="NAME=VALUE",
            help='such as radius="10 mm"',
        )
    commands.add_parser(
        "profile",
        help="a profile table from a measured line scan; --help for its arguments",
        add_help=False,
    )
    return parser


def _demo(options: argparse.Namespace) -> None:
    options.output.mkdir(parents=True, exist_ok=True)
    amplitude = 1.5e-6
    with Contact(radius="10 mm", normal_force=100.0) as contact:
        one = loop(contact, amplitude)
    with Contact(
        radius="10 mm", normal_force=100.0, displacement_amplitude=amplitude, loading="cyclic"
    ) as contact:
        worn = life(contact, 1e5)
    print("a steel ball of 10 mm radius on a steel flat, 100 N, cycles of +-1.5 um")
    print(f"force amplitude          {one.force_amplitude:.2f} N")
    print(f"friction work of a cycle {one.work * 1e6:.2f} uJ")
    print(
        f"after 100,000 cycles     {worn.wear_volume[-1] * 1e9:.2e} mm3 worn, "
        f"{worn.wear_depth[-1] * 1e6:.2f} um deep"
    )
    try:
        import matplotlib
    except ImportError:
        print("no pictures: pip install fretting-contact[plot]")
        return
    matplotlib.use("Agg")  # draws to files; needs no display
    for name, axes in ("loop.png", one.plot()), ("life.png", worn.plot()[0]):
        axes.figure.savefig(options.output / name)
        print(f"picture                  {options.output / name}")


def _life(options: argparse.Namespace) -> None:
    check_output(options.output)
    if options.rows < 1 or not options.cycles > 0:
        raise ParameterError(
            f"--cycles = {options.cycles:g}, --rows = {options.rows}: give cycles above 0, and one "
            "row at least"
        )
    at = [options.cycles * k / options.rows for k in range(options.rows + 1)]
    with Contact(**{"loading": "cyclic", **dict(options.parameters)}) as contact:
        if contact.get("loading") != "cyclic":
            raise ParameterError(
                f"loading = {contact.get('loading')!r} is not allowed: the command life computes "
                "whole cycles, loading=cyclic; leave loading out"
            )
        worn = life(contact, options.cycles, at)
    print(f"{'cycles':>12} {'volume m3':>12} {'depth m':>12} {'force N':>12} {'stick m':>12}")
    for row in zip(
        worn.cycles, worn.wear_volume, worn.wear_depth, worn.tangential_force, worn.stick_radius
    ):
        print(" ".join(f"{value:12.5g}" for value in row))
    if options.output:
        worn.write_csv(options.output)


def _calibrate(options: argparse.Namespace) -> None:
    from . import MeasuredLoop, WornVolume, calibrate

    check_output(options.output)
    force = in_si(options.normal_force, "N", "--normal-force")
    units = in_si(f"1 {options.displacement_unit}", "m"), in_si(f"1 {options.force_unit}", "N")
    measured = MeasuredLoop.read(options.loop, force, options.loop_cycles, *units)
    of_test = (options.volume, options.amplitude, options.cycles)
    if any(of_test) and not all(of_test):
        raise ParameterError(
            "--volume, --amplitude and --cycles belong together: give all of them, or none"
        )
    volumes = []
    if all(of_test):
        volume, amplitude = (
            in_si(options.volume, "m3", "--volume"),
            in_si(options.amplitude, "m", "--amplitude"),
        )
        volumes = [WornVolume(volume, force, amplitude, options.cycles)]
    fit = calibrate(measured, volumes, **dict(options.parameters))
    print(fit)
    if options.output:
        try:
            import matplotlib
        except ImportError:
            print("picture: none, pip install fretting-contact[plot]")
            return
        matplotlib.use("Agg")
        fit.plot().figure.savefig(options.output)
        print(f"picture: {options.output}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command; returns the exit status."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["profile"]:
        try:
            from . import fit_scan  # noqa: F401 - says what to install where scipy is missing
            from .profile import main as profile
        except ImportError as problem:
            return report(problem)
        return profile(given[1:], "python -m fretting_contact profile")
    parser = _parser()
    options, rest = parser.parse_known_args(given)
    if rest and (options.command == "demo" or not all("=" in text for text in rest)):
        parser.error(f"unknown arguments: {' '.join(rest)}; --help lists those that there are")
    with warnings.catch_warnings():
        warnings.showwarning = _warning_printer(warnings.showwarning)
        try:
            if rest:  # argparse takes NAME=VALUE before the options only
                options.parameters += map(_value, rest)
            {"demo": _demo, "life": _life, "calibrate": _calibrate}[options.command](options)
        except (ContactError, ImportError, OSError, ValueError) as problem:
            return report(problem)
    return 0


def _warning_printer(of_others: Callable[..., None]) -> Callable[..., None]:
    """Prints a warning of the component in one line: no line of Python has led to it."""

    def show(message: Warning | str, category: type[Warning], *place: Any) -> None:
        if issubclass(category, ContactWarning):
            print(f"warning: {message}", file=sys.stderr)
        else:
            of_others(message, category, *place)

    return show


if __name__ == "__main__":
    sys.exit(main())
