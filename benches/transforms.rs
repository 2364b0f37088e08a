//! The Abel transforms by tables and by the hierarchical scheme, against the number of cells; and
//! profiles given by points.
//!
//! `cargo bench --bench transforms`. Nodes are graded towards both ends, as on a slipping annulus.
//! After Criterion's own lines come a table of the shortest times (those least disturbed), the
//! exponent of growth of each and the number of cells at which the fast form wins.
#![allow(missing_docs, reason = "a benchmark")]

use criterion::{BenchmarkId, Criterion};
use fretting_contact::transform::{DenseAbel, FastAbel, Scratch};
use fretting_contact::{FrettingContact, Parameters, Profile, ProfileTable};
use std::hint::black_box;
use std::time::{Duration, Instant};

const TRANSFORMS: [&str; 3] = ["inverse_abel", "abel", "pressure"];

/// Tables above this take more than 2 GB.
const MOST_DENSE: usize = 8192;

/// Seconds per call: (form, transform, cells, shortest time).
type Figures = Vec<(&'static str, &'static str, usize, f64)>;

fn nodes(cells: usize) -> Vec<f64> {
    let share = |xi: f64| xi.powi(3) * (4.0 - 3.0 * xi);
    (0..=cells).map(|i| share(i as f64 / cells as f64)).collect()
}

/// Measures one form of all three transforms.
fn measure(
    criterion: &mut Criterion,
    figures: &mut Figures,
    form: &'static str,
    cells: usize,
    mut call: impl FnMut(&str, &[f64], &mut [f64], &mut Scratch),
) {
    let values: Vec<f64> = nodes(cells).iter().map(|x| 1.0 - x * x).collect();
    let (mut out, mut scratch) = (vec![0.0; cells + 1], Scratch::default());
    for transform in TRANSFORMS {
        let mut times = Vec::new();
        criterion.benchmark_group(transform).bench_function(BenchmarkId::new(form, cells), |b| {
            b.iter_custom(|count| {
                let start = Instant::now();
                for _ in 0..count {
                    call(transform, black_box(&values), black_box(&mut out), &mut scratch);
                }
                let time = start.elapsed();
                times.push(time.as_secs_f64() / count as f64);
                time
            });
        });
        // a filter on the command line may leave it out
        if !times.is_empty() {
            figures.push((form, transform, cells, times.iter().copied().fold(f64::INFINITY, f64::min)));
        }
    }
}

/// A measured profile: a sphere of 10 mm with waves on it, known at so many radii.
fn measured(points: usize) -> Vec<(f64, f64)> {
    let radii = (0..points).map(|i| 1e-3 * i as f64 / (points - 1) as f64);
    radii.map(|r| (r, r * r / 0.02 + 1e-12 * (r * 1e5).cos())).collect()
}

/// What a profile given by points costs: to build, to press, to read at 64 radii.
fn table(criterion: &mut Criterion) {
    for points in [1000, 10_000, 100_000] {
        let given = measured(points);
        let mut group = criterion.benchmark_group("table");
        group.bench_function(BenchmarkId::new("transforms of even cells prepared", points), |b| {
            let x: Vec<f64> = (0..points).map(|i| i as f64).collect();
            b.iter(|| FastAbel::new(black_box(&x)));
        });
        group.bench_function(BenchmarkId::new("built", points), |b| {
            b.iter(|| ProfileTable::new(black_box(given.clone())).unwrap());
        });
        let profile = Profile::Table(ProfileTable::new(given).unwrap());
        let parameters = Parameters { profile, wear_coefficient: 0.0, ..Parameters::default() };
        group.bench_function(BenchmarkId::new("contact made and pressed", points), |b| {
            b.iter(|| {
                let mut contact = FrettingContact::new(parameters.clone()).unwrap();
                contact.start_at(black_box(100.0), 0.0).unwrap();
                contact
            });
        });
        let mut contact = FrettingContact::new(parameters.clone()).unwrap();
        contact.start_at(100.0, 0.0).unwrap();
        contact.advance_to(100.0, 1e-6).unwrap();
        group.bench_function(BenchmarkId::new("fields at 64 radii", points), |b| {
            b.iter(|| {
                let fields = |r: f64| {
                    (contact.unworn_height_at(r), contact.pressure_at(r), contact.shear_traction_at(r))
                };
                contact.probe_radii().map(fields)
            });
        });
        group.bench_function(BenchmarkId::new("largest pressure", points), |b| {
            b.iter(|| black_box(&contact).max_pressure());
        });
    }
}

/// Least-squares slope of log time over log cells.
fn exponent(points: &[(usize, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|&(n, t)| ((n as f64).ln(), t.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) =
        (logs.iter().map(|p| p.0).sum::<f64>() / count, logs.iter().map(|p| p.1).sum::<f64>() / count);
    logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / logs.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

fn report(figures: &Figures) {
    let series = |form: &str, transform: &str| -> Vec<(usize, f64)> {
        figures.iter().filter(|f| f.0 == form && f.1 == transform).map(|f| (f.2, f.3)).collect()
    };
    for transform in TRANSFORMS {
        let (dense, fast) = (series("dense", transform), series("fast", transform));
        println!("\n{transform}\n{:>8} {:>12} {:>12}", "cells", "dense, µs", "fast, µs");
        for &(cells, time) in &fast {
            let tables =
                dense.iter().find(|p| p.0 == cells).map_or(String::new(), |p| format!("{:.2}", p.1 * 1e6));
            println!("{cells:>8} {tables:>12} {:>12.2}", time * 1e6);
        }
        for (form, points) in [("dense", &dense), ("fast", &fast)] {
            let large: Vec<_> = points.iter().copied().filter(|p| p.0 >= 512).collect();
            if large.len() > 1 {
                println!("exponent of growth from 512 cells on, {form}: {:.2}", exponent(&large));
            }
        }
        let wins = fast.iter().find(|p| dense.iter().any(|d| d.0 == p.0 && d.1 > p.1));
        if let Some((cells, _)) = wins {
            println!("fast wins from {cells} cells on");
        }
    }
}

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
        .sample_size(20)
        .configure_from_args();
    let mut figures = Figures::new();
    for cells in [32, 64, 96, 128, 160, 192, 256, 384, 512, 1024, 2048, 4096, 8192, 16384] {
        let x = nodes(cells);
        if cells <= MOST_DENSE {
            let dense = DenseAbel::new(&x);
            measure(&mut criterion, &mut figures, "dense", cells, |which, v, out, scratch| match which {
                "inverse_abel" => dense.inverse_abel(v, out, scratch),
                "abel" => dense.abel(v, out, scratch),
                _ => dense.pressure(v, out, scratch),
            });
        }
        let fast = FastAbel::new(&x);
        measure(&mut criterion, &mut figures, "fast", cells, |which, v, out, scratch| match which {
            "inverse_abel" => fast.inverse_abel(v, out, scratch),
            "abel" => fast.abel(v, out, scratch),
            _ => fast.pressure(v, out, scratch),
        });
    }
    table(&mut criterion);
    report(&figures);
    criterion.final_summary();
}
