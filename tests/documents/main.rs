//! What users read, against the program: the guide, the drawing of the layers, the Rust example,
//! the model description.

mod guide;
mod layers;
#[cfg(feature = "fmi2")]
mod model_description;
mod rust_example;
