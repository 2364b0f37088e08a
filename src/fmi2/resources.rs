//! The FMU's resources folder, and profile files.

use super::refusal::{Checked, Refusal};
use crate::interface::Summit;
use crate::profile::{LengthUnit, ProfileTable};
use percent_encoding::percent_decode_str;
use std::ffi::CStr;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Largest profile file, bytes: 800 for each point of the longest table.
const LARGEST_PROFILE: u64 = 16_000_000;

/// Largest file of contacts, bytes: 100 for each of the most contacts.
const LARGEST_CONTACTS: u64 = 1_000_000_000;

/// Where relative file names are looked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Resources {
    folder: Option<PathBuf>,
}

impl Resources {
    /// From the `fmuResourceLocation` of fmi2Instantiate. Importers write the same folder as
    /// `file:/a`, `file:///a` or `file://localhost/a`, with or without escapes; some give a plain
    /// path. None where there is no such folder on this machine.
    pub(super) fn from_uri(uri: &str) -> Option<Self> {
        let (path, encoded) = match uri.split_once(':') {
            Some((scheme, rest)) if scheme.eq_ignore_ascii_case("file") => (local_path(rest)?, true),
            // One letter is a drive, not a scheme.
            Some((scheme, _)) if scheme.len() > 1 && !scheme.contains(['/', '\\']) => return None,
            _ => (uri, false),
        };
        let path =
            if encoded { percent_decode_str(path).decode_utf8().ok()?.into_owned() } else { path.to_owned() };
        // file:///C:/a is C:/a.
        let drive = path.strip_prefix('/').filter(|rest| rest.as_bytes().get(1) == Some(&b':'));
        let folder = PathBuf::from(drive.unwrap_or(&path));
        (!folder.as_os_str().is_empty()).then_some(Self { folder: Some(folder) })
    }

    /// Where a file is looked for: a relative one in the resources folder, then in the working
    /// directory.
    fn places(&self, file: &Path) -> Vec<PathBuf> {
        let folder = self.folder.as_ref().filter(|_| !file.is_absolute());
        let places = folder.map(|folder| folder.join(file)).into_iter().chain([file.to_owned()]);
        places.map(|place| std::path::absolute(&place).unwrap_or(place)).collect()
    }

    /// Reads the file that a parameter names; returns its path and its text.
    fn read(&self, parameter: &'static str, name: &str, most: u64) -> Checked<(PathBuf, String)> {
        let mut places = self.places(Path::new(name));
        if let Some(k) = places.iter().position(|place| place.exists()) {
            places = vec![places.swap_remove(k)];
        }
        match read_text(&places[0], most) {
            Err(reason) => Err(Refusal::File { parameter, name: name.into(), places, reason }.into()),
            Ok(text) => Ok((places.swap_remove(0), text)),
        }
    }

    /// Reads the profile that the parameter `profile_file` names, whose columns have this unit.
    pub(super) fn profile_table(&self, file: &CStr, unit: LengthUnit) -> Checked<ProfileTable> {
        let name = file.to_string_lossy().into_owned();
        if name.is_empty() {
            return Err(Refusal::NoProfileFile.into());
        }
        let (path, text) = self.read("profile_file", &name, LARGEST_PROFILE)?;
        Ok(ProfileTable::parse_in(&text, unit).map_err(|problem| Refusal::ProfileContent {
            name,
            path,
            problem,
        })?)
    }

    /// Reads the contacts that the parameter `contacts_file` names, whose lengths have this unit.
    pub(super) fn contacts(&self, file: &CStr, unit: LengthUnit) -> Checked<Vec<Summit>> {
        let name = file.to_string_lossy().into_owned();
        let (path, text) = self.read("contacts_file", &name, LARGEST_CONTACTS)?;
        Ok(Summit::parse(&text, unit).map_err(|problem| Refusal::ContactsContent { name, path, problem })?)
    }
}

