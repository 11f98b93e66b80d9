//! Tests of single bit flips in datasets, models, states, results, caches, and folders of runs and sweeps. The output must be unchanged, or an error
//! must name the file.
//!
//! `TACEVA_FLIPS=1000 cargo test --release -p taceva-tests --test tests flips:: -- --nocapture` sets the total number of flips.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_tests::{Form, Lab, Random, scratch, taceva};

const SEED: u64 = 20_261_124;
/// Default total number of flips, over all kinds of files.
const FLIPS: usize = 120;

/// Runs the program with `words` in `folder`.
fn taceva_in(folder: &Path, words: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(taceva());
    command
        .current_dir(folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .env_remove("TACEVA_PLUGIN_PATH")
        .args(words.split_whitespace())
        .arg("-q");
    let output = command.output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

fn ok(folder: &Path, words: &str) -> String {
    let (code, out, err) = taceva_in(folder, words);
    assert_eq!(code, Some(0), "taceva {words}: {out}{err}");
    out
}

/// A kind of file: its location, and the commands that read it.
struct Kind {
    name: &'static str,
    below: &'static [&'static str],
    commands: &'static [&'static str],
    /// True for a cache: a damaged file may be recreated instead of rejected.
    is_cache: bool,
}

const KINDS: [Kind; 7] = [
    Kind {
        name: "datasets",
        below: &["data"],
        commands: &[
            "evaluate data --with model --part all --no-cache --format json",
            "check data --format json",
        ],
        is_cache: false,
    },
    Kind {
        name: "models",
        below: &["model"],
        commands: &["evaluate data --with model --part all --no-cache --format json"],
        is_cache: false,
    },
    Kind {
        name: "states",
        below: &["a.state"],
        commands: &["merge a.state --format json"],
        is_cache: false,
    },
    Kind {
        name: "results",
        below: &["a.json", "b.json", "a.samples.csv"],
        commands: &["compare a.json b.json --format json"],
        is_cache: false,
    },
    Kind {
        name: "caches",
        below: &["cache"],
        commands: &["evaluate data --with model --part all --format json"],
        is_cache: true,
    },
    Kind {
        name: "folders of runs",
        below: &["run"],
        commands: &[
            "compare run a.json --format json",
            "run drawn.toml --out run --resume --format json",
        ],
        is_cache: false,
    },
    Kind {
        name: "folders of sweeps",
        below: &["which.sweep"],
        commands: &["sweep which.toml", "sweep show which.toml --by model"],
        is_cache: false,
    },
];

/// Scene that evaluates the recording `data` in a small run.
const SCENE: &str = "scene_version = 1\nname = \"drawn\"\nsensor = { dataset = \"data\" }\nmodel = { name = \"ridge\" }\n";
/// Sweep with two tasks: two models on the recording `data`.
const SWEEP: &str = "sweep_version = 1\ndatasets = [\"data\"]\nmodels = [\"ridge\", \"baseline\"]\nmetrics = [\"accuracy\"]\n";

fn prepare(folder: &Path) {
    let lab = Lab::drawn(Form::Png, 40);
    ok(
        folder,
        &format!(
            "import {} --map {} --out data",
            lab.path().display(),
            lab.map().display()
        ),
    );
    ok(folder, "fit data --model ridge --out model");
    ok(
        folder,
        "evaluate data --with model --part all --format json --out a.json --samples-out a.samples.csv --state-out a.state",
    );
    ok(
        folder,
        "evaluate data --model baseline --part all --format json --out b.json --samples-out b.samples.csv",
    );
    std::fs::write(folder.join("drawn.toml"), SCENE).expect("written");
    ok(folder, "run drawn.toml --out run");
    std::fs::write(folder.join("which.toml"), SWEEP).expect("written");
    ok(folder, "sweep which.toml");
}

/// Every file of a kind, in order.
fn files_below(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let mut entries: Vec<PathBuf> = path
        .read_dir()
        .map(|entries| entries.flatten().map(|entry| entry.path()).collect())
        .unwrap_or_default();
    entries.sort();
    entries
        .iter()
        .flat_map(|entry| files_below(entry))
        .collect()
}

/// Exit code and output of every command.
fn said(folder: &Path, commands: &[&str]) -> Vec<(Option<i32>, String, String)> {
    commands
        .iter()
        .map(|words| taceva_in(folder, words))
        .collect()
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn no_flipped_bit_changes_a_number_or_a_claim_without_a_word() {
    let wanted = std::env::var("TACEVA_FLIPS").ok();
    let wanted = wanted.and_then(|text| text.parse().ok()).unwrap_or(FLIPS);
    let folder = scratch();
    let folder = folder.path();
    prepare(folder);
    let mut random = Random::new(SEED);
    let mut silent = Vec::new();
    for kind in &KINDS {
        let files: Vec<PathBuf> = kind
            .below
            .iter()
            .flat_map(|name| files_below(&folder.join(name)))
            .collect();
        assert!(!files.is_empty(), "{}: nothing to damage", kind.name);
        let expected = said(folder, kind.commands);
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for number in 0..wanted.div_ceil(KINDS.len()) {
            let path = &files[random.below(files.len())];
            let whole = std::fs::read(path).expect("a file");
            if whole.is_empty() {
                continue;
            }
            let (at, bit) = (random.below(whole.len()), random.below(8));
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            // Cache files share their content through links: damage only this name.
            std::fs::remove_file(path).expect("there");
            std::fs::write(path, &bytes).expect("written");
            let found = said(folder, kind.commands);
            let mut outcome = "the same";
            for ((code, out, err), (_, expected, _)) in found.iter().zip(&expected) {
                if *code == Some(3) || (*code == Some(2) && !err.is_empty()) {
                    outcome = "refused";
                } else if out != expected {
                    silent.push(format!(
                        "seed {SEED}, {} {number}: byte {at} bit {bit} of {}: exit code {code:?} {err}",
                        kind.name,
                        path.display()
                    ));
                    outcome = "SILENT";
                }
            }
            *counts.entry(outcome).or_default() += 1;
            if kind.is_cache {
                // The damaged file was recreated or is not needed.
                drop(std::fs::remove_file(path));
            }
            std::fs::write(path, &whole).expect("written");
        }
        eprintln!("{}: {counts:?}", kind.name);
    }
    assert!(silent.is_empty(), "{} silent: {silent:#?}", silent.len());
}
