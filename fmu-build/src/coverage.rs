//! Lines of the library that its tests run: compiled with counters, run, merged by the LLVM tools
//! of the Rust toolchain.

use crate::fuzz;
use crate::libclang::Environment;
use crate::process::{self, run_lines, run_quietly, run_shown};
use crate::progress;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Least share of the lines of each part that has to be covered, %.
const LEAST: f64 = 95.0;

/// The C interface; all else is the engine.
const INTERFACE: &str = "src/fmi2/";

/// It looks into the symbols of the library, of which the counters add some.
const SKIPPED: &str = "the_library_exports_the_functions_and_nothing_else";

/// Lines of a file with how often they ran.
type Lines = BTreeMap<usize, u64>;

/// Runs the tests of the library, or some of its test programs, or modules of these as in
/// `fmi::bad_input`; prints the lines that none of them runs, and the shares. An error below the
/// least, or where a test fails.
pub(crate) fn run(workspace: &Workspace, environment: &Environment, some: &[String]) -> Result<()> {
    let (merge, export) = (tool("llvm-profdata")?, tool("llvm-cov")?);
    let directory = workspace.product("coverage");
    let profiles = directory.join("profiles");
    if profiles.exists() {
        fs::remove_dir_all(&profiles)?;
    }
    let tests = |more: &[&str]| {
        let mut cargo = workspace.cargo();
        cargo.args(["test", "--locked", "--package", "fretting_contact"]);
        if some.is_empty() {
            cargo.args(["--lib", "--tests"]);
        }
        cargo.args(some.iter().flat_map(|name| ["--test", program_and_module(name).0]));
        cargo.args(more).arg("--target-dir").arg(&directory);
        cargo.envs(environment.iter().map(|(name, value)| (name, value)));
        cargo.env("RUSTFLAGS", "-Cinstrument-coverage").env_remove("CARGO_ENCODED_RUSTFLAGS");
        cargo.env("LLVM_PROFILE_FILE", profiles.join("%p-%8m.profraw"));
        cargo
    };
    let mut programs = Vec::new();
    progress::shown("Building the tests with counters", || {
        let status =
            run_lines(tests(&["--no-run", "--message-format", "json-render-diagnostics"]), |line| {
                programs.extend(program_of(line));
            })?;
        ensure!(status.success(), "cargo could not build the tests");
        Ok(())
    })?;
    let tested = progress::shown("Tests of the library", || {
        let mut cargo = tests(&["--no-fail-fast"]);
        cargo.args(["--", "--skip", SKIPPED]);
        cargo.args(some.iter().filter_map(|name| program_and_module(name).1));
        run_shown(cargo)
    });
    let covered = progress::quiet("Merging the counters", |step| {
        let merged = directory.join("merged.profdata");
        let mut command = process::command(&merge);
        command.args(["merge", "--sparse", "--output"]).arg(&merged).arg(&profiles);
        run_quietly(step, command)?;
        // one program at a time: of a function that two programs hold in different versions a
        // common listing shows one
        let mut files = BTreeMap::new();
        for program in &programs {
            let mut command = process::command(&export);
            command.args(["export", "--format=lcov", "--skip-functions", "--instr-profile"]).arg(&merged);
            command.arg("--object").arg(program).arg("--sources").arg(workspace.file("src"));
            let output = command.output().context("cannot run llvm-cov")?;
            ensure!(output.status.success(), "llvm-cov: {}", String::from_utf8_lossy(&output.stderr));
            add_files(&mut files, &String::from_utf8_lossy(&output.stdout), workspace.root())?;
        }
        Ok(files)
    })?;
    report(&covered)?;
    tested
}

/// `fmi` and `bad_input` of `fmi::bad_input`; a program alone has no module.
fn program_and_module(name: &str) -> (&str, Option<&str>) {
    name.split_once("::").map_or((name, None), |(program, module)| (program, Some(module)))
}

/// Prints what is missed, and judges the parts.
fn report(files: &BTreeMap<String, Lines>) -> Result<()> {
    println!("\nLines that no test runs:");
    for (file, lines) in files {
        let missed = ranges(lines.iter().filter(|(_, count)| **count == 0).map(|(line, _)| *line));
        if !missed.is_empty() {
            println!("{file}: {missed}");
        }
    }
    let mut low = Vec::new();
    for (name, of_interface) in [("src/fmi2", true), ("the engine", false)] {
        let part = files.iter().filter(|(file, _)| file.starts_with(INTERFACE) == of_interface);
        let counts = || part.clone().flat_map(|(_, lines)| lines.values());
        let (covered, all) = (counts().filter(|count| **count > 0).count(), counts().count());
        ensure!(all > 0, "there are no lines of {name}");
        let share = 100.0 * covered as f64 / all as f64;
        println!("{name}: {covered} of {all} lines, {share:.2} %");
        if share < LEAST {
            low.push(name);
        }
    }
    if !low.is_empty() {
        bail!("less than {LEAST} % of {} is covered", low.join(" and of "));
    }
    Ok(())
}

