//! Error against run time: lives, histories, a loop; on the same axes the published procedure, a
//! plain spring row and, where it has been asked, an independent solver. Writes
//! `reports/error_against_time.csv` and `.md`.
//!
//! `cargo run --release --no-default-features --example precision [-- folder]`

mod coupled;
mod elastic;
mod lives;
#[path = "../machine.rs"]
mod machine;
mod page;
mod point;
#[path = "../../../benches/published/mod.rs"]
mod published;
mod transient;

use point::{Comparison, Point};
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "reports".into()));
    std::fs::create_dir_all(&folder)?;
    println!("without wear …");
    let (mut points, mut comparisons) = elastic::all()?;
    println!("in a system …");
    let (more, about) = coupled::all()?;
    points.extend(more);
    comparisons.extend(about);
    let others = independent(&folder);
    points.extend(others.0);
    for (what, part) in
        [("lives", lives::all as fn() -> (Vec<Point>, Vec<Comparison>)), ("step by step", transient::all)]
    {
        println!("{what} …");
        let (more, about) = part();
        points.extend(more);
        comparisons.extend(about);
    }
    for point in &points {
        println!(
            "{}: {}, {}: {:.1e} in {:.3e} s",
            point.problem, point.method, point.settings, point.error, point.time[0]
        );
    }
    std::fs::write(folder.join("error_against_time.csv"), point::csv(&points, &comparisons))?;
    std::fs::write(folder.join("error_against_time.md"), page::page(&points, &comparisons, &others.1))?;
    Ok(())
}

/// What `independent.py` has left: its points, and a word on them.
fn independent(folder: &Path) -> (Vec<Point>, String) {
    let Ok(text) = std::fs::read_to_string(folder.join("independent.csv")) else {
        return (Vec::new(), "The independent solver, Tamaas, is not installed here: left out.".into());
    };
    let mut points = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells.get(i).and_then(|cell| cell.parse::<f64>().ok()).unwrap_or(f64::NAN);
        points.push(Point {
            problem: elastic::HERTZ.into(),
            method: "boundary elements",
            settings: format!("{} x {} points", number(0), number(0)),
            error: number(1),
            work_error: f64::NAN,
            time: [number(2), number(3), number(4)],
            note: String::new(),
        });
    }
    let word = "Boundary elements: Tamaas, a full solution of the half-space on a square grid, four contact radii wide; it knows \
                Hertz' contact as one of any.";
    (points, word.into())
}
