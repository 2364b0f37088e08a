//! The tag of the wheel: the platforms that the libraries of its FMU run on, so that pip does not
//! install it elsewhere.

use crate::check::{Archive, newest_glibc};
use anyhow::{Context, Result, bail, ensure};
use object::{Architecture, BinaryFormat, Object};
use std::collections::BTreeSet;

/// Oldest glibc that a tag names: older systems have no Python that the package runs on.
const OLDEST_GLIBC: (u32, u32) = (2, 17);

/// Python, ABI and platform tags in compressed form, such as
/// `py3-none-manylinux_2_17_x86_64.win_amd64`: any Python 3, no ABI of Python, platforms in order.
pub(crate) fn of(fmu: &Archive) -> Result<String> {
    let mut platforms = BTreeSet::new();
    for (_, _, entry) in fmu.libraries() {
        let platform = platform_tag(&entry.bytes);
        platforms.insert(platform.with_context(|| format!("{} has no wheel tag", entry.name))?);
    }
    ensure!(!platforms.is_empty(), "the FMU has no library: build it with `cargo fmu build`");
    Ok(format!("py3-none-{}", platforms.into_iter().collect::<Vec<_>>().join(".")))
}

/// Platform tag of a library, from its content: an FMU for ARM alone has a copy in the folder of
/// x86, for FMPy.
fn platform_tag(library: &[u8]) -> Result<String> {
    let file = object::File::parse(library)?;
    let tag = match (file.format(), file.architecture()) {
        (BinaryFormat::Elf, Architecture::X86_64) => linux_tag(library, "x86_64"),
        (BinaryFormat::Elf, Architecture::Aarch64) => linux_tag(library, "aarch64"),
        (BinaryFormat::Elf, Architecture::I386) => linux_tag(library, "i686"),
        (BinaryFormat::Pe, Architecture::X86_64) => "win_amd64".to_owned(),
        (BinaryFormat::Pe, Architecture::Aarch64) => "win_arm64".to_owned(),
        (BinaryFormat::Pe, Architecture::I386) => "win32".to_owned(),
        // the oldest macOS that rustc builds for
        (BinaryFormat::MachO, Architecture::X86_64) => "macosx_10_12_x86_64".to_owned(),
        (BinaryFormat::MachO, Architecture::Aarch64) => "macosx_11_0_arm64".to_owned(),
        (format, architecture) => bail!("a library of format {format:?} for {architecture:?} is not known"),
    };
    Ok(tag)
}

/// `manylinux` with the glibc that the library needs (PEP 600). That it needs no library beyond
/// those of every Linux is a check of the FMU.
fn linux_tag(library: &[u8], machine: &str) -> String {
    match newest_glibc(library) {
        Some(needed) => {
            let (major, minor) = needed.max(OLDEST_GLIBC);
            format!("manylinux_{major}_{minor}_{machine}")
        }
        None => format!("linux_{machine}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Write};
    use zip::write::{SimpleFileOptions, ZipWriter};

    /// The header of an ELF file, little endian, 64 bits, and text after it.
    fn elf(machine: u8, text: &str) -> Vec<u8> {
        let mut bytes = vec![0_u8; 64];
        bytes[..7].copy_from_slice(b"\x7fELF\x02\x01\x01");
        (bytes[16], bytes[18], bytes[20], bytes[52]) = (3, machine, 1, 64);
        bytes.extend_from_slice(text.as_bytes());
        bytes
    }

    /// The headers of a DLL for x86 with 64 bits.
    fn dll() -> Vec<u8> {
        let mut bytes = vec![0_u8; 64 + 24 + 240];
        bytes[..2].copy_from_slice(b"MZ");
        bytes[0x3c] = 64;
        bytes[64..70].copy_from_slice(b"PE\0\0\x64\x86");
        (bytes[64 + 20], bytes[64 + 22]) = (240, 0x22);
        bytes[88..90].copy_from_slice(b"\x0b\x02");
        bytes[88 + 108] = 16;
        bytes
    }

    const X86_64: u8 = 62;
    const AARCH64: u8 = 183;

    fn fmu(libraries: &[(&str, Vec<u8>)]) -> Archive {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (folder, bytes) in libraries {
            zip.start_file(format!("binaries/{folder}/FrettingContact.so"), SimpleFileOptions::default())
                .unwrap();
            zip.write_all(bytes).unwrap();
        }
        Archive::read(zip.finish().unwrap()).unwrap()
    }

    #[test]
    fn the_tag_of_linux_names_the_glibc_that_the_library_needs() {
        let tag = |machine, text| platform_tag(&elf(machine, text)).unwrap();
        assert_eq!(tag(X86_64, "GLIBC_2.2.5\0"), "manylinux_2_17_x86_64");
        assert_eq!(tag(AARCH64, "GLIBC_2.17\0"), "manylinux_2_17_aarch64");
        assert_eq!(tag(X86_64, "GLIBC_2.4\0GLIBC_2.34\0"), "manylinux_2_34_x86_64");
        assert_eq!(tag(X86_64, "needs no glibc"), "linux_x86_64");
    }

    #[test]
    fn several_platforms_make_a_compressed_set_in_order() {
        let fmu = fmu(&[
            ("win64", dll()),
            ("linux64", elf(X86_64, "GLIBC_2.17\0")),
            ("aarch64-linux", elf(AARCH64, "GLIBC_2.17\0")),
        ]);
        assert_eq!(of(&fmu).unwrap(), "py3-none-manylinux_2_17_aarch64.manylinux_2_17_x86_64.win_amd64");
    }

    #[test]
    fn a_library_counts_by_its_content_and_not_by_its_folder() {
        let arm = || elf(AARCH64, "GLIBC_2.17\0");
        let fmu = fmu(&[("aarch64-linux", arm()), ("linux64", arm())]);
        assert_eq!(of(&fmu).unwrap(), "py3-none-manylinux_2_17_aarch64");
    }

    #[test]
    fn what_has_no_tag_is_named() {
        let message = |libraries: &[_]| format!("{:#}", of(&fmu(libraries)).unwrap_err());
        let found = message(&[("linux64", elf(243, ""))]);
        assert!(found.contains("binaries/linux64") && found.contains("Riscv64"), "{found}");
        assert!(message(&[]).contains("cargo fmu build"));
    }
}
