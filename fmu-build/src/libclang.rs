//! libclang for bindgen, which fmi-sys runs: the system's own, or a pinned wheel in the virtual
//! environment.

use anyhow::{Context, Result};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Directories that hold libclang on common systems; `*` stands for one folder of any name.
const KNOWN_DIRECTORIES: [&str; 9] = [
    "/usr/lib/llvm-*/lib",
    "/usr/lib",
    "/usr/lib64",
    "/usr/lib/*-linux-gnu",
    "/usr/local/lib",
    "/usr/local/opt/llvm/lib",
    "/opt/homebrew/opt/llvm/lib",
    "/Library/Developer/CommandLineTools/usr/lib",
    "C:\\Program Files\\LLVM\\bin",
];

/// Environment variables that let bindgen find libclang and C headers.
pub(crate) type Environment = Vec<(&'static str, OsString)>;

/// Environment for the system's libclang; `None` if it has none. A LIBCLANG_PATH of the user is
/// left alone.
pub(crate) fn of_system() -> Option<Environment> {
    if std::env::var_os("LIBCLANG_PATH").is_some() {
        return Some(Vec::new());
    }
    let directory = llvm_config_directory()
        .into_iter()
        .chain(KNOWN_DIRECTORIES.iter().flat_map(|pattern| expand(pattern)))
        .find(|directory| holds_libclang(directory))?;
    let mut environment = vec![("LIBCLANG_PATH", directory.clone().into_os_string())];
    if !has_own_headers(&directory) {
        environment.extend(compiler_headers().ok());
    }
    Some(environment)
}

/// Environment for the libclang wheel, which brings no headers.
pub(crate) fn of_wheel(site_packages: &Path) -> Result<Environment> {
    let directory = site_packages.join("clang").join("native");
    anyhow::ensure!(
        holds_libclang(&directory),
        "the libclang wheel has no library under {}",
        directory.display()
    );
    Ok(vec![("LIBCLANG_PATH", directory.into_os_string()), compiler_headers()?])
}

/// Points clang at the C compiler's own headers (stddef.h and such).
fn compiler_headers() -> Result<(&'static str, OsString)> {
    let mut arguments = std::env::var("BINDGEN_EXTRA_CLANG_ARGS").unwrap_or_default();
    let include = format!("-I{}", header_directory()?);
    if !arguments.contains(&include) {
        arguments = format!("{arguments} {include}").trim_start().to_owned();
    }
    Ok(("BINDGEN_EXTRA_CLANG_ARGS", arguments.into()))
}

/// Where the C compiler has its own headers.
pub(crate) fn header_directory() -> Result<String> {
    let output = crate::process::command("cc").arg("-print-file-name=include").output().context(
        "a C compiler is needed, but `cc` was not found: install one (Debian, Ubuntu: `apt install gcc libc6-dev`)",
    )?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn llvm_config_directory() -> Option<PathBuf> {
    let output = crate::process::command("llvm-config").arg("--libdir").output().ok()?;
    Some(PathBuf::from(String::from_utf8(output.stdout).ok()?.trim()))
}

/// The directories that a pattern with at most one `*` stands for.
fn expand(pattern: &str) -> Vec<PathBuf> {
    let Some((before, after)) = pattern.split_once('*') else { return vec![PathBuf::from(pattern)] };
    let (parent, prefix) = before.rsplit_once('/').unwrap_or(("", before));
    let (suffix, rest) = after.split_once('/').unwrap_or((after, ""));
    let mut found: Vec<PathBuf> = std::fs::read_dir(parent)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            name.starts_with(prefix) && name.ends_with(suffix)
        })
        .map(|entry| entry.path().join(rest))
        .collect();
    found.sort();
    found.reverse(); // newest version first
    found
}

fn holds_libclang(directory: &Path) -> bool {
    names(directory).any(|name| is_libclang(&name))
}

/// libclang.so, libclang.so.14, libclang-14.so.1 and their like; libclang-cpp.so is another
/// library.
fn is_libclang(name: &str) -> bool {
    let Some(rest) = name.strip_prefix("libclang") else { return false };
    let version_end = rest.find(".so").or_else(|| rest.find(".dylib")).or_else(|| rest.find(".dll"));
    let Some(version) = version_end.map(|end| &rest[..end]) else { return false };
    version.is_empty()
        || version.strip_prefix('-').is_some_and(|v| v.chars().all(|c| c.is_ascii_digit() || c == '.'))
}

/// Whether clang's own headers lie beside the library, as Debian's libclang-common-dev puts them.
fn has_own_headers(directory: &Path) -> bool {
    let resources = directory.join("clang");
    names(&resources).any(|version| resources.join(version).join("include").join("stddef.h").exists())
}

fn names(directory: &Path) -> impl Iterator<Item = String> {
    let entries = std::fs::read_dir(directory).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::is_libclang;

    #[test]
    fn libclang_is_distinguished_from_its_neighbours() {
        for name in [
            "libclang.so",
            "libclang.so.1",
            "libclang-14.so.1",
            "libclang-14.0.6.so",
            "libclang.dylib",
            "libclang.dll",
        ] {
            assert!(is_libclang(name), "{name}");
        }
        for name in ["libclang-cpp.so.14", "libclang-cpp.so", "libclangBasic.a", "libclang_rt.so", "libc.so"]
        {
            assert!(!is_libclang(name), "{name}");
        }
    }
}
