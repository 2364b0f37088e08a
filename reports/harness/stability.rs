//! Runs the stiff and extreme scenes, judges each, and writes `reports/stability.md` and `.csv`.
//!
//! `cargo run --release --no-default-features --example stability [-- folder]`
//!
//! `… -- --only "shape, flat punch"` runs the scenes whose name holds that text, here, and prints
//! every invariant.

mod coupling;
mod judge;
mod machine;
mod scenes;

use judge::{Finding, Judge};
use scenes::Scene;
use std::fmt::Write as _;
use std::io::Read as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A scene that takes longer is given up.
const LIMIT: Duration = Duration::from_secs(10);
/// One that takes longer is named.
const SLOW: Duration = Duration::from_secs(5);

/// First argument of the process of one scene.
const ONE: &str = "--scene";
/// First argument for running some scenes by name.
const ONLY: &str = "--only";

/// What the scenes have found: where it was seen, its cause, and what became of it.
const CORRECTED: [(&str, &str, &str); 16] = [
    (
        "fast wear, N0 = 5 and 1",
        "an unsteady update was accepted after eight iterations whatever its residual: needles at the contact edge, and a call for a cycle that wore nothing",
        "made in parts, halved until each is solved; refused where none is",
    ),
    (
        "amplitude that shrinks from gross slip",
        "a mesh was laid over a worn body only where the edge fitted to 3e-4 of the annulus, else on top of it, along the old edge: V 6 % off against an explicit row of springs",
        "laid with an edge known to a cell, its depths raised to the volume",
    ),
    (
        "the same, thin annuli",
        "the depths were scaled where their image is below 0, which took volume away instead of adding it",
        "what is missing is carried to the next wear",
    ),
    (
        "most scenes with varying loads",
        "thinned and inserted nodes changed the volume of the profile",
        "what they change is booked, and placed with the next wear",
    ),
    ("one step wears more than d0", "an update that could place nothing lost its wear silently", "refused"),
    (
        "E = 1e300 Pa",
        "the room for wear, a² d, is below the least double, and no limit was taken from that",
        "any wear is too much for it: refused",
    ),
    (
        "table rough by 0.1",
        "waves of a few points were looked for at a thousandth of the contact radius: not seen, and run for 10 s",
        "the next point of the table tells: refused at the first press",
    ),
    (
        "amplitude u_max (1 + 1e-12), depth held",
        "the mesh tells depths by lines of h/x, the nodes by lines of h: with a front next to the axis they differ by 0.7 %",
        "the depths are computed again when the mesh is left",
    ),
    (
        "amplitude exactly u_max, depth held",
        "where slip just reaches the axis a needle stays there, for which the cells of a disc left out a whole cell: V of a life up to 26 % low, \
         though it was that of the springs",
        "taken for partial slip with a front next to the axis: within 2.2e-4 of the closed volume",
    ),
    (
        "cycles on a worn flat punch",
        "a mesh laid over it lost the wear at the rim, up to 40 % of all, and its nodes changed the volume of the steep rest",
        "the rim keeps its depth, outside the mesh depths stay lines between the old nodes",
    ),
    (
        "to anywhere within 3 u_max under random loads, flat punch",
        "each cell of the fan at the rim left the contact on its own and was a sharp rim for a while: an update lost its load, and up to a fifth \
         of the steps were refused",
        "the fan goes once the wear has taken the load of the rim, whose depth keeps the volume",
    ),
    (
        "circle, 0.6 u_max, wear",
        "one cell flattened the steep image behind a front that creeps: V of an orbit of 0.3 u_max 3 % low, whatever the tolerance",
        "a fan of nodes goes along: within 0.4 % at 64 cells",
    ),
    (
        "cycles on a punch after a varying load",
        "a mesh whose cells do not follow the steep body at the contact edge carried a tenth of the volume that the springs wore",
        "it has to carry that volume to 5 %, else the motion is worn off in implicit updates",
    ),
    (
        "fast wear, N0 = 5",
        "1 % of the volume could be without a place before a step was refused, and cycles were not asked",
        "the tolerance, at least 1e-3, for both",
    ),
    ("tolerance 1e-6", "depths of merged nodes were summed one by one, O(n²)", "one transform, O(n)"),
    (
        "refusals",
        "the message named a piece of the step, or a slide as cycles of infinite amplitude",
        "it names the step that was asked for",
    ),
];

enum Outcome {
    Passed,
    Refused(String),
    Failed(String),
}

