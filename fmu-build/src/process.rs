//! Running other programs: in a clean environment, quietly or with their output shown.

use crate::progress::Step;
use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};

/// Lines of a quiet program's output that are shown when it fails.
const LINES_SHOWN_ON_FAILURE: usize = 40;

/// A command without the variables that the outer `cargo run` set for this program: they describe
/// fmu-build, and would reach build scripts and tests as if they described those.
pub(crate) fn command(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let of_package = ["CARGO_PKG_", "CARGO_MANIFEST_", "CARGO_BIN_"].iter().any(|p| text.starts_with(p));
        if of_package || text == "CARGO_CRATE_NAME" || text == "CARGO_PRIMARY_PACKAGE" {
            command.env_remove(name);
        }
    }
    for name in ["LD_LIBRARY_PATH", "DYLD_FALLBACK_LIBRARY_PATH"] {
        if let Some(value) = std::env::var_os(name) {
            match without_cargo_directories(&value) {
                Some(kept) => command.env(name, kept),
                None => command.env_remove(name),
            };
        }
    }
    command
}

/// A library search path without the toolchain's and the build's own directories, which `cargo run`
/// puts in front; `None` if nothing is left.
fn without_cargo_directories(value: &OsStr) -> Option<std::ffi::OsString> {
    let parent_of = |path: Option<PathBuf>| Some(path?.parent()?.to_path_buf());
    let build = parent_of(std::env::current_exe().ok());
    let toolchain = parent_of(parent_of(std::env::var_os("CARGO").map(PathBuf::from)));
    let ours = |path: &PathBuf| [&build, &toolchain].into_iter().flatten().any(|dir| path.starts_with(dir));
    let kept: Vec<PathBuf> = std::env::split_paths(value).filter(|path| !ours(path)).collect();
    if kept.is_empty() { None } else { std::env::join_paths(kept).ok() }
}

/// Runs to the end with output hidden; its last line goes to the spinner, and a failure shows its
/// last lines. Returns the output.
pub(crate) fn run_quietly(step: &Step, command: Command) -> Result<String> {
    let name = describe(&command);
    let (status, output) = capture(step, command)?;
    if !status.success() {
        let lines: Vec<&str> = output.lines().collect();
        let shown = lines[lines.len().saturating_sub(LINES_SHOWN_ON_FAILURE)..].join("\n");
        bail!("`{name}` failed ({status}):\n{shown}");
    }
    Ok(output)
}

/// Runs to the end with stdout and stderr collected in one text, in the order they were written.
pub(crate) fn capture(step: &Step, command: Command) -> Result<(ExitStatus, String)> {
    let mut output = String::new();
    let status = run_all_lines(command, |line| {
        step.detail(line.trim());
        output.push_str(line);
        output.push('\n');
    })?;
    Ok((status, output))
}

/// Runs to the end with the lines of stdout and stderr handed to `each_line`, in the order they
/// were written.
pub(crate) fn run_all_lines(mut command: Command, mut each_line: impl FnMut(&str)) -> Result<ExitStatus> {
    let name = describe(&command);
    let (reader, writer) = std::io::pipe()?;
    command.stdin(Stdio::null()).stdout(writer.try_clone()?).stderr(writer);
    let mut child = command.spawn().with_context(|| format!("cannot start `{name}`"))?;
    drop(command); // holds the writing end; the reader would wait for it for ever
    for line in lines(reader) {
        each_line(&line?);
    }
    Ok(child.wait()?)
}

/// Runs to the end with its output on the terminal; an error if it fails.
pub(crate) fn run_shown(mut command: Command) -> Result<()> {
    let name = describe(&command);
    let status = command.status().with_context(|| format!("cannot start `{name}`"))?;
    if !status.success() {
        bail!("`{name}` failed ({status})");
    }
    Ok(())
}

/// Runs to the end with its stdout handed to `each_line`, its stderr on the terminal.
pub(crate) fn run_lines(mut command: Command, mut each_line: impl FnMut(&str)) -> Result<ExitStatus> {
    let name = describe(&command);
    let mut child =
        command.stdout(Stdio::piped()).spawn().with_context(|| format!("cannot start `{name}`"))?;
    for line in lines(child.stdout.take().context("the child has no stdout")?) {
        each_line(&line?);
    }
    Ok(child.wait()?)
}

/// Lines of a stream whose bytes need not be UTF-8.
fn lines(stream: impl std::io::Read) -> impl Iterator<Item = std::io::Result<String>> {
    BufReader::new(stream).split(b'\n').map(|line| {
        let mut bytes = line?;
        if bytes.last() == Some(&b'\r') {
            bytes.pop();
        }
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    })
}

/// The program's file name and its first four arguments, for messages.
fn describe(command: &Command) -> String {
    let program = PathBuf::from(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str());
    let words = std::iter::once(name).chain(command.get_args().take(4));
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;

    #[test]
    fn captures_both_streams_in_order_and_reports_failure() {
        let step = Step::hidden();
        let mut shell = command("sh");
        shell.args(["-c", "echo one; echo two >&2; echo three; exit 3"]);
        let (status, output) = capture(&step, shell).unwrap();
        assert_eq!((status.code(), output.as_str()), (Some(3), "one\ntwo\nthree\n"));

        let mut shell = command("sh");
        shell.args(["-c", "echo what went wrong; exit 1"]);
        let message = run_quietly(&step, shell).unwrap_err().to_string();
        assert!(message.contains("what went wrong"), "{message}");
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let message = format!("{:#}", run_shown(command("no-such-program")).unwrap_err());
        assert!(message.contains("cannot start `no-such-program`"), "{message}");
    }
}
