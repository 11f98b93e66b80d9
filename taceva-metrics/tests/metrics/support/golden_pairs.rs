//! Reads golden cases: fixed inputs, runs of fixed inputs, and recipes of a seeded generator.
//!
//! An unknown entry causes a panic, because a skipped case proves nothing.

use serde_json::{Map, Value};
use taceva_metrics::bench::{Kind, Order};

/// Inputs of a case in the order of the file, and the expected results.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) truth: Vec<f64>,
    pub(crate) prediction: Vec<f64>,
    pub(crate) expected: Expected,
}

/// Expected results of a case.
pub(crate) struct Expected {
    pub(crate) n: u64,
    /// Name and bits of each score; `None` for a missing value.
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
    let parameters = case["p"].as_object().expect("parameters");
    let real = |key: &str| parameters[key].as_f64().expect("a number");
    let whole = |key: &str| {
        let whole = parameters[key].as_i64().expect("a whole number");
        i32::try_from(whole).expect("a small number")
    };
    #[expect(
        clippy::cast_possible_truncation,
        reason = "whole numbers of thousandths"
    )]
    let thousandths = |key: &str| real(key) as i32;
    let count = |key: &str| case[key].as_u64().expect("a count");
    let (low, high, noise) = ("a", "b", "s");
    let kind = match text(&case["kind"]).as_str() {
        "lab" => Kind::Lab {
            low: real(low),
            high: real(high),
            noise: real(noise),
        },
        "offset" => Kind::Offset {
            offset: real("off"),
            low: real(low),
            high: real(high),
            noise: real(noise),
        },
        "wide" => Kind::Wide {
            low: whole("lo"),
            high: whole("hi"),
        },
        "wide_near" => Kind::WideNear {
            low: whole("lo"),
            high: whole("hi"),
            noise: real(noise),
        },
        "cancel" => Kind::Cancelling {
            low: whole("lo"),
            high: whole("hi"),
            noise: real(noise),
        },
        "denorm" => Kind::Denormal,
        "const" => Kind::Constant {
            value: real("a"),
            noise: real(noise),
        },
        "const_eq" => Kind::Met { value: real("a") },
        "f32" => Kind::Single {
            low: real(low),
            high: real(high),
            noise: real(noise),
        },
        "decimal3" => Kind::Thousandths {
            low: thousandths(low),
            high: thousandths(high),
            noise: real(noise),
        },
        "smallerr" => Kind::SmallErrors {
            low: real(low),
            high: real(high),
            least: whole("lo"),
            greatest: whole("hi"),
        },
        other => panic!("kind `{other}` is not known to this reader"),
    };
    let order = match text(&case["order"]).as_str() {
        "none" => Order::AsMade,
        "reverse" => Order::Reversed,
        "sort" => Order::Sorted,
        "shuffle" => Order::Shuffled(count("seed2")),
        other => panic!("order `{other}` is not known to this reader"),
    };
    let recipe = taceva_metrics::bench::Case {
        kind,
        rows: usize::try_from(count("n")).expect("a count"),
        seed: count("seed"),
        order,
    };
    let columns = recipe.columns();
    (columns.reference, columns.estimate)
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
