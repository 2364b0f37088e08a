//! The guide: its links lead somewhere, and its page of messages has those that exist.

use fretting_contact::Error;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md"), root().join("examples/README.md")];
    pages.extend(fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path()));
    pages
}

/// Anchor of a heading, as forges make it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-')
        .collect::<String>()
        .replace(' ', "-")
}

#[test]
fn links_lead_to_files_and_headings_that_exist() {
    let mut seen = 0;
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.contains("://") {
                continue;
            }
            let (file, heading) =
                link.split_once('#').map_or((link, None), |(file, rest)| (file, Some(rest)));
            let target = page.parent().unwrap().join(file);
            assert!(target.exists(), "{}: {link} leads nowhere", page.display());
            if let Some(heading) = heading {
                let text = fs::read_to_string(&target).unwrap();
                let there = text
                    .lines()
                    .any(|line| line.starts_with('#') && anchor(line.trim_start_matches('#')) == heading);
                assert!(there, "{}: {link} names a heading that is not there", page.display());
            }
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen} links");
}

/// What stands in the first column of the tables of messages.
fn messages() -> BTreeSet<String> {
    let page = read("docs/troubleshooting.md");
    let rows = page.lines().filter(|line| line.starts_with("| `"));
    let first = rows.map(|row| row.split(" | ").next().unwrap().to_owned());
    first.flat_map(|cell| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()).collect()
}

#[test]
fn every_listed_message_is_one_that_the_program_has() {
    let mut sources = String::new();
    for folder in ["src", "src/fmi2", "src/profile", "src/engine"] {
        for entry in fs::read_dir(root().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                sources += &fs::read_to_string(path).unwrap();
            }
        }
    }
    // texts may be broken over lines in the source
    let flat = sources.replace("\\\n", "").split_whitespace().collect::<Vec<_>>().join(" ");
    let messages: Vec<_> = messages().into_iter().filter(|message| *message != "stick_radius").collect();
    assert!(messages.len() > 20, "{messages:?}");
    for message in messages {
        assert!(flat.contains(&message), "no message says {message:?}");
    }
}

#[test]
fn every_error_of_the_engine_is_listed() {
    let (name, value, requirement) = ("radius", -1.0, "it is positive");
    let errors = [
        Error::Parameter { name, value, requirement },
        Error::Input { name, value, requirement },
        Error::ProfileTable { place: "line 1".into(), problem: "r does not rise".into() },
        Error::NonMonotoneImage { radius: 1.0, contact_radius: 2.0 },
        Error::BeyondTable { quantity: "normal_force", value, radius: 1.0 },
        Error::BeyondNumbers { what: "normal force, N", value: 1e130, most: 1e120 },
        Error::NotFinite { what: "the work", normal: 1.0, displacement: 1.0 },
        Error::TooMuchWear { cycles: 2.0, left: 1.0, amplitude: 1.0, steps: 1 },
        Error::WearOutrun { displacement: 1.0, from: 0.0 },
        Error::Snapshot("it is damaged".into()),
    ];
    let messages = messages();
    for error in errors {
        let text = error.to_string();
        assert!(messages.iter().any(|message| text.contains(message.as_str())), "not in the guide: {text}");
    }
}
