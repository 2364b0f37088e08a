//! modelDescription.xml and docs/variables.md are what the variable table says; the first passes
//! the checks that other tools do not make.
//!
//! After a change of the table write both with `BLESS=1 cargo test --test documents`.

mod checks;
mod page;
mod writer;

use std::path::PathBuf;
use std::{env, fs};

/// Compares a file with what the table says, or writes it.
fn compare(name: &str, written: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name);
    if env::var_os("BLESS").is_some() {
        fs::write(&path, written).unwrap_or_else(|error| panic!("{name} cannot be written: {error}"));
    }
    let file = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name} cannot be read: {error}"));
    let differs = file.lines().zip(written.lines()).position(|(a, b)| a != b);
    assert!(
        file == written,
        "{name} differs from the variable table, first in line {:?}; write it with \
         BLESS=1 cargo test --test documents",
        differs.map(|line| line + 1)
    );
}

#[test]
fn the_file_is_what_the_table_says() {
    compare("modelDescription.xml", &writer::model_description());
}

#[test]
fn the_page_of_variables_is_what_the_table_says() {
    compare("docs/variables.md", &page::variables_page());
}

#[test]
fn the_library_has_the_guid_of_the_file() {
    // The file that BLESS has just written is compiled in by the next build only.
    if env::var_os("BLESS").is_none() {
        assert!(writer::model_description().contains(&format!("guid=\"{}\"", fretting_contact::fmi2::GUID)));
    }
}
