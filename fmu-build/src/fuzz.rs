//! The fuzz targets under `fuzz/`: built with AddressSanitizer and run from their corpus, as `cargo
//! fuzz` would, which need not be installed for it. The sanitizer is not stable in Rust;
//! RUSTC_BOOTSTRAP makes the compiler allow it.

use crate::libclang::Environment;
use crate::process::{self, run_quietly, run_shown};
use crate::progress;
use crate::workspace::{Workspace, make_folder};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

/// Targets with the longest input that each is given, bytes.
const TARGETS: [(&str, u32); 3] = [("calls", 513), ("states", 5120), ("profiles", 512)];

/// Coverage that libFuzzer reads, and the sanitizer. Debug assertions catch what a release build
/// would not report.
const FLAGS: [&str; 9] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-stack-depth",
    "-Zsanitizer=address",
    "-Cdebug-assertions",
    "-Ccodegen-units=1",
    "--cfg=fuzzing",
];

/// Without stacks of every allocation the sanitizer is several times as fast. A report gives the
/// input, from which the rest follows.
const SANITIZER: &str = "malloc_context_size=0:detect_stack_use_after_return=0";

/// A single input that takes longer counts as hanging, s. The slowest known ones, steps that slide
/// 1 km while the load falls to 0, take some 16 s of processor time under the sanitizer.
const HANGS: u32 = 120;

/// How long to go on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Effort {
    Seconds(u32),
    Runs(u64),
}

impl Effort {
    fn argument(self) -> String {
        match self {
            Self::Seconds(seconds) => format!("-max_total_time={seconds}"),
            Self::Runs(runs) => format!("-runs={runs}"),
        }
    }
}

/// Builds the targets and runs those that are named, or all.
pub(crate) fn run(
    workspace: &Workspace,
    environment: &Environment,
    names: &[String],
    effort: Effort,
    seed: u32,
) -> Result<()> {
    if let Some(unknown) = names.iter().find(|name| TARGETS.iter().all(|(target, _)| target != name)) {
        bail!("`{unknown}` is not a fuzz target; there are {}", TARGETS.map(|(target, _)| target).join(", "));
    }
    if let Some(missing) = missing() {
        println!("Fuzzing is SKIPPED: {missing}");
        return Ok(());
    }
    let host = host()?;
    let directory = workspace.product("fuzz");
    progress::shown("Building the fuzz targets", || {
        let mut cargo = workspace.cargo();
        cargo.args(["build", "--release", "--locked", "--bins", "--manifest-path", "fuzz/Cargo.toml"]);
        cargo.args(["--target", &host, "--target-dir"]).arg(&directory);
        cargo.envs(environment.iter().map(|(name, value)| (name, value)));
        cargo
            .env("RUSTC_BOOTSTRAP", "1")
            .env("RUSTFLAGS", FLAGS.join(" "))
            .env_remove("CARGO_ENCODED_RUSTFLAGS");
        run_shown(cargo)
    })?;
    let binaries = directory.join(&host).join("release");
    for (target, longest) in TARGETS {
        if names.is_empty() || names.iter().any(|name| name == target) {
            fuzz(workspace, &binaries.join(target), (target, longest), effort, seed)?;
        }
    }
    Ok(())
}

/// One target, on a copy of its corpus: what it finds on the way stays out of the checkout.
fn fuzz(
    workspace: &Workspace,
    binary: &Path,
    (target, longest): (&str, u32),
    effort: Effort,
    seed: u32,
) -> Result<()> {
    let seeds = workspace.file("fuzz/corpus").join(target);
    let found = workspace.product("fuzz/corpus").join(target);
    let artifacts = workspace.product("fuzz/artifacts");
    for folder in [&found, &artifacts] {
        make_folder(folder)?;
    }
    let output = progress::quiet(&format!("Fuzzing {target}"), |step| {
        let mut fuzzer = process::command(binary);
        fuzzer.env("ASAN_OPTIONS", SANITIZER).current_dir(workspace.root());
        fuzzer.args([format!("-max_len={longest}"), format!("-timeout={HANGS}"), effort.argument()]);
        // an instance keeps memory for later inputs, which libFuzzer takes for a leak. It then
        // searches the whole heap, up to 1000 times, and each search takes as long as a thousand
        // inputs. The sanitizer still searches at the end.
        fuzzer.args(["-rss_limit_mb=4096", "-detect_leaks=0", &format!("-seed={seed}")]);
        fuzzer.arg(format!("-artifact_prefix={}/{target}-", artifacts.display()));
        fuzzer.arg(&found).arg(&seeds);
        run_quietly(step, fuzzer)
    })?;
    let last = |is: &dyn Fn(&str) -> bool| output.lines().rev().find(|line| is(line));
    let done = last(&|line| line.starts_with("Done "));
    println!("{target}: {}", done.context("the fuzzer did not say how many inputs it ran")?);
    if let Some(calls) = last(&|line| line.ends_with(" million calls of the C interface")) {
        println!("{target}: {calls}");
    }
    Ok(())
}

/// What this machine lacks.
fn missing() -> Option<String> {
    if !cfg!(target_os = "linux") {
        return Some("the fuzz targets are set up for Linux only".to_owned());
    }
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let works =
        process::command(&compiler).arg("--version").output().is_ok_and(|output| output.status.success());
    (!works).then(|| {
        format!("libFuzzer needs a C++ compiler, and `{compiler}` was not found (Debian, Ubuntu: `apt install g++`)")
    })
}

/// The target that rustc builds for by itself.
pub(crate) fn host() -> Result<String> {
    let rustc = std::env::var_os("RUSTC").map_or_else(|| PathBuf::from("rustc"), PathBuf::from);
    let output = process::command(rustc).arg("-vV").output().context("cannot run rustc")?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).context("rustc -vV does not name its host")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn an_unknown_target_is_named() {
        let workspace = Workspace::of_this_program();
        let error = run(&workspace, &Vec::new(), &["call".to_owned()], Effort::Seconds(1), 1)
            .unwrap_err()
            .to_string();
        assert!(error.contains("`call`") && error.contains("calls, states, profiles"), "{error}");
    }

    #[test]
    fn every_target_is_a_binary_of_the_fuzz_package_and_has_seeds() {
        let workspace = Workspace::of_this_program();
        let manifest = fs::read_to_string(workspace.file("fuzz/Cargo.toml")).unwrap();
        for (target, _) in TARGETS {
            assert!(manifest.contains(&format!("name = \"{target}\"")), "{target}");
            assert!(
                fs::read_dir(workspace.file("fuzz/corpus").join(target)).unwrap().count() > 0,
                "{target}"
            );
        }
        assert_eq!(manifest.matches("[[bin]]").count(), TARGETS.len());
    }

    #[test]
    fn the_host_is_a_target_of_rustc() {
        assert!(host().unwrap().contains(std::env::consts::ARCH));
    }
}
