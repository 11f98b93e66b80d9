//! Reads golden cases: fixed inputs, runs of fixed inputs, and recipes of a seeded generator.
//!
//! Whatever is not understood is a panic, because a case that is skipped proves nothing.

use serde_json::{Map, Value};

/// A case's inputs in its own order, and what must come of them.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) truth: Vec<f64>,
    pub(crate) prediction: Vec<f64>,
    pub(crate) expected: Expected,
}

/// What must come of a case.
pub(crate) struct Expected {
    pub(crate) n: u64,
    /// Name and bits, or none where there is no value.
    pub(crate) canonical: Vec<(String, Option<f64>)>,
    /// Metric and status.
    pub(crate) status: Vec<(String, String)>,
}

/// All cases of a file of golden pairs.
pub(crate) fn read_cases(text: &str) -> Vec<Case> {
    let file: Value = serde_json::from_str(text).expect("golden files are JSON");
    assert_eq!(file["schema"], "taceva-golden-pairs/1");
    assert_eq!(bits(&file["eps_bits"]), taceva_metrics::EPSILON.to_bits());
    let cases = file["cases"].as_array().expect("a list of cases");
    cases.iter().map(read_case).collect()
}

fn read_case(case: &Value) -> Case {
    let case = case.as_object().expect("a case is an object");
    let name = text(&case["name"]);
    let known = [
        "name",
        "y",
        "yhat",
        "y_runs",
        "yhat_runs",
        "kind",
        "n",
        "seed",
        "seed2",
        "p",
        "order",
        "fnv",
        "first",
        "last",
        "expected",
    ];
    let unknown = case.keys().find(|key| !known.contains(&key.as_str()));
    assert_eq!(
        unknown, None,
        "{name}: a key that this reader does not know"
    );
    let (truth, prediction) = if case.contains_key("kind") {
        generate(case)
    } else if case.contains_key("y_runs") {
        (runs(&case["y_runs"]), runs(&case["yhat_runs"]))
    } else {
        (values(&case["y"]), values(&case["yhat"]))
    };
    if !case["fnv"].is_null() {
        let columns = truth.iter().chain(&prediction);
        let hash = columns
            .flat_map(|value| value.to_le_bytes())
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
            });
        assert_eq!(
            hash,
            bits(&case["fnv"]),
            "{name}: the inputs were not remade"
        );
    }
    for (key, row) in [("first", 0), ("last", truth.len().saturating_sub(1))] {
        if let Some(pair) = case.get(key) {
            let found = [truth[row], prediction[row]].map(f64::to_bits);
            assert_eq!(found, [bits(&pair[0]), bits(&pair[1])], "{name}: {key} row");
        }
    }
    Case {
        expected: read_expected(&case["expected"], &name),
        name,
        truth,
        prediction,
    }
}

fn read_expected(expected: &Value, name: &str) -> Expected {
    let expected = expected.as_object().expect("what is expected");
    let known = ["n", "canonical", "canonical_dec", "truth", "status"];
    let unknown = expected.keys().find(|key| !known.contains(&key.as_str()));
    assert_eq!(
        unknown, None,
        "{name}: a key that this reader does not know"
    );
    let entries = |key: &str| {
        let entries = expected.get(key).and_then(Value::as_object);
        entries.cloned().unwrap_or_default().into_iter()
    };
    let number = |value: &Value| (!value.is_null()).then(|| f64::from_bits(bits(value)));
    Expected {
        n: expected["n"].as_u64().expect("a count"),
        canonical: entries("canonical")
            .map(|(key, value)| (key, number(&value)))
            .collect(),
        status: entries("status")
            .map(|(key, value)| (key, text(&value)))
            .collect(),
    }
}

