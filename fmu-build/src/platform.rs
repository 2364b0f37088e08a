//! Platform folders of FMI 2.0.4 and what this machine can build.

use crate::cross::{AARCH64_LINUX, Route, WIN64};
use anyhow::{Result, bail};

/// One folder under `binaries/`.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Platform {
    /// Name of the folder.
    pub(crate) folder: &'static str,
    /// `std::env::consts::OS` and `ARCH` of the machines it serves.
    os: &'static str,
    arch: &'static str,
    /// Rust target that a build for it on such a machine needs.
    pub(crate) target: &'static str,
    /// How to build for it on Linux.
    pub(crate) route: Option<&'static Route>,
}

/// The short names mean x86; everything else is named as in FMI 3.
const PLATFORMS: [Platform; 8] = [
    Platform {
        folder: "linux64",
        os: "linux",
        arch: "x86_64",
        target: "x86_64-unknown-linux-gnu",
        route: None,
    },
    Platform { folder: "linux32", os: "linux", arch: "x86", target: "i686-unknown-linux-gnu", route: None },
    Platform {
        folder: "win64",
        os: "windows",
        arch: "x86_64",
        target: "x86_64-pc-windows-msvc",
        route: Some(&WIN64),
    },
    Platform { folder: "win32", os: "windows", arch: "x86", target: "i686-pc-windows-msvc", route: None },
    Platform { folder: "darwin64", os: "macos", arch: "x86_64", target: "x86_64-apple-darwin", route: None },
    Platform {
        folder: "aarch64-linux",
        os: "linux",
        arch: "aarch64",
        target: "aarch64-unknown-linux-gnu",
        route: Some(&AARCH64_LINUX),
    },
    Platform {
        folder: "aarch64-windows",
        os: "windows",
        arch: "aarch64",
        target: "aarch64-pc-windows-msvc",
        route: None,
    },
    Platform {
        folder: "aarch64-darwin",
        os: "macos",
        arch: "aarch64",
        target: "aarch64-apple-darwin",
        route: None,
    },
];

impl Platform {
    /// The platform of the running machine.
    pub(crate) fn own() -> Result<&'static Self> {
        let (os, arch) = (std::env::consts::OS, std::env::consts::ARCH);
        match PLATFORMS.iter().find(|platform| platform.os == os && platform.arch == arch) {
            Some(platform) => Ok(platform),
            None => bail!("FMI 2.0 names no platform folder for {arch} {os}; build on one of: {}", folders()),
        }
    }

    /// All that the standard names.
    pub(crate) fn all() -> &'static [Self] {
        &PLATFORMS
    }

    /// The platforms that the user asked for, none meaning this machine's own.
    pub(crate) fn requested(names: &[String]) -> Result<Vec<&'static Self>> {
        let own = Self::own()?;
        if names.is_empty() {
            return Ok(vec![own]);
        }
        let mut requested: Vec<&Self> = Vec::new();
        for name in names {
            let Some(platform) = PLATFORMS.iter().find(|platform| platform.folder == name) else {
                bail!("--platforms: `{name}` is not a platform folder of FMI 2.0; known are {}", folders());
            };
            if let Some(missing) = platform.missing_on(own) {
                bail!(
                    "{name} cannot be built on this {} machine: {missing}; or run `cargo fmu build` on a {name} \
                     machine and join the FMUs by `cargo fmu merge`",
                    own.folder
                );
            }
            if !requested.contains(&platform) {
                requested.push(platform);
            }
        }
        Ok(requested)
    }

    /// What keeps a machine of another platform from building for this one.
    fn missing_on(&self, own: &Self) -> Option<String> {
        if self == own {
            return None;
        }
        match self.route {
            Some(route) if own.os == "linux" => route.missing(),
            _ => Some(format!("it needs the Rust target {} with a linker and C headers for it", self.target)),
        }
    }

    /// Whether it is one of Linux.
    pub(crate) fn is_linux(&self) -> bool {
        self.os == "linux"
    }

    /// Ending of its shared libraries.
    pub(crate) fn library_extension(&self) -> &'static str {
        match self.os {
            "windows" => "dll",
            "macos" => "dylib",
            _ => "so",
        }
    }

    /// Folders that get this platform's library in an FMU for these platforms. FMPy 0.3.32 on ARM
    /// Linux looks into linux64, against the standard; a copy there does no harm if the FMU has no
    /// x86 library.
    pub(crate) fn package_folders(&self, all: &[&Self]) -> Vec<&'static str> {
        let taken = all.iter().any(|platform| platform.folder == "linux64");
        if self.folder == "aarch64-linux" && !taken {
            vec!["aarch64-linux", "linux64"]
        } else {
            vec![self.folder]
        }
    }
}

/// Whether a folder under `binaries/` is one the standard names.
pub(crate) fn is_folder(name: &str) -> bool {
    PLATFORMS.iter().any(|platform| platform.folder == name)
}

fn folders() -> String {
    PLATFORMS.map(|platform| platform.folder).join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(folder: &str) -> &'static Platform {
        PLATFORMS.iter().find(|platform| platform.folder == folder).unwrap()
    }

    #[test]
    fn own_platform_is_accepted_by_name_and_by_default() {
        let own = Platform::own().unwrap();
        assert_eq!(Platform::requested(&[]).unwrap(), [own]);
        let twice = [own.folder.to_owned(), own.folder.to_owned()];
        assert_eq!(Platform::requested(&twice).unwrap(), [own]);
    }

    #[test]
    fn platforms_without_a_route_are_refused_in_one_line_with_what_they_need() {
        let other = named("aarch64-darwin");
        if Platform::own().unwrap() != other {
            let message = Platform::requested(&[other.folder.to_owned()]).unwrap_err().to_string();
            assert!(message.contains(other.folder) && message.contains(other.target), "{message}");
            assert!(message.contains("cargo fmu merge") && !message.contains('\n'), "{message}");
        }
        let message = Platform::requested(&["amiga".to_owned()]).unwrap_err().to_string();
        assert!(message.contains("amiga") && message.contains("linux64"), "{message}");
    }

    #[test]
    fn a_copy_for_fmpy_on_arm_never_takes_the_place_of_an_x86_library() {
        let (arm, x86) = (named("aarch64-linux"), named("linux64"));
        assert_eq!(arm.package_folders(&[arm]), ["aarch64-linux", "linux64"]);
        assert_eq!(arm.package_folders(&[x86, arm]), ["aarch64-linux"]);
        assert_eq!((arm.library_extension(), named("win64").library_extension()), ("so", "dll"));
    }
}
