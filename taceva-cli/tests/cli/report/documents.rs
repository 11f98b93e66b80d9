//! Documents name existing commands and files.

use std::fs;

use super::json;
use crate::support::Bench;

/// Scene of two sensors with every part of the protocol, a few presses each.
const TWO: &str = r#"scene_version = 1
name = "two"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "16x16" } }
protocol = { calibration = { points = 90, indentations = 2 }, spatial = { points = 12 }, gratings = { step_mm = 0.75, presses = 2 }, lighting = { points = 3 }, repeatability = { points = 3, trials = 3, depth_step_mm = 0.5 }, hysteresis = { points = 3, depth_step_mm = 0.25 }, surface = { points = 8 }, idle = { frames = 6 } }
[[study]]
name = "dome"
sensor = { driver = "sim/vitactip:reduction=16", units = ["0", "1"] }
[[study]]
name = "grid"
sensor = { driver = "sim/magictac:reduction=16", units = ["0", "1"] }
"#;

/// Commands and files of the tables of docs/figures.md.
fn documented() -> Vec<(String, String)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/figures.md");
    let text = fs::read_to_string(path).expect("the page is there");
    let rows = text
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains("| `taceva "));
    rows.map(|line| {
        let words: Vec<&str> = line.split('`').collect();
        let [.., command, _, file, _] = words.as_slice() else {
            panic!("{line}");
        };
        ((*command).to_owned(), (*file).to_owned())
    })
    .collect()
}

#[test]
fn every_figure_and_table_of_the_study_is_made_by_its_command() {
    let bench = Bench::new();
    bench.write("two.toml", TWO);
    bench.ok("run two.toml --out study -q");
    let documented = documented();
    assert!(documented.len() >= 24, "{}", documented.len());
    let mut done: Vec<&str> = vec!["taceva run --out study"];
    for (command, file) in &documented {
        if !done.contains(&command.as_str()) {
            let words = command.strip_prefix("taceva ").expect("our command");
            bench.ok(&format!("{words} -q"));
            done.push(command);
        }
        let text =
            fs::read_to_string(bench.path(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(text.len() > 300, "{file}");
        if file.starts_with("study/") && !file.ends_with("scores.csv") {
            let says_so = text.contains("simulated");
            assert!(
                says_so || file.starts_with("study/figures/"),
                "{file} says that nothing was measured"
            );
        }
    }
    crate::schema::check(
        "run",
        &json(&fs::read_to_string(bench.path("study/results.json")).expect("there")),
    );
}

#[test]
fn both_readmes_name_every_command() {
    let help = Bench::new().ok("--help");
    let (_, commands) = help.split_once("Commands:\n").expect("a list");
    let (commands, _) = commands.split_once("\n\n").expect("its end");
    let names = commands.lines().filter(|line| !line.starts_with("   "));
    let names: Vec<&str> = names
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.len() > 15, "{names:?}");
    for file in ["README.md", "../README.md"] {
        let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(path).expect("the page is there");
        for name in names.iter().filter(|name| **name != "help") {
            let is_named =
                text.contains(&format!("`taceva {name}")) || text.contains(&format!("`{name}`"));
            assert!(is_named, "{file}: {name}");
        }
    }
}
