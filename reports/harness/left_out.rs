//! Counts the work of features that a scene does not use, and writes `reports/left_out.md` and
//! `.csv`.
//!
//! `cargo run --release --no-default-features --example left_out [-- folder]`

#[path = "../../tests/fmi/counting.rs"]
mod counting;
mod economy;
mod machine;

use economy::{ALL, Measured, STEPS, Scene, Work};
use std::fmt::Write as _;
use std::path::PathBuf;

#[global_allocator]
static ALLOCATOR: counting::Counting = counting::Counting;

/// Runs for a median.
const REPEATS: usize = 15;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "reports".into()));
    std::fs::create_dir_all(&folder)?;
    let mut lines = Vec::new();
    for scene in economy::scenes()? {
        let measured = scene.measure(REPEATS)?;
        println!("{}", row(&scene, &measured));
        lines.push((scene, measured));
    }
    std::fs::write(folder.join("left_out.csv"), csv(&lines))?;
    std::fs::write(folder.join("left_out.md"), page(&lines))?;
    Ok(())
}

/// Counts of work that had to be left out and was not.
fn paid(scene: &Scene, measured: &Measured) -> Vec<Work> {
    scene.leaves_out.iter().copied().filter(|work| measured.of(*work) > 0).collect()
}

fn row(scene: &Scene, measured: &Measured) -> String {
    let counts = ALL.map(|(work, _)| {
        let count = measured.of(work);
        match (count, scene.leaves_out.contains(&work)) {
            (0, true) => "–".into(),
            (_, true) => format!("**{count}**"),
            (_, false) => count.to_string(),
        }
    });
    let [median, least, most] = measured.time;
    let kib = measured.bytes as f64 / 1024.0;
    format!("| {} | {} | {kib:.1} | {median:.0} ({least:.0} to {most:.0}) |", scene.name, counts.join(" | "))
}

fn csv(lines: &[(Scene, Measured)]) -> String {
    let names = ALL.map(|(_, name)| name.replace(' ', "_")).join(",");
    let mut text = format!("scene,{names},bytes,ns_per_step,ns_least,ns_most\n");
    for (scene, measured) in lines {
        let counts = measured.counted.map(|count| count.to_string()).join(",");
        let [median, least, most] = measured.time;
        let Measured { bytes, .. } = measured;
        let _ = writeln!(text, "\"{}\",{counts},{bytes},{median:.1},{least:.1},{most:.1}", scene.name);
    }
    text
}

fn page(lines: &[(Scene, Measured)]) -> String {
    let all: usize = lines.iter().map(|(scene, _)| scene.leaves_out.len()).sum();
    let broken: usize = lines.iter().map(|(scene, measured)| paid(scene, measured).len()).sum();
    let time = |name: &str| {
        lines.iter().find(|(scene, _)| scene.name == name).map_or(f64::NAN, |(_, measured)| measured.time[0])
    };
    let stick = time("full stick");
    let mut text = format!(
        "# Cost of features that are not used\n\n**Features that are not used cost nothing**: of {all} kinds of work that these {} \
         scenes do not need, {} are not done at all{}. A step in partial slip takes {:.1} times a step in full stick, {:.1} times with wear too slow \
         for the profile to follow, {:.1} times where the load varies, and {:.0} times where the pressure is read at 64 radii.\n\n",
        lines.len(),
        all - broken,
        if broken == 0 { String::new() } else { format!("; {broken} are not, in bold") },
        time("partial slip") / stick,
        time("partial slip, slow wear") / stick,
        time("load varies") / stick,
        time("partial slip, pressure read") / stick,
    );
    let _ = writeln!(
        text,
        "Counted over {STEPS} steps, 25 cycles, after 50 cycles. A dash: none, as it has to be. Memory is that of the contact at the end, \
         without that of the table of a profile, which clones share. Time is the median of {REPEATS} runs, with the least and the most. \
         Slow wear: N₀ = 1e9 cycles; fast: 1e3. The same is asserted by `cargo test --test reports left_out`, without the times.\n"
    );
    let names = ALL.map(|(_, name)| name).join(" | ");
    let _ =
        writeln!(text, "| scene | {names} | memory, KiB | step, ns |\n|{}", " --- |".repeat(ALL.len() + 3));
    for (scene, measured) in lines {
        text += &row(scene, measured);
        text.push('\n');
    }
    let _ = writeln!(text, "\n{}", machine::provenance());
    text
}
