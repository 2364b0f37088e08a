//! The Rust example as it runs, and what it prints.

#[path = "../../examples/rust/main.rs"]
#[allow(dead_code, reason = "its main prints to the terminal")]
mod example;

/// The number behind a title.
fn number(text: &str, title: &str) -> f64 {
    let line = text.lines().find(|line| line.starts_with(title)).unwrap_or_else(|| panic!("no {title}"));
    line[title.len()..].split_whitespace().next().expect("a number").parse().expect("a number")
}

#[test]
fn the_printed_numbers_are_right() {
    let mut out = Vec::new();
    example::run(&mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let near = |value: f64, truth: f64| (value / truth - 1.0).abs() < 1e-4;
    assert!(near(number(&text, "contact radius"), 1.86626e-4), "{text}");
    assert!(near(number(&text, "peak pressure"), 1.37088e9), "{text}");
    let worn = number(&text, "worn volume");
    assert!(near(worn, 4e-14 * number(&text, "work of friction")), "{text}");
    let (moved, force) = (number(&text, "the contact moves"), number(&text, "tangential force"));
    assert!((moved + force / 2e7 - 2e-6).abs() < 1e-10, "{text}");
    assert!(near(force, 60.0 * (1.0 - (1.0 - moved / 2.537551e-6).powf(1.5))), "{text}");
}
