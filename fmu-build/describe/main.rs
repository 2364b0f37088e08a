//! Writes the files that follow from the table of variables: modelDescription.xml and
//! docs/variables.md. `cargo fmu describe` runs it. An example of the library, not a part of
//! `fmu-build`, since it needs the table itself.

mod model_description;
mod variables_page;

use std::path::Path;
use std::{fs, io};

fn main() -> io::Result<()> {
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR"));
    fs::write(checkout.join("modelDescription.xml"), model_description::model_description())?;
    fs::write(checkout.join("docs/variables.md"), variables_page::variables_page())
}
