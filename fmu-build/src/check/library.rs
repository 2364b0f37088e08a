//! The library in the archive: exported functions, file name and GUID.

use super::{Archive, Entry};
use anyhow::Result;
use object::BinaryFormat;
use object::read::{Export, NameOrOrdinal, Object};
use roxmltree::Node;
use std::collections::BTreeSet;

/// Functions of an FMI 2.0 co-simulation library, all required, even for what is declared unsupported.
pub(super) const FUNCTIONS: [&str; 34] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2SetDebugLogging",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2DoStep",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
];

/// What is wrong with the libraries of the archive.
pub(super) fn problems(archive: &Archive, root: Node<'_, '_>) -> Vec<String> {
    let guid = root.attribute("guid").unwrap_or_default();
    let identifier = root
        .children()
        .find(|node| node.has_tag_name("CoSimulation"))
        .and_then(|node| node.attribute("modelIdentifier"))
        .unwrap_or_default();
    let mut problems = Vec::new();
    for (_, file, entry) in archive.libraries() {
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        if stem != identifier {
            problems.push(format!(
                "modelIdentifier is {identifier:?}, but the library is {}: give them one name",
                entry.name
            ));
        }
        problems.extend(symbol_problems(entry));
        if !guid.is_empty() && !contains(&entry.bytes, guid.as_bytes()) {
            problems.push(format!(
                "GUID {guid} of modelDescription.xml is not in {}: build both from one modelDescription.xml",
                entry.name
            ));
        }
    }
    problems
}

fn symbol_problems(entry: &Entry) -> Vec<String> {
    let (format, exported) = match exported_symbols(&entry.bytes) {
        Ok(found) => found,
        Err(error) => return vec![format!("{} cannot be read as a shared library: {error}", entry.name)],
    };
    let expected: BTreeSet<String> = FUNCTIONS.iter().map(|&function| function.to_owned()).collect();
    let list = |names: Vec<&String>| names.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ");
    let missing = list(expected.difference(&exported).collect());
    let extra = list(exported.difference(&expected).collect());
    let mut problems = Vec::new();
    if !missing.is_empty() {
        problems.push(format!("{} does not export {missing}: add them to the C interface", entry.name));
    }
    if !extra.is_empty() && names_are_shared(format) {
        problems.push(format!("{} exports {extra} beyond the FMI functions: hide them", entry.name));
    }
    problems
}

/// Whether libraries in one process see each other's names. Those of a DLL are its own, and rustc exports from it whatever a
/// dependency marks so.
fn names_are_shared(format: BinaryFormat) -> bool {
    format != BinaryFormat::Pe
}

/// Format of a shared library, and the names a loader can find in it.
fn exported_symbols(bytes: &[u8]) -> Result<(BinaryFormat, BTreeSet<String>)> {
    let file = object::File::parse(bytes)?;
    // Mach-O puts an underscore before C names.
    let prefix = if file.format() == BinaryFormat::MachO { "_" } else { "" };
    let name = |export: Export<'_>| match export.name() {
        NameOrOrdinal::Name(raw) => {
            let text = String::from_utf8_lossy(raw);
            text.strip_prefix(prefix).unwrap_or(&text).to_owned()
        }
        NameOrOrdinal::Ordinal(number) => format!("#{number}"),
    };
    let names = file.exports()?.map(|export| Ok(name(export?))).collect::<object::Result<_>>()?;
    Ok((file.format(), names))
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{self, Fixture, LIBRARY_ENTRY, compile};
    use super::FUNCTIONS;

    fn with_functions(functions: &[&str]) -> Fixture {
        fixture::good().with_file(LIBRARY_ENTRY, &compile(functions, fixture::GUID))
    }

    #[test]
    fn names_of_a_dll_are_its_own() {
        use object::BinaryFormat::{Elf, MachO, Pe};
        assert_eq!([Elf, MachO, Pe].map(super::names_are_shared), [true, true, false]);
    }

    #[test]
    fn missing_functions_are_named() {
        let some: Vec<&str> =
            FUNCTIONS.into_iter().filter(|name| !["fmi2DoStep", "fmi2Reset"].contains(name)).collect();
        with_functions(&some).assert_refused(&["does not export fmi2DoStep, fmi2Reset:"]);
    }

    #[test]
    fn strangers_among_the_exports_are_named() {
        let mut more = FUNCTIONS.to_vec();
        more.push("callback_log");
        with_functions(&more).assert_refused(&["exports callback_log beyond"]);
    }

    #[test]
    fn a_library_that_is_none_is_refused() {
        let fixture = fixture::good().with_file(LIBRARY_ENTRY, fixture::GUID.as_bytes());
        fixture.assert_refused(&["cannot be read as a shared library"]);
    }

    #[test]
    fn another_model_identifier_is_refused() {
        let fixture =
            fixture::good().replacing("modelIdentifier=\"FrettingContact\"", "modelIdentifier=\"Other\"");
        fixture.assert_refused(&["modelIdentifier is \"Other\"", "FrettingContact.so"]);
    }

    #[test]
    fn another_guid_is_refused() {
        let fixture = fixture::good().replacing(fixture::GUID, "{another}");
        fixture.assert_refused(&["GUID {another}", "FrettingContact.so"]);
    }
}
