//! Sweep over two synthetic recordings, and the bytes of its tables and page.

use std::fs;

use super::Bench;

/// Sweep over two recordings, four models, three seeds and two sizes.
pub(crate) const SWEEP: &str = r#"
sweep_version = 1
name = "which model, which size"
datasets = ["monday", "tuesday"]
models = ["ridge", "pls", "baseline", { name = "knn", set = { neighbours = 3 } }]
seeds = "1-3"
splits = ["by-point 50/10/40"]
metrics = ["accuracy"]
[vary]
size = ["8x8", "12x12"]
"#;
/// Number of tasks of [`SWEEP`].
pub(crate) const TASKS: usize = 48;
/// Files that are compared byte by byte.
const FILES: [&str; 3] = ["table.csv", "table.parquet", "page.html"];

/// Scene of one sensor, pressed at a few places.
pub(crate) const TINY: &str = r#"scene_version = 1
name = "tiny"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
sensor = { driver = "sim/vitactip:reduction=16" }
model = { name = "ridge", set = { size = "8x8" } }
metrics = { want = ["accuracy"] }
protocol = { calibration = { points = 12, indentations = 2 } }
"#;
/// Sweep over the scene [`TINY`]: two tasks.
pub(crate) const TINY_SWEEP: &str = r#"sweep_version = 1
scenes = ["tiny.toml"]
models = ["ridge", "baseline"]
splits = ["by-point 50/10/40"]
metrics = ["accuracy"]
[vary]
size = ["8x8"]
"#;
/// Test folder with two recordings, and the file of a sweep over both, which ends with `more`.
pub(crate) fn week(more: &str) -> Bench {
    let bench = Bench::new();
    for (name, noise) in [("monday", 0), ("tuesday", 1)] {
        bench.record_with_noise(name, 24, noise);
    }
    bench.write("which.toml", &format!("{SWEEP}{more}"));
    bench
}

/// Bytes of the two tables and of the page of the sweep in `folder`.
pub(crate) fn bytes(bench: &Bench, folder: &str) -> Vec<Vec<u8>> {
    let read = |name: &&str| fs::read(bench.path(folder).join(name)).expect(name);
    FILES.iter().map(read).collect()
}

/// Table of truth and table of predictions, CSV, for `rows` presses on a grid. Rows of one contact point are far apart.
pub(crate) fn tables(rows: u32, with_ids: bool) -> [String; 2] {
    let id = |row: u32| match with_ids {
        true => format!("{row},"),
        false => String::new(),
    };
    let head = if with_ids { "id," } else { "" };
    let mut truth = format!("{head}point_id,Px,Py,Pz,Fz\n");
    let mut prediction = format!("{head}Px,Py,Pz,Fz\n");
    for row in 0..rows {
        let (x, y) = (f64::from(row % 10) - 4.5, f64::from(row / 10 % 10) - 4.5);
        let depth = 0.2 + 0.1 * f64::from(row % 4);
        let force = depth * (1.0 + 0.02 * x);
        truth += &format!("{}p{},{x},{y},{depth},{force}\n", id(row), row % 37);
        let error = 0.01 * f64::from(row * 7919 % 13) - 0.06;
        prediction += &format!(
            "{}{},{},{},{}\n",
            id(row),
            x + error,
            y - error,
            depth + error / 9.0,
            force - error / 7.0
        );
    }
    [truth, prediction]
}
