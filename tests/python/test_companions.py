"""Files in the FMU beside the model: terminals, reference results, documentation, licences."""

import io
import re
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree

SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"
PARAMETERS = Path(fmpy.__file__).parent / "ssp" / "schema" / "SystemStructureParameterValues.xsd"
REFERENCE = "extra/org.fmi-standard.fmi-ls-ref"
LAYERED = "{http://fmi-standard.org/fmi-ls-manifest}"


@pytest.fixture(scope="module")
def archive(fmu_path):
    with zipfile.ZipFile(fmu_path) as opened:
        yield opened


def xml(archive, name):
    return etree.fromstring(archive.read(name))


def table(archive, name):
    return np.genfromtxt(
        io.BytesIO(archive.read(f"{REFERENCE}/{name}")), delimiter=",", names=True, ndmin=1
    )


def test_terminals_are_valid_and_speak_of_variables(archive, fmu):
    document = xml(archive, "terminalsAndIcons/terminalsAndIcons.xml")
    etree.XMLSchema(etree.parse(str(SCHEMAS / "fmi3TerminalsAndIcons.xsd"))).assertValid(document)
    members = [node.get("variableName") for node in document.iter("TerminalMemberVariable")]
    assert len(members) == len(set(members)) > 0
    ports = {v.name for v in fmu.variables.values() if v.causality == "input"}
    assert ports <= set(members) <= set(fmu.variables)


def test_the_icon_is_a_picture(archive):
    assert archive.read("terminalsAndIcons/icon.png") == archive.read("model.png")
    assert archive.read("model.png").startswith(b"\x89PNG")


