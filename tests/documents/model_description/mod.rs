//! modelDescription.xml and docs/variables.md are what the variable table says; the first passes
//! the checks that other tools do not make.

mod checks;
#[path = "../../../fmu-build/describe/variables_page.rs"]
mod page;
#[path = "../../../fmu-build/describe/model_description.rs"]
mod writer;

use std::fs;
use std::path::PathBuf;

/// Compares a file with what the table says.
fn compare(name: &str, written: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name);
    let file = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name} cannot be read: {error}"));
    let differs = file.lines().zip(written.lines()).position(|(a, b)| a != b);
    assert!(
        file == written,
        "{name} differs from the variable table, first in line {:?}; `cargo fmu describe` writes it",
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
    assert!(writer::model_description().contains(&format!("guid=\"{}\"", fretting_contact::fmi2::GUID)));
}
