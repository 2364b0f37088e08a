//! Wording of documents and comments: phrases to avoid (`fmu-build/phrases.txt`), and lines of
//! prose of at most 100 columns.

use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// Phrases with their replacements.
const PHRASES: &str = include_str!("../phrases.txt");

/// Longest line of prose, in characters.
const LONGEST: usize = 100;

/// Kinds of files that have prose.
const ENDINGS: [&str; 8] = ["md", "rs", "py", "c", "html", "toml", "mo", "js"];

/// The findings in some files below `root`, each with its place and what to write instead.
pub(crate) fn findings(root: &Path, files: &[PathBuf]) -> Result<Vec<String>> {
    let phrases: Vec<_> = phrases().collect();
    let mut findings = Vec::new();
    for file in files {
        let name = file.strip_prefix(".").unwrap_or(file).to_path_buf();
        let ending = name.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if !ENDINGS.contains(&ending) {
            continue;
        }
        let text = fs::read_to_string(root.join(&name))
            .with_context(|| format!("cannot read {}", name.display()))?;
        let found = in_phrases(&text, &phrases).chain(too_long(&name, &text));
        findings.extend(found.map(|(line, what)| format!("{}:{line}: {what}", name.display())));
    }
    Ok(findings)
}

/// Phrase and replacement.
fn phrases() -> impl Iterator<Item = (&'static str, &'static str)> {
    let lines = PHRASES.lines().filter(|line| !line.starts_with('#'));
    lines.filter_map(|line| line.split_once(" | "))
}

/// Lines, from 1, with a phrase to avoid.
fn in_phrases<'a>(
    text: &'a str,
    phrases: &'a [(&'static str, &'static str)],
) -> impl Iterator<Item = (usize, String)> + 'a {
    text.lines().enumerate().flat_map(move |(index, line)| {
        let line = line.to_lowercase();
        let found = phrases.iter().filter(move |(phrase, _)| has_phrase(&line, phrase));
        found.map(move |(phrase, better)| (index + 1, format!("\"{phrase}\": write \"{better}\"")))
    })
}

/// Whether a line has these words, not as parts of longer ones.
fn has_phrase(line: &str, phrase: &str) -> bool {
    let is_letter = |character: Option<char>| character.is_some_and(char::is_alphanumeric);
    line.match_indices(phrase).any(|(start, _)| {
        let (before, after) = (&line[..start], &line[start + phrase.len()..]);
        !is_letter(before.chars().next_back()) && !is_letter(after.chars().next())
    })
}

/// Lines, from 1, of prose that are too long: Markdown outside code and tables, comments in Rust.
fn too_long(name: &Path, text: &str) -> impl Iterator<Item = (usize, String)> {
    let markdown = name.extension().is_some_and(|ending| ending == "md");
    let generated = name.starts_with("reports");
    let rust = name.extension().is_some_and(|ending| ending == "rs");
    let mut code = false;
    let mut found = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let content = line.trim_start();
        code ^= markdown && content.starts_with("```");
        // a table's row, a picture or a link cannot be broken
        let whole = ["|", "![", "//! |", "/// |"].iter().any(|start| content.starts_with(start));
        let prose = if markdown { !code && !generated } else { rust && content.starts_with("//") };
        let length = line.chars().count();
        if prose && !whole && length > LONGEST {
            found.push((index + 1, format!("{length} columns: prose has at most {LONGEST}")));
        }
    }
    found.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phrase_lines(text: &str) -> Vec<usize> {
        in_phrases(text, &[("red tape", "rules"), ("in lieu", "instead")]).map(|(line, _)| line).collect()
    }

    #[test]
    fn phrases_are_found_as_whole_words() {
        assert_eq!(phrase_lines("None.\n/// Red tape,\nred-tape\nit is in lieu of that"), [2, 4]);
        assert!(phrase_lines("bored tape, in lieutenants").is_empty());
    }

    #[test]
    fn a_finding_has_place_phrase_and_replacement() {
        let folder = std::env::temp_dir().join(format!("fmu-build-wording-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (phrase, better) = phrases().next().unwrap();
        fs::write(folder.join("page.md"), format!("one\n{}\n{phrase}\n", "x".repeat(101))).unwrap();
        fs::write(folder.join("picture.svg"), phrase).unwrap();
        let files = [PathBuf::from("./page.md"), PathBuf::from("./picture.svg")];
        let found = findings(&folder, &files).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(found.len(), 2, "{found:?}");
        assert_eq!(found[0], format!("page.md:3: \"{phrase}\": write \"{better}\""));
        assert!(found[1].contains("page.md:2: 101 columns"));
    }

    #[test]
    fn code_tables_and_other_files_may_be_wider() {
        let wide = "x".repeat(120);
        let lines = |name: &str, text: &str| {
            too_long(Path::new(name), text).map(|(line, _)| line).collect::<Vec<_>>()
        };
        assert_eq!(lines("a.md", &format!("```text\n{wide}\n```\n| {wide} |\n{wide}")), [5]);
        assert_eq!(lines("fmu-build/src/a.rs", &format!("let a = \"{wide}\";\n    // {wide}")), [2]);
        assert!(lines("a.py", &format!("// {wide}")).is_empty());
        assert!(lines("reports/a.md", &wide).is_empty());
    }

    #[test]
    fn every_phrase_has_a_replacement() {
        let lines = PHRASES.lines().filter(|line| !line.starts_with('#')).count();
        assert_eq!(phrases().count(), lines);
        assert!(phrases().all(|(phrase, better)| !phrase.is_empty() && !better.is_empty()));
    }
}