def test_the_manifest_names_its_standard_and_its_files(archive):
    manifest = xml(archive, f"{REFERENCE}/fmi-ls-manifest.xml")
    assert manifest.tag == "fmiReferences"
    assert manifest.get(f"{LAYERED}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    related = [node.get("source") for node in manifest]
    assert "closed-forms.exp" in related
    for source in related:
        name = str((Path("/") / REFERENCE / source).resolve())[1:]
        assert name in archive.namelist(), source


# What the schemas of the layered standard (github.com/modelica/fmi-ls-ref, schema/) allow: no
# package brings them.
MANIFEST_RULES = {
    "fmiReferences": (
        {f"{LAYERED}fmi-ls-{name}" for name in ("name", "version", "description")},
        set(),
        ["Related"],
    ),
    "Related": ({"source", "role"}, {"type", "description", "checksum", "checksumType"}, ["Label"]),
}
EXPERIMENT_RULES = {
    "Experiments": ({"name"}, {"description"}, ["Experiment"]),
    "Experiment": (
        {"name"},
        {"description", "startTime", "stopTime", "tolerance", "stepSize"},
        ["Parameters", "Stimuli", "References"],
    ),
    **dict.fromkeys(("Parameters", "Stimuli", "References"), ({"source"}, {"type"}, [])),
}
ROLES = re.compile(
    "document|requirement|specification|model|parameter|system|testcase|experiment(/(smoke-test|validation|uncertainty-analysis))?"
    "|result|method|rationale|report|request|delivery|configuration|signature|serialized-state(/.*)?|meta-data|other"
)


def keeps_to(rules, node):
    """Elements in their order, attributes that have to be there and that may be."""
    needed, allowed, children = rules[node.tag]
    assert needed <= set(node.keys()) <= needed | allowed, node.tag
    places = [children.index(child.tag) for child in node]
    assert places == sorted(places), node.tag
    for child in node:
        keeps_to(rules, child)


def test_manifest_and_experiments_keep_to_the_layered_standard(archive):
    manifest = xml(archive, f"{REFERENCE}/fmi-ls-manifest.xml")
    keeps_to(MANIFEST_RULES, manifest)
    assert all(ROLES.fullmatch(node.get("role")) for node in manifest)
    purpose = "Layered Standard providing information on related files included in an FMU."
    assert manifest.get(f"{LAYERED}fmi-ls-description") == purpose
    experiments = xml(archive, f"{REFERENCE}/closed-forms.exp")
    keeps_to(EXPERIMENT_RULES, experiments)
    for experiment in experiments:
        [float(experiment.get(name)) for name in ("startTime", "stopTime", "tolerance", "stepSize")]


def test_parameter_values_are_valid_by_the_schema_of_ssp(archive):
    schema = etree.XMLSchema(etree.parse(str(PARAMETERS)))
    names = [name for name in archive.namelist() if name.endswith(".ssv")]
    assert names
    for name in names:
        schema.assertValid(xml(archive, name))


def start_values(archive, experiment):
    """Parameters of an experiment; enumerations by the name of their item."""
    parameters = experiment.find("Parameters")
    if parameters is None:
        return {}
    nodes = xml(archive, f"{REFERENCE}/{parameters.get('source')}").iter("{*}Parameter")
    return {node.get("name"): node[0].get("value") for node in nodes}


def set_at_the_start(fmu_path, _, parameters, stimuli, columns, stop, step):
    """FMPy sets inputs at the start of a step."""
    found = fmpy.simulate_fmu(
        str(fmu_path),
        stop_time=stop,
        output_interval=step,
        start_values=parameters,
        input=stimuli,
        output=list(columns),
    )
    return {name: found[name] for name in ("time", *columns)}


def arriving_at_the_end(_, start_contact, parameters, stimuli, columns, stop, step):
    """A master that knows where the inputs are at the end of a step."""
    names = stimuli.dtype.names[1:]
    inputs = lambda time: {name: np.interp(time, stimuli["time"], stimuli[name]) for name in names}  # noqa: E731
    contact = start_contact(**parameters, **inputs(0.0))
    times = np.arange(0.0, stop + step / 2, step)
    rows = [[contact.get(name) for name in columns]]
    for time in times[1:]:
        contact.step(step, **inputs(time))
        rows.append([contact.get(name) for name in columns])
    return {"time": times} | dict(zip(columns, np.array(rows).T))


@pytest.mark.parametrize("master", [set_at_the_start, arriving_at_the_end])
@pytest.mark.parametrize("name", ["loop", "life"])
def test_the_fmu_gives_the_reference_results(archive, fmu, start_contact, fmu_path, name, master):
    experiments = xml(archive, f"{REFERENCE}/closed-forms.exp")
    experiment = next(node for node in experiments if node.get("name") == name)
    results = table(archive, experiment.find("References").get("source"))
    stimuli = table(archive, experiment.find("Stimuli").get("source"))
    columns = results.dtype.names[1:]
    items = {
        item.name: int(item.value)
        for v in fmu.variables.values()
        if v.declaredType
        for item in v.declaredType.items
    }
    parameters = {key: items[value] for key, value in start_values(archive, experiment).items()}
    stop, step, tolerance = (
        float(experiment.get(key)) for key in ("stopTime", "stepSize", "tolerance")
    )
    found = master(fmu_path, start_contact, parameters, stimuli, columns, stop, step)
    for column in columns:
        at_times = np.interp(results["time"], found["time"], found[column])
        scale = np.max(np.abs(results[column]))
        assert np.max(np.abs(at_times - results[column])) <= tolerance * scale, column


def test_every_variable_is_documented_with_its_unit(archive, fmu):
    page = archive.read("documentation/index.html").decode()
    for variable in fmu.variables.values():
        array, _, index = variable.name.partition("[")
        if index not in ("", "1]"):
            continue
        shown = re.search(rf"<td><code>{array}(?:\[1\][^<]*)?</code></td><td>([^<]*)</td>", page)
        assert shown, variable.name
        assert shown[1] == (variable.unit or "").replace("m3", "m³"), variable.name
        if variable.declaredType:
            for item in variable.declaredType.items:
                assert f"<li>{item.value} = <code>{item.name}</code>" in page, item.name
    text = page.split("<h2>Variables</h2>")[0]
    fields = {name.split("[")[0] for name in fmu.variables if "[" in name}
    for name in (*fields, "contacts_file", "rotation", "running_in_energy", "coating_thickness"):
        assert f"<code>{name}</code>" in text, name
    for heading in (
        "Model",
        "Limits of validity",
        "Resolution and tolerance",
        "Variables",
        "Licence",
    ):
        assert f"<h2>{heading}</h2>" in page
    links = re.findall(r'href="([^":]+)"', page)
    assert links and all(f"documentation/{link}" in archive.namelist() for link in links)


def test_every_library_in_it_has_its_licence(archive):
    text = archive.read("documentation/licenses/third-party.txt").decode()
    for crate in ("nalgebra", "serde", "libm", "fmi-sys"):
        assert re.search(rf"^{crate} \d", text, re.MULTILINE), crate
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        assert archive.read(f"documentation/licenses/{name}").strip()
