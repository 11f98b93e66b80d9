//! Tests least squares on the certified data sets of NIST.

use faer::Mat;

use super::double::Double;
use super::{Wide, least_squares};

/// A data set: name, file, highest power of x if the model is a polynomial, and presence of an intercept.
struct Set {
    name: &'static str,
    text: &'static str,
    powers: Option<usize>,
    intercept: bool,
    /// Minimum number of correct digits of every coefficient.
    digits: f64,
}

macro_rules! set {
    ($name:literal, $powers:expr, $intercept:literal, $digits:literal) => {
        Set {
            name: $name,
            text: include_str!(concat!("../../../tests/strd/", $name, ".dat")),
            powers: $powers,
            intercept: $intercept,
            digits: $digits,
        }
    };
}

const SETS: &[Set] = &[
    set!("Norris", Some(1), true, 12.0),
    set!("Pontius", Some(2), true, 12.0),
    set!("NoInt1", Some(1), false, 14.0),
    set!("NoInt2", Some(1), false, 14.0),
    set!("Filip", Some(10), true, 8.0),
    set!("Longley", None, true, 10.0),
    set!("Wampler1", Some(5), true, 9.0),
    set!("Wampler2", Some(5), true, 9.0),
    set!("Wampler3", Some(5), true, 9.0),
    set!("Wampler4", Some(5), true, 9.0),
    set!("Wampler5", Some(5), true, 9.0),
];

/// Data rows of a file, which start at line 61.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().skip(60).map(str::split_whitespace);
    let rows = lines.map(|words| words.map(|word| word.parse().expect("a number")).collect());
    rows.filter(|row: &Vec<f64>| !row.is_empty()).collect()
}

impl Set {
    /// Design matrix, its rounding errors, and targets. The matrix has one row per sample and one column per coefficient. Powers are exact in two
    /// doubles.
    fn design(&self) -> (Mat<f64>, Mat<f64>, Mat<f64>) {
        let rows = rows(self.text);
        let entries: Vec<Vec<Double>> = rows
            .iter()
            .map(|row| {
                let one = Double::new(1.0, 0.0);
                let seen = row[1..].iter().map(|&value| Double::new(value, 0.0));
                let mut entries: Vec<Double> = match self.powers {
                    None => seen.collect(),
                    Some(powers) => {
                        let x = Double::new(row[1], 0.0);
                        let next = |last: &mut Double| {
                            *last = *last * x;
                            Some(*last)
                        };
                        (0..powers).scan(one, |last, _| next(last)).collect()
                    }
                };
                if self.intercept {
                    entries.insert(0, one);
                }
                entries
            })
            .collect();
        let of = |part: fn(&Double) -> f64| {
            Mat::from_fn(rows.len(), entries[0].len(), |row, column| {
                part(&entries[row][column])
            })
        };
        let low = |entry: &Double| (*entry - Double::new(entry.value(), 0.0)).value();
        let targets = Mat::from_fn(rows.len(), 1, |row, _| rows[row][0]);
        (of(Double::value), of(low), targets)
    }

    /// Certified coefficients, rounded from 40 digits.
    fn exact(&self) -> Vec<f64> {
        let lines = include_str!("../../../tests/strd/exact_f64.txt").lines();
        let mut words = lines.map(str::split_whitespace);
        let own = words.find_map(|mut words| (words.next() == Some(self.name)).then_some(words));
        let numbers = own.expect("every set is listed");
        numbers
            .map(|word| word.parse().expect("a number"))
            .collect()
    }
}

/// Number of correct digits of the least accurate coefficient, at most 17.
fn digits(found: &[f64], exact: &[f64]) -> f64 {
    let of = |(found, exact): (&f64, &f64)| {
        let error = ((found - exact) / exact).abs();
        if error > 0.0 { -error.log10() } else { 17.0 }
    };
    assert_eq!(found.len(), exact.len());
    found.iter().zip(exact).map(of).fold(17.0, f64::min)
}

#[test]
#[expect(clippy::print_stdout, reason = "the table of the README")]
fn certified_coefficients_are_found_to_the_digits_asked_for() {
    for set in SETS {
        let (high, low, targets) = set.design();
        let exact = set.exact();
        let wide = Wide {
            high: &high,
            low: Some(&low),
        };
        let solution = &least_squares(wide, &targets).expect("full rank")[0];
        let (refined, plain) = (
            digits(&solution.refined, &exact),
            digits(&solution.plain, &exact),
        );
        println!(
            "{:<9} {refined:5.1} digits, {plain:5.1} without refinement",
            set.name
        );
        assert!(refined >= set.digits, "{}: {refined} digits", set.name);
        assert!(refined >= plain - 0.5, "{}: {plain} before", set.name);
    }
}

#[test]
fn matrices_of_plain_doubles_lose_what_rounding_them_lost() {
    // With Filip's powers rounded to doubles, no method can give more than 7.6 digits.
    let set = SETS.iter().find(|set| set.name == "Filip").expect("listed");
    let (high, _, targets) = set.design();
    let wide = Wide {
        high: &high,
        low: None,
    };
    let solution = &least_squares(wide, &targets).expect("full rank")[0];
    let found = digits(&solution.refined, &set.exact());
    assert!((found - 7.6).abs() < 0.1, "{found}");
}
