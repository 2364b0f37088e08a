//! The Abel transforms against the number of cells, and profiles given by points.
//!
//! `cargo bench --bench transforms`. Nodes are graded towards both ends, as on a slipping annulus.
//! After Criterion's own lines come a table of the shortest times (those least disturbed) and the
//! exponent of growth of each.
#![allow(missing_docs, reason = "a benchmark")]

use criterion::{BenchmarkId, Criterion};
use fretting_contact::transform::Abel;
use fretting_contact::{FrettingContact, Parameters, Profile, ProfileTable};
use std::hint::black_box;
use std::time::{Duration, Instant};

const TRANSFORMS: [&str; 4] = ["inverse_abel", "abel", "pressure", "tables"];

/// Seconds per call: (transform, cells, shortest time).
type Figures = Vec<(&'static str, usize, f64)>;

fn nodes(cells: usize) -> Vec<f64> {
    let share = |xi: f64| xi.powi(3) * (4.0 - 3.0 * xi);
    (0..=cells).map(|i| share(i as f64 / cells as f64)).collect()
}

/// Measures all three transforms, and the making of their tables.
fn measure(criterion: &mut Criterion, figures: &mut Figures, cells: usize) {
    let x = nodes(cells);
    let tables = Abel::new(&x);
    let values: Vec<f64> = x.iter().map(|x| 1.0 - x * x).collect();
    let (mut out, mut buffer) = (vec![0.0; cells + 1], Vec::new());
    for transform in TRANSFORMS {
        let mut times = Vec::new();
        criterion.benchmark_group(transform).bench_function(BenchmarkId::from_parameter(cells), |b| {
            b.iter_custom(|count| {
                let start = Instant::now();
                for _ in 0..count {
                    let (values, out) = (black_box(&values), black_box(&mut out[..]));
                    match transform {
                        "inverse_abel" => tables.inverse_abel(values, out, &mut buffer),
                        "abel" => tables.abel(values, out, &mut buffer),
                        "pressure" => tables.pressure(values, out, &mut buffer),
                        _ => drop(black_box(Abel::new(&x))),
                    }
                }
                let time = start.elapsed();
                times.push(time.as_secs_f64() / count as f64);
                time
            });
        });
        // a filter on the command line may leave it out
        if !times.is_empty() {
            figures.push((transform, cells, times.iter().copied().fold(f64::INFINITY, f64::min)));
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
    for points in [400, 1000, 5000] {
        let given = measured(points);
        let mut group = criterion.benchmark_group("table");
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
    for transform in TRANSFORMS {
        println!("\n{transform}\n{:>8} {:>12}", "cells", "µs");
        let series: Vec<(usize, f64)> =
            figures.iter().filter(|f| f.0 == transform).map(|f| (f.1, f.2)).collect();
        series.iter().for_each(|(cells, time)| println!("{cells:>8} {:>12.2}", time * 1e6));
        let large: Vec<_> = series.into_iter().filter(|p| p.0 >= 128).collect();
        if large.len() > 1 {
            println!("exponent of growth from 128 cells on: {:.2}", exponent(&large));
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
    for cells in [32, 64, 96, 128, 192, 256, 384, 512] {
        measure(&mut criterion, &mut figures, cells);
    }
    table(&mut criterion);
    report(&figures);
    criterion.final_summary();
}