struct Line {
    name: String,
    extreme: String,
    outcome: Outcome,
    judged: Judged,
    time: Duration,
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [one, index] = arguments.as_slice()
        && one == ONE
    {
        run_here(index.parse().map_err(std::io::Error::other)?);
        return Ok(());
    }
    if let [only, text] = arguments.as_slice()
        && only == ONLY
    {
        scenes::all().iter().filter(|scene| scene.title().contains(text)).for_each(explain);
        return Ok(());
    }
    let folder = PathBuf::from(arguments.first().map_or("reports", String::as_str));
    std::fs::create_dir_all(&folder)?;
    let mut lines = Vec::new();
    let scenes = scenes::all();
    for (index, scene) in scenes.iter().enumerate() {
        let line = run(index, scene)?;
        println!("{}/{} {}", index + 1, scenes.len(), row(&line));
        lines.push(line);
    }
    std::fs::write(folder.join("stability.csv"), csv(&lines))?;
    let coupling = coupling::Coupling::run().map_err(std::io::Error::other)?;
    std::fs::write(folder.join("coupling.csv"), coupling.csv())?;
    std::fs::write(folder.join("stability.md"), page(&lines, &coupling))?;
    println!("{}", answer(&lines));
    Ok(())
}

/// In a process of its own, so that one that never ends or overflows its stack is a line like any
/// other.
fn run(index: usize, scene: &Scene) -> std::io::Result<Line> {
    let start = Instant::now();
    let mut child = Command::new(std::env::current_exe()?)
        .args([ONE, &index.to_string()])
        .stdout(Stdio::piped())
        .spawn()?;
    let status = loop {
        match child.try_wait()? {
            None if start.elapsed() > LIMIT => {
                child.kill()?;
                child.wait()?;
                break None;
            }
            None => std::thread::sleep(Duration::from_millis(2)),
            status => break status,
        }
    };
    let time = start.elapsed();
    let mut said = String::new();
    if let Some(mut output) = child.stdout.take() {
        output.read_to_string(&mut said)?;
    }
    let (name, extreme) = (scene.name.clone(), scene.extreme.clone());
    let (outcome, judged) = match (status, said.split_once('\n')) {
        (None, _) => (Outcome::Failed(format!("not done after {} s", LIMIT.as_secs())), Judged::default()),
        (Some(status), Some((judged, message))) if status.success() => {
            let judged = Judged::read(judged);
            let refused = message.trim_end();
            let outcome = match (judged.broken, refused) {
                (true, "") => Outcome::Failed(judged.worst.clone()),
                (true, _) => Outcome::Failed(format!("{}; then refused: {refused}", judged.worst)),
                (false, "") => Outcome::Passed,
                (false, _) => Outcome::Refused(refused.into()),
            };
            (outcome, judged)
        }
        (Some(status), _) => (Outcome::Failed(format!("panic or abort, {status}")), Judged::default()),
    };
    Ok(Line { name, extreme, outcome, judged, time })
}

/// Runs a scene and prints what came of each invariant.
fn explain(scene: &Scene) {
    let mut judge = Judge::default();
    let start = Instant::now();
    let outcome = (scene.run)(&mut judge);
    println!(
        "{}: {} states, {:.2} s, {outcome:?}",
        scene.title(),
        judge.states,
        start.elapsed().as_secs_f64()
    );
    for finding in judge.findings() {
        let Finding { invariant, seen, allowed } = finding;
        println!(
            "  {} {invariant}: {seen:.2e} of {allowed:.2e}",
            if finding.broken() { "BROKEN" } else { "kept" }
        );
    }
}

/// What the process of a scene does: one line of judgement, then the refusal, if any.
fn run_here(index: usize) {
    let Some(scene) = scenes::all().into_iter().nth(index) else { return };
    let mut judge = Judge::default();
    let outcome = (scene.run)(&mut judge);
    if let Some(worst) = judge.worst() {
        let Finding { invariant, seen, allowed } = worst;
        let (broken, share) = (worst.broken(), worst.share());
        println!("{invariant}\t{seen:e}\t{allowed:e}\t{broken}\t{}\t{share:e}", judge.states);
    } else {
        println!();
    }
    println!("{}", outcome.err().map_or(String::new(), |error| error.to_string()));
}

/// What a process has said.
#[derive(Default)]
struct Judged {
    worst: String,
    seen: String,
    allowed: String,
    broken: bool,
    states: u64,
    /// What was seen in what is allowed.
    share: String,
}

impl Judged {
    fn read(line: &str) -> Self {
        let mut cells = line.split('\t').map(String::from);
        let mut next = || cells.next().unwrap_or_default();
        let (worst, seen, allowed) = (next(), next(), next());
        let (broken, states) = (next() == "true", next().parse().unwrap_or(0));
        Self { worst, seen, allowed, broken, states, share: next() }
    }
}

impl Line {
    fn outcome(&self) -> String {
        match &self.outcome {
            Outcome::Passed => "passed".into(),
            Outcome::Refused(message) => format!("refused: {message}"),
            Outcome::Failed(what) => format!("**FAILED**: {what}"),
        }
    }

