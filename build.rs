//! Compiles the GUID of modelDescription.xml into the library, and keeps foreign symbols out of its interface.

use std::fs;

fn main() {
    println!("cargo:rerun-if-changed=modelDescription.xml");
    println!("cargo:rerun-if-changed=build.rs");
    let description = fs::read_to_string("modelDescription.xml").expect("modelDescription.xml is readable");
    let guid = description.split_once("guid=\"").and_then(|(_, rest)| rest.split_once('"'));
    let (guid, _) = guid.expect("modelDescription.xml has a guid");
    println!("cargo:rustc-env=FRETTING_CONTACT_GUID={guid}");
    // Only the functions of `src/fmi2/exports` are the library's interface; fmi-sys brings a symbol of its own.
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,--exclude-libs,ALL");
    }
}
