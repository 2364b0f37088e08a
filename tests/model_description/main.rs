//! modelDescription.xml is what the variable table says, and passes the checks that other tools do not make.
//!
//! After a change of the table, write the file anew with `BLESS=1 cargo test --test model_description`.
#![cfg(feature = "fmi2")]

mod checks;
mod writer;

use std::path::PathBuf;
use std::{env, fs};

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("modelDescription.xml")
}

#[test]
fn the_file_is_what_the_table_says() {
    let written = writer::model_description();
    if env::var_os("BLESS").is_some() {
        fs::write(path(), &written).expect("modelDescription.xml can be written");
    }
    let file = fs::read_to_string(path()).expect("modelDescription.xml can be read");
    let differs = file.lines().zip(written.lines()).position(|(a, b)| a != b);
    assert!(
        file == written,
        "modelDescription.xml differs from the variable table, first in line {:?}; write it anew with \
         BLESS=1 cargo test --test model_description",
        differs.map(|line| line + 1)
    );
}

#[test]
fn the_library_has_the_guid_of_the_file() {
    // The file that BLESS has just written is compiled in by the next build only.
    if env::var_os("BLESS").is_none() {
        assert!(writer::model_description().contains(&format!("guid=\"{}\"", fretting_contact::fmi2::GUID)));
    }
}