    fn worst(&self) -> String {
        let Judged { worst, seen, allowed, .. } = &self.judged;
        if worst.is_empty() { "-".into() } else { format!("{worst}: {} of {allowed}", rounded(seen)) }
    }
}

/// Two digits of a number in scientific form.
fn rounded(number: &str) -> String {
    number.parse::<f64>().map_or_else(|_| number.into(), |x| format!("{x:.1e}"))
}

fn row(line: &Line) -> String {
    let time = format!("{:.2} s", line.time.as_secs_f64());
    let slow = if line.time > SLOW { " (slow)" } else { "" };
    // a bar would end the cell
    let cells =
        [&line.name, &line.extreme, &line.outcome(), &line.worst()].map(|cell| cell.replace('|', "\\|"));
    format!("| {} | {} | {time}{slow} |", cells.join(" | "), line.judged.states)
}

fn csv(lines: &[Line]) -> String {
    let mut text =
        String::from("scene,extreme,outcome,message,invariant,seen,allowed,share,states,seconds\n");
    for line in lines {
        let quoted = |cell: &str| format!("\"{}\"", cell.replace('"', "\"\""));
        let Judged { worst, seen, allowed, states, share, .. } = &line.judged;
        let (outcome, message) = match &line.outcome {
            Outcome::Passed => ("passed", ""),
            Outcome::Refused(message) => ("refused", message.as_str()),
            Outcome::Failed(what) => ("failed", what.as_str()),
        };
        let cells = [&line.name, &line.extreme, outcome, message, worst].map(quoted).join(",");
        let share = if share.is_empty() { "nan" } else { share };
        let seconds = line.time.as_secs_f64();
        let _ = writeln!(text, "{cells},{seen},{allowed},{share},{states},{seconds:.3}");
    }
    text
}

fn answer(lines: &[Line]) -> String {
    let count = |wanted: fn(&Outcome) -> bool| lines.iter().filter(|line| wanted(&line.outcome)).count();
    format!(
        "Of {} scenes {} pass, {} are refused with a message and {} fail; {} take longer than {} s.",
        lines.len(),
        count(|o| matches!(o, Outcome::Passed)),
        count(|o| matches!(o, Outcome::Refused(_))),
        count(|o| matches!(o, Outcome::Failed(_))),
        lines.iter().filter(|line| line.time > SLOW).count(),
        SLOW.as_secs()
    )
}

fn page(lines: &[Line], coupling: &coupling::Coupling) -> String {
    let mut text = format!("# Stability of stiff and extreme scenes\n\n{}\n\n", answer(lines));
    let _ = writeln!(
        text,
        "Every state on the way is judged: all numbers finite; |T| ≤ μF_N (to {:.0e}); stick radius ≤ contact radius; \
         work and wear never decrease; volume of the profile = (k/σ₀)·work, to the tolerance times V + πa²d (the tolerance holds \
         for the image in depths d, which over the disc is that volume, and for the volume itself); profile never below the \
         unworn one; a refusal changes nothing. Where a scene splits its way, T (in μF_N) and worn volume have to \
         agree to {} tolerances with wear and to {:.0e} without. *Worst* is the invariant nearest to its bound, or \
         farthest beyond it. A scene is given up after {} s.\n",
        judge::COULOMB,
        judge::SPLIT_IN_TOLERANCES,
        judge::SPLIT_WITHOUT_WEAR,
        LIMIT.as_secs()
    );
    text += "A machine model around the contact: [below](#as-a-part-of-a-stiff-system).\n\n";
    text += "![Each scene at its worst invariant over that bound](stability.png)\n\n\
             Most scenes run the same short life at the extreme named: loops with wear, swings of load, cycles in one \
             call, separation, a slide. All are in `reports/harness/scenes`.\n\n";
    text += "| scene | extreme | outcome | worst | states | time |\n| --- | --- | --- | --- | --- | --- |\n";
    // what went wrong first
    let rank = |line: &&Line| match line.outcome {
        Outcome::Failed(_) => 0,
        Outcome::Refused(_) => 1,
        Outcome::Passed => 2,
    };
    let mut sorted: Vec<&Line> = lines.iter().collect();
    sorted.sort_by_key(rank);
    for line in sorted {
        text += &row(line);
        text.push('\n');
    }
    text += "\n## What has been corrected\n\n| seen in | cause | now |\n| --- | --- | --- |\n";
    for (seen, cause, now) in CORRECTED {
        let _ = writeln!(text, "| {seen} | {cause} | {now} |");
    }
    let _ = writeln!(text, "\n{}{}", coupling.section(), machine::provenance());
    text
}
