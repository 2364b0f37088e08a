//! Compiles the GUID of modelDescription.xml into the library.

use std::fs;

fn main() {
    println!("cargo:rerun-if-changed=modelDescription.xml");
    println!("cargo:rerun-if-changed=build.rs");
    let description = fs::read_to_string("modelDescription.xml").expect("modelDescription.xml is readable");
    let guid = description.split_once("guid=\"").and_then(|(_, rest)| rest.split_once('"'));
    let (guid, _) = guid.expect("modelDescription.xml has a guid");
    println!("cargo:rustc-env=FRETTING_CONTACT_GUID={guid}");
}