/// The text of a file of at most `most` bytes. A header in another encoding does no harm.
fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let file = File::open(path)?;
    let mut size = file.metadata()?.len();
    let mut bytes = Vec::new();
    if size <= most {
        // the size of a device is 0, and it has no end
        file.take(most + 1).read_to_end(&mut bytes)?;
        size = bytes.len() as u64;
    }
    if size > most {
        return Err(io::Error::other(format!(
            "it has {size} bytes, and at most {most} are read: check the path, or shorten the table"
        )));
    }
    if bytes.contains(&0) {
        return Err(io::Error::other("it is UTF-16 or no text: save it as text in UTF-8"));
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The path of a file URI without its scheme; none if it is on another host.
fn local_path(rest: &str) -> Option<&str> {
    let Some(authority_and_path) = rest.strip_prefix("//") else { return Some(rest) };
    let (host, path) = authority_and_path.split_at(authority_and_path.find('/')?);
    (host.is_empty() || host.eq_ignore_ascii_case("localhost")).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ways_to_write_a_folder() {
        for (uri, folder) in [
            ("file:///tmp/a/resources", "/tmp/a/resources"),
            ("file:/tmp/a/resources", "/tmp/a/resources"),
            ("FILE://localhost/tmp/a", "/tmp/a"),
            ("file:///tmp/with%20blank/%7Bb%7D", "/tmp/with blank/{b}"),
            ("file:///tmp/with blank/{b}", "/tmp/with blank/{b}"),
            ("file:///tmp/gr%C3%B6%C3%9Fe", "/tmp/größe"),
            ("file:///tmp/100%", "/tmp/100%"),
            ("file:///C:/a", "C:/a"),
            ("/tmp/a%20b", "/tmp/a%20b"),
            ("C:/a", "C:/a"),
        ] {
            let resources = Resources::from_uri(uri).unwrap_or_else(|| panic!("{uri}"));
            assert_eq!(resources.folder.unwrap(), PathBuf::from(folder), "{uri}");
        }
        for uri in ["", "http://example.org/a", "file://server/a", "file://", "file:///%ff"] {
            assert_eq!(Resources::from_uri(uri), None, "{uri}");
        }
    }

    #[test]
    fn a_relative_file_is_taken_from_the_resources_first() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("tip.txt"), "0 0\n1e-4 1e-6\n2e-4 4e-6\n").unwrap();
        let resources = Resources { folder: Some(folder.path().to_owned()) };
        assert_eq!(resources.profile_table(c"tip.txt", LengthUnit::M).unwrap().points().len(), 3);
        let absolute = std::ffi::CString::new(folder.path().join("tip.txt").to_str().unwrap()).unwrap();
        assert_eq!(Resources::default().profile_table(&absolute, LengthUnit::M).unwrap().points().len(), 3);
        let missing = resources.profile_table(c"other.txt", LengthUnit::M).unwrap_err().to_string();
        assert!(missing.contains("profile_file = \"other.txt\""), "{missing}");
        for place in [folder.path(), &std::env::current_dir().unwrap()] {
            assert!(missing.contains(place.join("other.txt").to_str().unwrap()), "{missing}");
        }
        let missing = resources.contacts(c"other.txt", LengthUnit::M).unwrap_err().to_string();
        assert!(missing.contains("contacts_file = \"other.txt\"") && missing.contains(" or "), "{missing}");
    }

    #[test]
    fn a_file_that_is_not_readable_is_named_with_its_place_alone() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("tip.txt")).unwrap();
        let resources = Resources { folder: Some(folder.path().to_owned()) };
        let message = resources.profile_table(c"tip.txt", LengthUnit::M).unwrap_err().to_string();
        assert!(!message.contains(" or "), "{message}");
    }

    #[test]
    fn a_uri_is_answered_by_what_to_give() {
        for file in [c"file:///tmp/none.txt", c"FILE:none.txt"] {
            let message = Resources::default().profile_table(file, LengthUnit::M).unwrap_err().to_string();
            assert!(message.ends_with("; it is a URI: give a path"), "{message}");
        }
    }

    #[test]
    fn files_that_are_too_large_or_no_utf8_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let resources = Resources { folder: Some(folder.path().to_owned()) };
        let utf16: Vec<u8> =
            "\u{feff}0 0\n1e-4 1e-6\n2e-4 4e-6\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        std::fs::write(folder.path().join("utf16.txt"), utf16).unwrap();
        // takes no place on the disk
        File::create(folder.path().join("large.txt")).unwrap().set_len(5_000_000_000).unwrap();
        for (file, parts) in [
            (c"utf16.txt", ["utf16.txt: it is UTF-16", "save it as text in UTF-8"]),
            (c"large.txt", ["large.txt: it has 5000000000 bytes", "at most 16000000"]),
        ] {
            let message = resources.profile_table(file, LengthUnit::M).unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        }
        let message = resources.contacts(c"large.txt", LengthUnit::M).unwrap_err().to_string();
        assert!(message.contains("at most 1000000000"), "{message}");
        let message = resources.contacts(c"utf16.txt", LengthUnit::M).unwrap_err().to_string();
        assert!(message.contains("it is UTF-16"), "{message}");
    }
}
