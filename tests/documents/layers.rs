//! Which module of the library may use which: ARCHITECTURE.md draws the same.

use std::fs;
use std::path::{Path, PathBuf};

/// From the bottom up. A module uses itself and modules before it.
const LAYERS: [&str; 18] = [
    "quadrature",
    "roots",
    "counters",
    "error",
    "range",
    "material",
    "ellipse",
    "transform",
    "profile",
    "parameters",
    "surface",
    "friction",
    "wear",
    "engine",
    "interface",
    "reference",
    "problems",
    "fmi2",
];

/// Modules that stand above the engine and that nothing in it uses.
const APART: [&str; 3] = ["reference", "problems", "fmi2"];

fn files(path: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(path) else { return Vec::new() };
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

/// Files of a module without those of its tests.
fn sources(module: &str) -> Vec<(PathBuf, String)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = files(&src.join(module));
    found.push(src.join(format!("{module}.rs")));
    // the folder of the checkout may have any name
    let of_tests = |path: &Path| path.strip_prefix(&src).is_ok_and(|p| p.to_string_lossy().contains("tests"));
    found.retain(|path| path.exists() && !of_tests(path));
    let text = |path: &PathBuf| fs::read_to_string(path).expect("the file can be read");
    // tests within a file may use anything
    found.into_iter().map(|path| (path.clone(), text(&path))).map(|(p, t)| (p, before_tests(&t))).collect()
}

fn before_tests(text: &str) -> String {
    text.split("#[cfg(test)]\nmod ").next().unwrap_or_default().to_owned()
}

/// Names behind `crate::`, comments left out.
fn used(text: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let name = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    code.flat_map(|line| line.split("crate::").skip(1).map(name).collect::<Vec<_>>()).collect()
}

#[test]
fn modules_use_only_those_below_them() {
    let mut seen = 0;
    for (layer, module) in LAYERS.iter().enumerate() {
        let files = sources(module);
        assert!(!files.is_empty(), "there is no module {module}");
        for (path, text) in files {
            for name in used(&text) {
                let Some(other) = LAYERS.iter().position(|layer| *layer == name) else { continue };
                seen += 1;
                let apart = APART.contains(&name.as_str()) && name != *module && *module != "problems";
                assert!(other <= layer && !apart, "{} uses {name}", path.display());
            }
        }
    }
    assert!(seen > 100, "only {seen} uses found");
}

/// The reference shares no code with the engine, so that comparing the two means something.
#[test]
fn the_reference_uses_nothing_of_the_engine() {
    for (path, text) in sources("reference") {
        for name in used(&text) {
            assert!(
                !LAYERS.contains(&name.as_str()) || name == "reference",
                "{} uses {name}",
                path.display()
            );
        }
    }
}
