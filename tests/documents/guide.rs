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
    for folder in ["docs", "docs/decisions"] {
        let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
        pages.extend(entries.filter(|path| path.is_file()));
    }
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

/// The string literals that follow a mark in a source, as the compiler reads them: `\` at the end
/// of a line joins it to the next.
fn literals_after(source: &str, mark: &str) -> Vec<String> {
    let mut found = Vec::new();
    for rest in source.split(mark).skip(1) {
        let Some(rest) = rest.trim_start().strip_prefix('"') else { continue };
        let (mut text, mut characters) = (String::new(), rest.chars().peekable());
        while let Some(c) = characters.next().filter(|c| *c != '"') {
            match (c, characters.peek()) {
                ('\\', Some('\n')) => while characters.next_if(|c| c.is_whitespace()).is_some() {},
                ('\\', Some(_)) => text.extend(characters.next()),
                _ => text.push(c),
            }
        }
        found.push(text);
    }
    found
}

#[test]
fn literals_are_read_as_the_compiler_does() {
    let source = "#[error(\n  \"one \\\n     two\"\n)] #[error(\"a \\\"b\\\" c\", x)]";
    assert_eq!(literals_after(source, "#[error("), ["one two", "a \"b\" c"]);
}

/// Texts that carry another message and say nothing of their own.
const FRAMES: [&str; 4] = [
    "{name}: {problem}",
    "{context}: {problem}",
    "profile_file = \"{name}\" ({}): {problem}",
    "contacts_file = \"{name}\" ({}): {problem}",
];

#[test]
fn every_message_in_the_sources_is_listed() {
    let mut texts = Vec::new();
    for path in ["src/error.rs", "src/fmi2/refusal.rs"] {
        texts.extend(literals_after(&read(path), "#[error("));
    }
    for path in ["src/fmi2/serialized.rs", "src/fmi2/saved.rs"] {
        texts.extend(
            literals_after(&read(path), "refuse(")
                .into_iter()
                .map(|text| format!("serialised state is refused: {text}")),
        );
    }
    // of the instance itself: all but what it tells of its life
    let events = [
        "is instantiated",
        "initialized with",
        "profile_file begins with",
        "terminated after",
        "an internal failure in",
    ];
    let instance = literals_after(&read("src/fmi2/component.rs"), "format!(");
    texts.extend(instance.into_iter().filter(|text| !events.iter().any(|event| text.contains(event))));
    let warnings = literals_after(&read("src/fmi2/warnings.rs"), "format!(");
    assert_eq!(warnings.len(), 12);
    texts.extend(warnings);
    texts.retain(|text| !FRAMES.contains(&text.as_str()) && text != "{}: {refusal}");
    assert!(texts.len() > 40, "{texts:?}");
    let messages = messages();
    for text in texts {
        // "is refused" alone explains what names its own range, nothing else
        let explains = |message: &str| {
            text.contains(message) && (message != "is refused" || text.contains("{requirement}"))
        };
        assert!(messages.iter().any(|message| explains(message)), "not in the guide: {text}");
    }
}

#[test]
fn every_error_of_the_engine_is_listed() {
    let (name, value, requirement) = ("radius", -1.0, "it is positive");
    let errors = [
        Error::Parameter { name, value, requirement },
        Error::Input { name, value, requirement },
        Error::ProfileTable { place: "line 1".into(), problem: "r does not rise".into() },
        Error::NonMonotoneImage { radius: 1.0, contact_radius: 2.0, fall: 1.0, roughness: 1.0 },
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

/// The recipe for a compliant fixture is the code that the tests run.
#[test]
fn the_recipe_for_a_fixture_is_the_one_that_is_tested() {
    let page = read("docs/interface.md");
    let start = page.find("/// Takes an interface in a fixture").expect("the recipe is there");
    let recipe = page[start..].split("```").next().unwrap_or_default();
    assert!(recipe.contains("fn drive("), "{recipe}");
    let tests = read("tests/engine/interface_derivatives.rs");
    assert!(tests.contains(recipe), "the test has another recipe");
}
