//! Building for another platform with the cross compilers of Debian and Ubuntu, and running what
//! was built under an emulator.

use crate::process;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail, ensure};
use roxmltree::Document;
use std::ffi::OsString;
use std::path::Path;

/// How to build for a platform on another one, and how to run it there.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Route {
    /// Rust target.
    pub(crate) target: &'static str,
    /// C compiler and linker.
    pub(crate) compiler: &'static str,
    /// Debian packages of the compiler and its headers.
    packages: &'static str,
    /// Programs that run its programs, the first that is there, and arguments before the program.
    emulators: &'static [&'static str],
    emulator_arguments: &'static [&'static str],
    /// Debian package of the emulator.
    emulator_package: &'static str,
    /// What a program needs to load libraries.
    link: &'static [&'static str],
    /// A system library that older emulators lack: its stand-in is a C file of this name among the
    /// assets.
    stand_in: Option<&'static str>,
    /// File name ending of a program.
    pub(crate) program: &'static str,
}

/// Windows, by MinGW and Wine.
pub(crate) const WIN64: Route = Route {
    target: "x86_64-pc-windows-gnu",
    compiler: "x86_64-w64-mingw32-gcc",
    packages: "gcc-mingw-w64-x86-64-win32 mingw-w64-x86-64-dev",
    emulators: &["wine64", "/usr/lib/wine/wine64", "wine"],
    emulator_arguments: &[],
    emulator_package: "wine64",
    link: &[],
    stand_in: Some("bcryptprimitives"),
    program: ".exe",
};

/// Linux on ARM, by GCC and QEMU.
pub(crate) const AARCH64_LINUX: Route = Route {
    target: "aarch64-unknown-linux-gnu",
    compiler: "aarch64-linux-gnu-gcc",
    packages: "gcc-aarch64-linux-gnu libc6-dev-arm64-cross",
    emulators: &["qemu-aarch64", "qemu-aarch64-static"],
    emulator_arguments: &["-L", "/usr/aarch64-linux-gnu"],
    emulator_package: "qemu-user",
    link: &["-ldl"],
    stand_in: None,
    program: "",
};

impl Route {
    /// What this machine lacks to build, with the way to get it.
    pub(crate) fn missing(&self) -> Option<String> {
        if !works(self.compiler, &["--version"]) {
            return Some(self.no_compiler());
        }
        let libraries = output("rustc", &["--print", "target-libdir", "--target", self.target]);
        let installed = libraries.is_ok_and(|path| Path::new(path.trim()).is_dir());
        (!installed).then(|| {
            format!("the Rust target {} is not installed: `rustup target add {}`", self.target, self.target)
        })
    }

    fn no_compiler(&self) -> String {
        format!("the compiler {} was not found: `apt install {}`", self.compiler, self.packages)
    }

    /// Environment for cargo: linker, C compiler, and the target's headers for bindgen.
    pub(crate) fn environment(&self) -> Result<Vec<(String, OsString)>> {
        let name = self.target.replace('-', "_");
        Ok(vec![
            (format!("CARGO_TARGET_{}_LINKER", name.to_uppercase()), self.compiler.into()),
            (format!("CC_{name}"), self.compiler.into()),
            (format!("BINDGEN_EXTRA_CLANG_ARGS_{name}"), self.clang_arguments()?.into()),
        ])
    }

    /// The target's headers, as arguments for the clang that bindgen runs.
    pub(crate) fn clang_arguments(&self) -> Result<String> {
        let headers: Vec<_> = self.headers()?.iter().map(|path| format!("-I{path}")).collect();
        Ok(headers.join(" "))
    }

    /// Where the compiler looks for headers.
    fn headers(&self) -> Result<Vec<String>> {
        let mut command = process::command(self.compiler);
        command.args(["-E", "-v", "-x", "c", if cfg!(windows) { "NUL" } else { "/dev/null" }]);
        let output = command.output().with_context(|| format!("cannot run {}", self.compiler))?;
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let found = searched(&text);
        ensure!(!found.is_empty(), "{} does not report where its headers are", self.compiler);
        Ok(found)
    }

    /// Loads a library under the emulator and steps it. Returns what was run, or why nothing was.
    /// What it makes stays beside the library; `description` is the FMU's modelDescription.xml.
    pub(crate) fn try_out(
        &self,
        workspace: &Workspace,
        library: &Path,
        description: &str,
    ) -> Result<Outcome> {
        let directory = library.parent().context("the library is in no folder")?;
        if !works(self.compiler, &["--version"]) {
            return Ok(Outcome::NotRun(self.no_compiler()));
        }
        let works = |program: &&&str| works(program, &["--version"]);
        let Some(emulator) = self.emulators.iter().find(works) else {
            return Ok(Outcome::NotRun(format!(
                "no {} was found: `apt install {}`",
                self.emulators[0], self.emulator_package
            )));
        };
        let program = directory.join(format!("loader{}", self.program));
        self.compile(workspace, "loader", self.link, &program)?;
        if let Some(name) = self.stand_in {
            let library = directory.join(format!("{name}.dll"));
            self.compile(workspace, name, &["-shared", "-ladvapi32"], &library)?;
        }
        let mut run = workspace.command(emulator);
        run.args(self.emulator_arguments).arg(&program).arg(library).args(loader_arguments(description)?);
        run.env("WINEPREFIX", directory.join("wine")).env("WINEDEBUG", "-all");
        let done = run.output().with_context(|| format!("cannot run {emulator}"))?;
        let text = String::from_utf8_lossy(&done.stdout).into_owned();
        if !done.status.success() {
            bail!("under {emulator} the library fails: {text}{}", String::from_utf8_lossy(&done.stderr));
        }
        check_numbers(&text).with_context(|| format!("under {emulator}"))?;
        let name = Path::new(emulator).file_name().unwrap_or_default().display();
        Ok(Outcome::Ran(format!("loaded and stepped under {name}")))
    }

