"""The Modelica package around the imported FMU, compiled and simulated by Rumoca.

The FMU itself is replaced by a spring in series with a slider, for which there are closed forms.
"""

import math
import re

import numpy as np
import pytest
from conftest import ROOT

rumoca = pytest.importorskip(
    "rumoca", reason="Rumoca is not installed: see tests/python/tools-requirements.txt"
)

PACKAGE = ROOT / "examples" / "modelica" / "FrettingJoint.mo"
#: The classes of the Modelica Standard Library that the package uses: no registry has the library.
LIBRARY = ROOT / "tests" / "python" / "modelica" / "Modelica.mo"
STIFFNESS = 35.47e6  # N/m, of the stand-in
LIMIT = 60.0  # N, friction coefficient 0.6 and load 100 N


def compiled(model, source=None):
    """A model of the package, or of a source that uses the package."""
    if source is None:
        return rumoca.Session(roots=[str(LIBRARY)]).load(PACKAGE, model=f"FrettingJoint.{model}")
    return rumoca.Session(roots=[str(LIBRARY), str(PACKAGE)]).loads(source, model=model)


def simulated(model, source=None, stop=0.1):
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-15, dt=1e-5)
    result = compiled(model, source).simulate(t=(0.0, stop), config=config)
    names = ("time", "joint.force", "joint.tangential_displacement")
    return {name: np.array(result.time if name == "time" else result[name]) for name in names}


def names_in(text, indentation):
    """Models that stand at an indentation."""
    return re.findall(rf"^{indentation}model (\w+)", text, re.MULTILINE)


@pytest.mark.parametrize("name", names_in(PACKAGE.read_text(), "  "))
def test_components_are_balanced(name):
    structure = compiled(name).structure()
    assert structure.is_balanced and structure.n_equations == structure.n_unknowns


@pytest.mark.parametrize("name", names_in(PACKAGE.read_text(), "    "))
def test_examples_are_balanced_and_slip(name):
    model = f"Examples.{name}"
    structure = compiled(model).structure()
    assert structure.is_balanced and structure.is_matched
    force = simulated(model)["joint.force"]
    assert force.max() == pytest.approx(LIMIT, rel=1e-12)
    assert force.min() == pytest.approx(-LIMIT, rel=1e-12)


def test_a_spring_in_series_is_the_rig_stiffness():
    """The spring has no mass: without the tangent there would be an algebraic loop over the FMU."""
    spring = simulated("Examples.SpringAndJoint")
    rig = simulated("Examples.RigAndJoint")
    assert spring["time"] == pytest.approx(rig["time"])
    difference = np.abs(spring["joint.force"] - rig["joint.force"])
    step = 1e-5 * 2 * math.pi * 10 * 5e-6  # m, longest way of the drive in a step
    assert difference.max() < 2 * step / (1 / 24e6 + 1 / STIFFNESS)


SUPPORT = """
  Modelica.Mechanics.Translational.Components.Fixed ground;
  Modelica.Mechanics.Translational.Sources.Force drive;
  Modelica.Blocks.Sources.Constant signal(k = 20);
  Modelica.Blocks.Sources.Constant load(k = 100);
equation
  connect(load.y, fmu.normal_force);
  connect(load.y, joint.normal_force);
  connect(joint.tangential_displacement, fmu.tangential_displacement);
  connect(fmu.tangential_force, joint.tangential_force);
  connect(fmu.tangential_stiffness, joint.tangential_stiffness);
  connect(fmu.contact_displacement, joint.contact_displacement);
  connect(signal.y, drive.f);
  connect(drive.flange, joint.flange_a);
  connect(ground.flange, joint.flange_b);
"""