fn generate(case: &Map<String, Value>) -> (Vec<f64>, Vec<f64>) {
    let kind = text(&case["kind"]);
    let parameters = case["p"].as_object().expect("parameters");
    let real = |key: &str| parameters[key].as_f64().expect("a number");
    let power = |key: &str| parameters[key].as_i64().expect("an exponent");
    let mut random = SplitMix64(case["seed"].as_u64().expect("a seed"));
    let mut pairs: Vec<(f64, f64)> = Vec::new();
    for row in 0..case["n"].as_u64().expect("a count") {
        let truth = match kind.as_str() {
            "lab" | "smallerr" => real("a") + (real("b") - real("a")) * random.unit(),
            "offset" => real("off") + (real("a") + (real("b") - real("a")) * random.unit()),
            "wide" | "wide_near" => random.wide(power("lo"), power("hi")),
            "cancel" if row % 2 == 0 => random.wide(power("lo"), power("hi")),
            "cancel" => -pairs[pairs.len() - 1].0,
            "denorm" => random.denormal(),
            "const" | "const_eq" => real("a"),
            "f32" => narrow(real("a") + (real("b") - real("a")) * random.unit()),
            "decimal3" => {
                #[expect(clippy::cast_possible_truncation, reason = "whole numbers")]
                let (low, high) = (real("a") as i64, real("b") as i64);
                let levels = u64::try_from(high - low + 1).expect("a range");
                let level = i64::try_from(random.next() % levels).expect("a level");
                #[expect(clippy::cast_precision_loss, reason = "thousands")]
                let level = (low + level) as f64;
                level / 1000.0
            }
            other => panic!("kind `{other}` is not known to this reader"),
        };
        let prediction = match kind.as_str() {
            "wide" => random.wide(power("lo"), power("hi")),
            "wide_near" => truth * (1.0 + real("s") * random.bell()),
            "denorm" => random.denormal(),
            "const_eq" => truth,
            "f32" => narrow(truth + real("s") * random.bell()),
            "smallerr" => truth + random.wide(power("lo"), power("hi")),
            _ => truth + real("s") * random.bell(),
        };
        pairs.push((truth, prediction));
    }
    match text(&case["order"]).as_str() {
        "none" => {}
        "reverse" => pairs.reverse(),
        "sort" => pairs.sort_by(|left, right| left.partial_cmp(right).expect("finite")),
        "shuffle" => SplitMix64(case["seed2"].as_u64().expect("a seed")).shuffle(&mut pairs),
        other => panic!("order `{other}` is not known to this reader"),
    }
    pairs.into_iter().unzip()
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the recipe rounds to binary32"
)]
fn narrow(value: f64) -> f64 {
    f64::from(value as f32)
}

/// The generator of the recipes.
pub(crate) struct SplitMix64(pub(crate) u64);

impl SplitMix64 {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number below `bound`.
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() % bound as u64).expect("below a usize")
    }

    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            let other = self.below(last + 1);
            list.swap(last, other);
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    pub(crate) fn bell(&mut self) -> f64 {
        (1..12).fold(self.unit(), |sum, _| sum + self.unit()) - 6.0
    }

    fn wide(&mut self, low: i64, high: i64) -> f64 {
        let word = self.next();
        let span = u64::try_from(high - low + 1).expect("a range");
        let exponent = low + i64::try_from(self.next() % span).expect("an exponent");
        let field = u64::try_from(exponent + 1023).expect("a normal number");
        f64::from_bits((word & 1 << 63) | field << 52 | (word & ((1 << 52) - 1)))
    }

    fn denormal(&mut self) -> f64 {
        let fraction = self.next() & ((1 << 52) - 1);
        f64::from_bits(fraction | (self.next() & 1 << 63))
    }
}

fn runs(runs: &Value) -> Vec<f64> {
    let runs = runs.as_array().expect("a list of runs").iter();
    runs.flat_map(|run| {
        let times = run["times"].as_u64().expect("a count");
        values(&run["values"]).repeat(usize::try_from(times).expect("a count"))
    })
    .collect()
}

fn values(list: &Value) -> Vec<f64> {
    let list = list.as_array().expect("a list of bit patterns").iter();
    list.map(|value| f64::from_bits(bits(value))).collect()
}

fn bits(value: &Value) -> u64 {
    let digits = value.as_str().and_then(|value| value.strip_prefix("0x"));
    u64::from_str_radix(digits.expect("hexadecimal"), 16).expect("64 bits")
}

fn text(value: &Value) -> String {
    value.as_str().expect("a text").to_owned()
}
