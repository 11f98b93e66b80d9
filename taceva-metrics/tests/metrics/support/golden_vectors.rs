//! Reads golden vectors of scores by place, scene and grating, and evaluates the samples in different orders and parts.
//!
//! An unknown entry causes a panic, because a skipped case proves nothing. `TACEVA_GOLDEN` names a folder with another `structured.json` of
//! the same schema.

use std::path::PathBuf;

use serde_json::Value;
use taceva_core::random::SplitMix64;
use taceva_core::{Sample, SampleSink};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, State};

/// Section called `name`. Its keys must be among `known`.
pub(crate) fn section(name: &str, known: &[&str]) -> Value {
    let folder = std::env::var_os("TACEVA_GOLDEN").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden")),
        PathBuf::from,
    );
    let file = folder.join("structured.json");
    let text = std::fs::read_to_string(&file)
        .unwrap_or_else(|error| panic!("cannot read {}: {error}", file.display()));
    let golden: Value = serde_json::from_str(&text).expect("golden files are JSON");
    assert_eq!(golden["schema"], "taceva-golden-structured/1");
    let section = golden[name].clone();
    assert!(!section.is_null(), "there is no section `{name}`");
    if section.is_object() {
        check_keys(&section, known);
    }
    section
}

/// Rejects a key that the reader does not know.
pub(crate) fn check_keys(object: &Value, known: &[&str]) {
    let keys = object.as_object().expect("an object").keys();
    let unknown: Vec<&String> = keys.filter(|key| !known.contains(&key.as_str())).collect();
    assert!(
        unknown.is_empty(),
        "keys that this reader does not know: {unknown:?}"
    );
}

/// Converts an unsigned whole number.
pub(crate) fn whole(value: &Value) -> u64 {
    value
        .as_u64()
        .unwrap_or_else(|| panic!("{value} is not a count"))
}

/// Converts a signed whole number.
pub(crate) fn signed(value: &Value) -> i64 {
    value
        .as_i64()
        .unwrap_or_else(|| panic!("{value} is not a whole number"))
}

/// Converts a binary64 number in decimal form.
pub(crate) fn real(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Converts a text.
pub(crate) fn text(value: &Value) -> &str {
    value
        .as_str()
        .unwrap_or_else(|| panic!("{value} is not text"))
}

/// Converts a binary64 number given by its bits: `"0x3ff…"`, or an object with this text in `bits` or `rn`.
pub(crate) fn exact(value: &Value) -> f64 {
    let digits = value
        .as_str()
        .or(value["bits"].as_str())
        .or(value["rn"].as_str());
    let digits = digits.and_then(|digits| digits.strip_prefix("0x"));
    let digits = digits.unwrap_or_else(|| panic!("{value} has no bits"));
    f64::from_bits(u64::from_str_radix(digits, 16).expect("64 bits"))
}

/// Generator of the recipes.
pub(crate) struct Random(SplitMix64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(SplitMix64::new(seed))
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// `next() % bound`.
    pub(crate) fn below(&mut self, bound: i64) -> i64 {
        let bound = u64::try_from(bound).expect("a positive bound");
        i64::try_from(self.next() % bound).expect("below an i64")
    }

    /// Index into a list of `length`.
    fn index(&mut self, length: usize) -> usize {
        usize::try_from(self.next() % length as u64).expect("below a usize")
    }

    /// `u()` of the recipes: uniform, 0 ≤ u < 1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// `g()` of the recipes: approximately normal.
    pub(crate) fn bell(&mut self) -> f64 {
        (1..12).fold(self.unit(), |sum, _| sum + self.unit()) - 6.0
    }
}

/// Scores of `samples`: in order, backwards, and from shuffled random parts whose states are written as JSON and merged.
pub(crate) fn in_every_way(
    plan: &MetricPlan,
    samples: &[Sample],
) -> Vec<(&'static str, Evaluation)> {
    let taken = |samples: &mut dyn Iterator<Item = &Sample>| {
        let mut evaluator = Evaluator::new(plan);
        samples.for_each(|sample| evaluator.accept(sample).expect("the plan's channels"));
        evaluator
    };
    let finish = |evaluator: Evaluator| evaluator.finish().expect("the plan's channels");
    let mut random = Random::new(samples.len() as u64);
    let mut parts: Vec<Vec<&Sample>> = vec![Vec::new(); 7];
    for sample in samples {
        let part = random.index(parts.len());
        let place = random.index(parts[part].len() + 1);
        parts[part].insert(place, sample);
    }
    let mut merged = Evaluator::new(plan);
    for part in &parts {
        let states = taken(&mut part.iter().copied())
            .states()
            .expect("the plan's channels");
        let written = serde_json::to_string(&states).expect("a state");
        let read: Vec<State> = serde_json::from_str(&written).expect("its own text");
        assert_eq!(read, states);
        merged.merge_states(&read).expect("one plan");
    }
    vec![
        ("in order", finish(taken(&mut samples.iter()))),
        ("backwards", finish(taken(&mut samples.iter().rev()))),
        ("shuffled and merged", finish(merged)),
    ]
}

/// Counts comparisons and reports values that differ.
#[derive(Default)]
pub(crate) struct Comparison {
    compared: usize,
}

impl Comparison {
    /// Asserts that both numbers have the same bits.
    pub(crate) fn bits(&mut self, what: &str, found: Option<f64>, expected: f64) {
        let found = found.unwrap_or_else(|| panic!("{what}: no number, expected {expected:e}"));
        assert_eq!(
            found.to_bits(),
            expected.to_bits(),
            "{what}: {found:e}, expected {expected:e}"
        );
        self.compared += 1;
    }

    /// Asserts that both counts are equal.
    pub(crate) fn count(&mut self, what: &str, found: Option<u64>, expected: u64) {
        assert_eq!(found, Some(expected), "{what}");
        self.compared += 1;
    }

    /// Returns the number of compared values, which must not be zero.
    pub(crate) fn done(self) -> usize {
        assert!(self.compared > 0, "nothing was compared");
        self.compared
    }
}

/// Runs the other tests of `module` in a separate process for each instruction set, because a process selects its instruction set only once.
pub(crate) fn again_on_every_instruction_set(module: &str) {
    let program = std::env::current_exe().expect("this program");
    for isa in taceva_metrics::Isa::available() {
        let run = std::process::Command::new(&program)
            .args([module, "--nocapture", "--skip", "on_every_instruction_set"])
            .env("TACEVA_ISA", isa.name())
            .output()
            .expect("this program starts");
        let printed = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{isa}: {printed}");
        assert!(printed.contains("compared"), "{isa}: {printed}");
    }
}