/// Adds the lines by file of what llvm-cov exports, without modules of tests: files named so, and
/// what follows `#[cfg(test)]` at the end of a file. The largest count of a line is kept.
fn add_files(files: &mut BTreeMap<String, Lines>, export: &str, root: &Path) -> Result<()> {
    let (mut file, mut end) = (String::new(), usize::MAX);
    for line in export.lines() {
        if let Some(path) = line.strip_prefix("SF:") {
            let path = Path::new(path);
            file = path.strip_prefix(root).unwrap_or(path).to_string_lossy().replace('\\', "/");
            end =
                if file.ends_with("/tests.rs") { 0 } else { first_line_of_tests(&fs::read_to_string(path)?) };
        } else if let Some(data) = line.strip_prefix("DA:") {
            let (number, count) = data.split_once(',').context("a line without a count")?;
            let number = number.parse()?;
            if number < end {
                let most = files.entry(file.clone()).or_default().entry(number).or_default();
                *most = (*most).max(count.parse()?);
            }
        }
    }
    Ok(())
}

/// Number of the first line that belongs to the tests of a file.
fn first_line_of_tests(text: &str) -> usize {
    text.lines().position(|line| line == "#[cfg(test)]").map_or(usize::MAX, |index| index + 1)
}

/// `3, 5-7` of rising numbers.
fn ranges(numbers: impl Iterator<Item = usize>) -> String {
    let mut list: Vec<(usize, usize)> = Vec::new();
    for number in numbers {
        match list.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => list.push((number, number)),
        }
    }
    let text = |&(first, last): &(usize, usize)| {
        if first == last { first.to_string() } else { format!("{first}-{last}") }
    };
    list.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// Programs and shared libraries that a line of cargo's messages says to be built of this package.
fn program_of(line: &str) -> Vec<PathBuf> {
    let Ok(message) = serde_json::from_str::<Value>(line) else { return Vec::new() };
    if message["reason"] != "compiler-artifact" || message["target"]["name"] == "build-script-build" {
        return Vec::new();
    }
    let path = |value: &Value| value.as_str().map(PathBuf::from);
    if let Some(program) = path(&message["executable"]) {
        return vec![program];
    }
    let of_library = message["target"]["name"] == "fretting_contact";
    let files = message["filenames"].as_array().filter(|_| of_library);
    let shared = |file: &PathBuf| file.extension().is_some_and(|e| e == std::env::consts::DLL_EXTENSION);
    files.into_iter().flatten().filter_map(path).filter(shared).collect()
}

/// One of the LLVM tools that belong to the compiler: those of the system may be too old for its
/// counters.
fn tool(name: &str) -> Result<PathBuf> {
    let rustc = std::env::var_os("RUSTC").map_or_else(|| PathBuf::from("rustc"), PathBuf::from);
    let output = process::command(rustc).args(["--print", "sysroot"]).output().context("cannot run rustc")?;
    let sysroot = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let path = sysroot.join("lib/rustlib").join(fuzz::host()?).join("bin").join(name);
    let path = path.with_extension(std::env::consts::EXE_EXTENSION);
    ensure!(path.exists(), "{} is missing: `rustup component add llvm-tools`", path.display());
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_by_file_without_tests() {
        let root = Workspace::of_this_program();
        let file = root.file("src/range.rs");
        let mut files = BTreeMap::new();
        for lines in ["DA:3,0\nDA:4,2\nend_of_record\n", "DA:3,1\nDA:4,0\nDA:99999,0\n"] {
            let export = format!("SF:{}\n{lines}", file.display());
            add_files(&mut files, &export, root.root()).unwrap();
        }
        assert_eq!(files["src/range.rs"], Lines::from([(3, 1), (4, 2), (99999, 0)]));
        assert_eq!(first_line_of_tests("fn f() {}\n\n#[cfg(test)]\nmod tests {\n}\n"), 3);
        let export = format!("SF:{}\nDA:3,0\n", root.file("src/surface/tests.rs").display());
        let mut files = BTreeMap::new();
        add_files(&mut files, &export, root.root()).unwrap();
        assert!(files.is_empty());
    }

    #[test]
    fn too_little_is_an_error_that_names_the_part() {
        let files = |count| {
            let lines = |ran: usize| (1..=100).map(|line| (line, u64::from(line <= ran))).collect();
            BTreeMap::from([
                ("src/fmi2/mod.rs".to_owned(), lines(95)),
                ("src/wear.rs".to_owned(), lines(count)),
            ])
        };
        assert!(report(&files(95)).is_ok());
        let message = report(&files(94)).unwrap_err().to_string();
        assert!(message.contains("the engine") && !message.contains("fmi2"), "{message}");
    }

    #[test]
    fn a_module_is_named_behind_its_program() {
        assert_eq!(program_and_module("fmi"), ("fmi", None));
        assert_eq!(program_and_module("fmi::bad_input"), ("fmi", Some("bad_input")));
    }

    #[test]
    fn consecutive_numbers_are_reported_as_ranges() {
        assert_eq!(ranges([3, 5, 6, 7, 9].into_iter()), "3, 5-7, 9");
    }
}
