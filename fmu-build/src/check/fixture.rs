//! A small FMU, into which the tests of the checks put faults.

use super::archive::Archive;
use super::library::FUNCTIONS;
use super::problems;
use std::io::{Cursor, Write};
use std::process::Command;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// GUID of the small FMU.
pub(super) const GUID: &str = "{0e3c5f7a}";

/// Where the library lies.
pub(super) const LIBRARY_ENTRY: &str = "binaries/linux64/FrettingContact.so";

const DESCRIPTION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Small" guid="{0e3c5f7a}">
  <CoSimulation modelIdentifier="FrettingContact"/>
  <UnitDefinitions><Unit name="N"/><Unit name="m"/></UnitDefinitions>
  <TypeDefinitions>
    <SimpleType name="Length"><Real unit="m" min="0" max="2"/></SimpleType>
    <SimpleType name="State"><Enumeration><Item name="off" value="1"/><Item name="on" value="2"/></Enumeration></SimpleType>
  </TypeDefinitions>
  <ModelVariables>
    <ScalarVariable name="load" valueReference="0" causality="input"><Real unit="N" start="1"/></ScalarVariable>
    <ScalarVariable name="depth" valueReference="1" causality="output" initial="calculated"><Real unit="m"/></ScalarVariable>
    <ScalarVariable name="radius" valueReference="2" causality="parameter" initial="exact"><Real declaredType="Length" start="0.5"/></ScalarVariable>
    <ScalarVariable name="cells" valueReference="0" causality="parameter" initial="exact"><Integer min="8" max="64" start="16"/></ScalarVariable>
    <ScalarVariable name="state" valueReference="1" causality="parameter" initial="exact"><Enumeration declaredType="State" start="1"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="2" dependencies="1"/></Outputs>
    <InitialUnknowns><Unknown index="2" dependencies="1 3"/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"#;

/// The parts of the small FMU.
#[derive(Clone)]
pub(super) struct Fixture {
    description: String,
    /// Names and content of the other entries.
    files: Vec<(String, Vec<u8>)>,
    /// Names and targets of symbolic links.
    links: Vec<(&'static str, &'static str)>,
}

/// The small FMU without a fault.
pub(super) fn good() -> Fixture {
    static LIBRARY: OnceLock<Vec<u8>> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| compile(&FUNCTIONS, GUID)).clone();
    Fixture { description: DESCRIPTION.to_owned(), files: Vec::new(), links: Vec::new() }
        .with_file(LIBRARY_ENTRY, &library)
        .with_file("documentation/index.html", b"<html></html>")
        .with_file("model.png", b"picture")
}

impl Fixture {
    /// Adds a file, in place of one of the same name.
    pub(super) fn with_file(self, name: &str, content: &[u8]) -> Self {
        let mut changed = self.without_file(name);
        changed.files.push((name.to_owned(), content.to_vec()));
        changed
    }

    pub(super) fn without_file(mut self, name: &str) -> Self {
        self.files.retain(|(file, _)| file != name);
        self
    }

    pub(super) fn with_link(mut self, name: &'static str, target: &'static str) -> Self {
        self.links.push((name, target));
        self
    }

    pub(super) fn with_description(mut self, text: &str) -> Self {
        self.description = text.to_owned();
        self
    }

    /// Changes a text that must stand in the description.
    #[track_caller]
    pub(super) fn replacing(mut self, old: &str, new: &str) -> Self {
        assert!(self.description.contains(old), "the small FMU has no {old}");
        self.description = self.description.replace(old, new);
        self
    }

    /// The archive as the checks see it.
    pub(super) fn read(&self) -> Archive {
        Archive::read(Cursor::new(self.bytes())).unwrap()
    }

    /// Asserts that the checks find one problem, whose message has all these words.
    #[track_caller]
    pub(super) fn assert_refused(&self, words: &[&str]) {
        let found = problems(&self.read());
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(words.iter().all(|word| found[0].contains(word)), "{found:?}");
    }

    /// The zip file.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default();
        let description = ("modelDescription.xml".to_owned(), self.description.clone().into_bytes());
        for (name, content) in self.files.iter().chain([&description]) {
            zip.start_file(name.as_str(), options).unwrap();
            zip.write_all(content).unwrap();
        }
        for &(name, target) in &self.links {
            zip.add_symlink(name, target, options).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }
}

/// A shared library with these functions and the GUID in its data, made by the C compiler.
pub(super) fn compile(functions: &[&str], guid: &str) -> Vec<u8> {
    compile_with(functions, guid, &[])
}

/// The same with further arguments for the compiler.
pub(super) fn compile_with(functions: &[&str], guid: &str, arguments: &[&str]) -> Vec<u8> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let directory = std::env::temp_dir().join(format!("fmu-build-test-{}-{number}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let (source, library) = (directory.join("library.c"), directory.join("library.so"));
    let bodies: String = functions.iter().map(|name| format!("int {name}(void) {{ return 0; }}\n")).collect();
    let guid = format!("__attribute__((used)) static const char guid[] = \"{guid}\";\n");
    std::fs::write(&source, guid + &bodies).unwrap();
    let status = Command::new("cc")
        .args(["-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(&source)
        .args(arguments)
        .status()
        .unwrap();
    assert!(status.success(), "the C compiler made no library");
    let bytes = std::fs::read(&library).unwrap();
    std::fs::remove_dir_all(&directory).unwrap();
    bytes
}