def error_of_an_oscillation(step, support):
    """A force acts suddenly on 1 kg, which the contact holds; relative to the largest value."""
    model = f"""
model Suddenly
  FrettingJoint.StandIn fmu(communication_step = {step});
  FrettingJoint.JointWithMass joint(m = 1);
{support}
end Suddenly;"""
    found = simulated("Suddenly", model, stop=0.01)
    exact = 20 / STIFFNESS * (1 - np.cos(math.sqrt(STIFFNESS) * found["time"]))
    return np.abs(found["joint.tangential_displacement"] - exact).max() / exact.max()


def test_a_mass_oscillates_on_the_sticking_contact():
    """Also with 1 ms, three times the longest step of the explicit coupling, 2/omega."""
    assert error_of_an_oscillation(1e-5, SUPPORT) < 1e-3
    assert error_of_an_oscillation(1e-3, SUPPORT) < 1e-3


def test_without_the_tangent_the_same_step_is_unstable():
    held = SUPPORT.replace(
        "connect(fmu.tangential_stiffness, joint.tangential_stiffness)",
        "joint.tangential_stiffness = 0",
    )
    assert held != SUPPORT
    assert error_of_an_oscillation(1e-3, held) > 10


def imported(fmu):
    """What a tool makes of the FMU: a block with its real parameters, inputs and outputs."""
    lines = ["block FrettingContact_fmu"]
    for variable in fmu.variables.values():
        if variable.type != "Real" or variable.causality == "local":
            continue
        kind = {
            "parameter": "parameter Real",
            "input": "Modelica.Blocks.Interfaces.RealInput",
            "output": "Modelica.Blocks.Interfaces.RealOutput",
        }[variable.causality]
        start = f" = {float(variable.start)}" if variable.causality == "parameter" else ""
        lines.append(f"  {kind} {variable.name}{start};")
        if variable.causality == "output":
            given = {
                "tangential_stiffness": "1e6",
                "contact_displacement": "tangential_displacement",
            }
            given["tangential_force"] = "1e6 * tangential_displacement"
            lines.append(f"equation\n  {variable.name} = {given.get(variable.name, '0')};\npublic")
    return "\n".join([*lines, "end FrettingContact_fmu;"])


def test_the_joint_fits_the_imported_fmu(fmu):
    """Names and causalities are those of modelDescription.xml; the other inputs are constant."""
    others = [
        name
        for name, variable in fmu.variables.items()
        if variable.causality == "input" and name not in ("normal_force", "tangential_displacement")
    ]
    constants = "".join(f"  fmu.{name} = 0;\n" for name in others)
    model = f"""
{imported(fmu)}
model WithImported
  FrettingContact_fmu fmu;
  FrettingJoint.JointWithMass joint(m = 1);
{SUPPORT}{constants}
end WithImported;"""
    structure = compiled("WithImported", model).structure()
    assert structure.is_balanced and structure.is_matched
    found = simulated("WithImported", model, stop=0.01)
    exact = 20 / 1e6 * (1 - np.cos(1e3 * found["time"]))
    assert np.abs(found["joint.tangential_displacement"] - exact).max() < 1e-3 * exact.max()


def test_the_machine_of_the_guide_compiles():
    page = (ROOT / "docs" / "openmodelica.md").read_text(encoding="utf-8")
    machine = re.search(r"```modelica\n(.*?)```", page, re.DOTALL)[1]
    structure = compiled("Machine", machine).structure()
    assert structure.is_balanced and structure.n_states == 2


def test_the_connections_of_the_guide_are_those_of_the_examples():
    page = (ROOT / "docs" / "modelica.md").read_text(encoding="utf-8")
    (shown,) = re.findall(r"```modelica\n(.*?)```", page, re.DOTALL)
    for line in shown.splitlines():
        assert PACKAGE.read_text().count(line) == 3, line


def test_a_name_that_does_not_exist_is_found():
    """Else the tests above would say little."""
    with pytest.raises(rumoca.CompileError):
        compiled(
            "Wrong", "model Wrong\n  FrettingJoint.Joint joint(no_such_parameter = 1);\nend Wrong;"
        )
