//! Platform folders of FMI 2.0.4 and what this machine can build.

use anyhow::{Result, bail};

/// One folder under `binaries/`.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Platform {
    /// Name of the folder.
    pub(crate) folder: &'static str,
    /// `std::env::consts::OS` and `ARCH` of the machines it serves.
    os: &'static str,
    arch: &'static str,
    /// Rust target that a build for it needs.
    target: &'static str,
}

/// The short names mean x86; everything else is named as in FMI 3.
const PLATFORMS: [Platform; 8] = [
    Platform { folder: "linux64", os: "linux", arch: "x86_64", target: "x86_64-unknown-linux-gnu" },
    Platform { folder: "linux32", os: "linux", arch: "x86", target: "i686-unknown-linux-gnu" },
    Platform { folder: "win64", os: "windows", arch: "x86_64", target: "x86_64-pc-windows-msvc" },
    Platform { folder: "win32", os: "windows", arch: "x86", target: "i686-pc-windows-msvc" },
    Platform { folder: "darwin64", os: "macos", arch: "x86_64", target: "x86_64-apple-darwin" },
    Platform { folder: "aarch64-linux", os: "linux", arch: "aarch64", target: "aarch64-unknown-linux-gnu" },
    Platform { folder: "aarch64-windows", os: "windows", arch: "aarch64", target: "aarch64-pc-windows-msvc" },
    Platform { folder: "aarch64-darwin", os: "macos", arch: "aarch64", target: "aarch64-apple-darwin" },
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

    /// The platform that the user asked for, `None` meaning this machine's own.
    pub(crate) fn requested(names: &[String]) -> Result<&'static Self> {
        let own = Self::own()?;
        for name in names {
            let Some(platform) = PLATFORMS.iter().find(|platform| platform.folder == name) else {
                bail!("--platforms: `{name}` is not a platform folder of FMI 2.0; known are {}", folders());
            };
            if platform != own {
                bail!(
                    "--platforms: {name} cannot be built on this {} machine: it needs the Rust target {} with a \
                     linker and C headers for it; run `cargo fmu build` on a {name} machine",
                    own.folder,
                    platform.target
                );
            }
        }
        Ok(own)
    }

    /// Folders that get this platform's library. FMPy 0.3.32 on ARM Linux looks into linux64, against the
    /// standard; a copy there harms nobody, as no x86 library takes the place.
    pub(crate) fn package_folders(&self) -> Vec<&'static str> {
        if self.folder == "aarch64-linux" { vec!["aarch64-linux", "linux64"] } else { vec![self.folder] }
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

    #[test]
    fn own_platform_is_accepted_by_name_and_by_default() {
        let own = Platform::own().unwrap();
        assert_eq!(Platform::requested(&[]).unwrap(), own);
        assert_eq!(Platform::requested(&[own.folder.to_owned()]).unwrap(), own);
    }

    #[test]
    fn other_platforms_are_refused_in_one_line_with_what_they_need() {
        let other = PLATFORMS.iter().find(|platform| *platform != Platform::own().unwrap()).unwrap();
        let message = Platform::requested(&[other.folder.to_owned()]).unwrap_err().to_string();
        assert!(message.contains(other.folder) && message.contains(other.target), "{message}");
        assert!(!message.contains('\n'), "{message}");
        let message = Platform::requested(&["amiga".to_owned()]).unwrap_err().to_string();
        assert!(message.contains("amiga") && message.contains("linux64"), "{message}");
    }
}