    /// Compiles a C file of the assets for the platform.
    fn compile(&self, workspace: &Workspace, name: &str, arguments: &[&str], product: &Path) -> Result<()> {
        let mut compiler = workspace.command(self.compiler);
        compiler.args(["-std=gnu11", "-O1", "-o"]).arg(product);
        compiler.arg(format!("fmu-build/assets/{name}.c")).args(arguments);
        let compiled = compiler.output().with_context(|| format!("cannot compile {name}.c"))?;
        ensure!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
        Ok(())
    }
}

/// Whether a library was tried out.
pub(crate) enum Outcome {
    /// How.
    Ran(String),
    /// Why not.
    NotRun(String),
}

/// Directories in what `gcc -v` says.
fn searched(text: &str) -> Vec<String> {
    let lines = text.lines().skip_while(|line| !line.ends_with("search starts here:"));
    let lines = lines.take_while(|line| !line.starts_with("End of search list"));
    lines.filter_map(|line| line.strip_prefix(' ')).map(|path| path.trim().to_owned()).collect()
}

/// GUID and references, from modelDescription.xml.
fn loader_arguments(description: &str) -> Result<Vec<String>> {
    let document = Document::parse(description)?;
    let guid = document.root_element().attribute("guid").context("no guid")?.to_owned();
    let reference = |name: &str| {
        let found = document.descendants().find(|node| node.attribute("name") == Some(name));
        found.and_then(|node| node.attribute("valueReference")).map(str::to_owned).context("no such variable")
    };
    Ok(vec![
        guid,
        reference("tangential_displacement")?,
        reference("tangential_force")?,
        reference("wear_volume")?,
    ])
}

/// In gross slip under the default load: T = −μF_N at the last of eight strokes, and V = (k/σ₀)
/// μF_N (path − 0.8 u_max for the first push and 1.6 for each return), Popov and Heß; wear itself
/// changes that by far less than 1e-6.
fn check_numbers(text: &str) -> Result<()> {
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [force, volume] = numbers[..] else { bail!("the loader said {text:?}") };
    let full_slip = 2.537_551e-6;
    let path = 1e-5 + 7.0 * 2e-5 - (0.8 + 7.0 * 1.6) * full_slip;
    let expected = 4e-14 * 60.0 * path;
    ensure!((force + 60.0).abs() < 1e-6, "T = {force} N in place of -60 N");
    ensure!((volume / expected - 1.0).abs() < 1e-3, "V = {volume:e} m3 in place of {expected:e} m3");
    Ok(())
}

fn output(program: &str, arguments: &[&str]) -> Result<String> {
    let output = process::command(program).args(arguments).output()?;
    ensure!(output.status.success(), "{program} failed");
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn works(program: &str, arguments: &[&str]) -> bool {
    output(program, arguments).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_headers_of_a_compiler_are_read() {
        let said = "ignoring\n#include \"...\" search starts here:\n#include <...> search starts here:\n /a/include\n /b\nEnd of search list.\n /c\n";
        assert_eq!(searched(said), ["/a/include", "/b"]);
        assert!(searched("nothing").is_empty());
    }

    #[test]
    fn a_route_that_is_not_there_says_how_to_get_it() {
        let route = Route { compiler: "no-such-compiler", ..WIN64 };
        let message = route.missing().unwrap();
        assert!(
            message.contains("no-such-compiler") && message.contains("apt install gcc-mingw"),
            "{message}"
        );
    }

    #[test]
    fn what_cannot_run_for_want_of_a_program_is_no_failure() {
        let workspace = Workspace::of_this_program();
        let tried = |route: Route| match route.try_out(&workspace, Path::new("none/none"), "").unwrap() {
            Outcome::NotRun(why) => why,
            Outcome::Ran(how) => panic!("{how}"),
        };
        assert!(tried(Route { compiler: "no-such-compiler", ..WIN64 }).contains("no-such-compiler"));
        let why = tried(Route { compiler: "cargo", emulators: &["no-such-emulator"], ..WIN64 });
        assert!(why.contains("no-such-emulator") && why.contains("apt install wine64"), "{why}");
    }

    #[test]
    fn wrong_numbers_are_reported() {
        assert!(check_numbers("-59.9 1e-16").unwrap_err().to_string().contains("-60"));
        assert!(check_numbers("-6.0e1 1e-16").unwrap_err().to_string().contains("m3"));
        assert!(check_numbers("").is_err());
    }
}
