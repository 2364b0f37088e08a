//! The library in the archive: exported functions, file name and GUID.

use super::{Archive, Entry};
use crate::workspace::Workspace;
use anyhow::Result;
use object::elf::{DT_NEEDED, Dyn64};
use object::read::elf::Dyn;
use object::read::{Export, NameOrOrdinal, Object};
use object::{BinaryFormat, Endianness};
use roxmltree::Node;
use std::collections::BTreeSet;

/// Functions of an FMI 2.0 co-simulation library, all required, even for what is declared
/// unsupported.
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
        problems.extend(dependency_problems(entry));
        problems.extend(path_problems(entry));
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

/// What every Linux has, without the loader itself.
const ALLOWED: [&str; 6] =
    ["libc.so.6", "libm.so.6", "libgcc_s.so.1", "libpthread.so.0", "libdl.so.2", "librt.so.1"];

fn dependency_problems(entry: &Entry) -> Vec<String> {
    let needed = needed_libraries(&entry.bytes).unwrap_or_default();
    let strange =
        needed.iter().filter(|name| !ALLOWED.contains(&name.as_str()) && !name.starts_with("ld-linux"));
    let problem = |name| format!("{} needs {name}, which a machine may not have: do not link it", entry.name);
    strange.map(problem).collect()
}

/// Libraries that the loader of Linux has to find beside this one.
fn needed_libraries(bytes: &[u8]) -> Result<Vec<String>> {
    let object::File::Elf64(file) = object::File::parse(bytes)? else { return Ok(Vec::new()) };
    let (endian, sections) = (file.endian(), file.elf_section_table());
    let Some((entries, strings)) = sections.dynamic(endian, bytes)? else { return Ok(Vec::new()) };
    let strings = sections.strings(endian, bytes, strings)?;
    let needed =
        entries.iter().filter(|entry| entry.tag32(endian).is_some_and(|tag| i64::from(tag) == DT_NEEDED.0));
    let name =
        |entry: &Dyn64<Endianness>| Ok(String::from_utf8_lossy(entry.string(endian, strings)?).into_owned());
    needed.map(name).collect()
}

/// Directories of this machine. They would disclose its folders and user names, and make each build
/// different.
fn path_problems(entry: &Entry) -> Vec<String> {
    let home = std::env::home_dir().filter(|home| home.components().count() > 1);
    let root = Workspace::of_this_program().root().to_path_buf();
    let directories = home.into_iter().chain([root]).map(|directory| format!("{}/", directory.display()));
    let inside = directories.filter(|directory| contains(&entry.bytes, directory.as_bytes()));
    inside.map(|directory| format!("{} contains paths of {directory}: remap them", entry.name)).collect()
}

/// The newest version of glibc that a library asks for, such as (2, 17); none if it asks for none.
pub(crate) fn newest_glibc(bytes: &[u8]) -> Option<(u32, u32)> {
    const MARK: &[u8] = b"GLIBC_";
    let version = |at: usize| {
        let text: String = bytes[at + MARK.len()..]
            .iter()
            .map_while(|b| b.is_ascii_graphic().then_some(*b as char))
            .collect();
        let mut numbers = text.split('.').map(str::parse);
        Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
    };
    let marks = bytes.windows(MARK.len()).enumerate().filter(|(_, window)| *window == MARK);
    marks.filter_map(|(at, _)| version(at)).max()
}

/// Whether libraries in one process see each other's names. Those of a DLL are its own, and rustc
/// exports from it whatever a dependency marks so.
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
    use super::super::fixture::{self, Fixture, LIBRARY_ENTRY, compile, compile_with};
    use super::{FUNCTIONS, newest_glibc};

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
    fn unknown_exports_are_named() {
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
    fn a_library_that_few_machines_have_is_named() {
        let folder = std::env::temp_dir().join(format!("fmu-build-test-needed-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let other = folder.join("libother.so");
        std::fs::write(&other, compile(&["other"], "")).unwrap();
        let needs = ["-Wl,--no-as-needed", other.to_str().unwrap()];
        let library = compile_with(&FUNCTIONS, fixture::GUID, &needs);
        let fixture = fixture::good().with_file(LIBRARY_ENTRY, &library);
        fixture.assert_refused(&["libother.so", "which a machine may not have"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn paths_of_this_machine_are_named() {
        let home = std::env::home_dir().unwrap().join("somewhere/source.rs");
        let text = format!("{} {}", fixture::GUID, home.display());
        let fixture = fixture::good().with_file(LIBRARY_ENTRY, &compile(&FUNCTIONS, &text));
        fixture.assert_refused(&["contains paths of", "remap"]);
    }

    #[test]
    fn the_newest_glibc_is_found() {
        let names = b"..GLIBC_2.2.5\0GLIBC_2.17\0GLIBC_2.4\0GLIBC_PRIVATE\0";
        assert_eq!(newest_glibc(names), Some((2, 17)));
        assert_eq!(newest_glibc(b"GLIBC"), None);
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
