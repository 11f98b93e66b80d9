//! Figure 3c of the TacEva study: success rate of gratings over the tolerance and over the spacing.

use std::collections::BTreeMap;

use taceva_core::Unit;

use super::super::overlay::{Level, Line, Sheet, Ways, Words, draw as overlay};
use crate::figure::{Figure, directed};
use crate::results::Study;

/// Tolerance of the TacEva study, and the greatest drawn tolerance, in nm.
const TOLERANCE_NM: f64 = 50_000.0;
const STEP_NM: f64 = 10_000.0;
const STEPS: u32 = 25;
const NM: f64 = 1e6;

/// One press: true spacing, and absolute error of its prediction, in nm.
struct Press {
    spacing: f64,
    error: f64,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let presses: Vec<(usize, Vec<Press>)> = studies
        .iter()
        .map(presses)
        .enumerate()
        .filter(|(_, presses)| !presses.is_empty())
        .collect();
    if presses.is_empty() {
        return None;
    }
    let lines = |levels: fn(&[Press]) -> Vec<Level>| {
        let lines = presses.iter().map(|(study, presses)| Line {
            study: *study,
            levels: levels(presses),
        });
        lines.collect()
    };
    let sheet = |title: &str, x: &str, lines| Sheet {
        title: title.to_owned(),
        x: x.to_owned(),
        y: directed("success rate", "sr"),
        y_unit: Unit::One,
        least: Some([0.0, 1.0]),
        ways: Ways::Straight,
        lines,
    };
    let sheets = [
        sheet("SR(ε)", "tolerance ε (mm)", lines(over_tolerance)),
        sheet(
            "SR(0.05 mm)",
            "spacing of the grating (mm)",
            lines(over_spacing),
        ),
    ];
    let words = Words {
        id: "figure-3c",
        title: "Figure 3c: success rate of gratings",
        caption: "Share of presses of gratings of lines and dots whose spacing is predicted to within ε, over ε and, for ε = 0.05 mm, over the spacing.".to_owned(),
        description: format!("Success rate of gratings over tolerance and spacing of {}.", crate::names::all(studies)),
    };
    overlay(&sheets, studies, 2, words, room)
}

fn presses(study: &Study) -> Vec<Press> {
    let Some(samples) = &study.samples else {
        return Vec::new();
    };
    let rows = samples.of_protocol("gratings").into_iter();
    let press = |row: usize| {
        let truth = samples.number("spacing_mm", row)?;
        let predicted = samples.number("spacing_predicted_mm", row)?;
        let [truth, predicted] = [truth, predicted].map(|mm| (mm * NM).round());
        Some(Press {
            spacing: truth,
            error: (predicted - truth).abs(),
        })
    };
    rows.filter_map(press).collect()
}

fn share(presses: &[&Press], tolerance: f64) -> (f64, u64) {
    let count = presses.iter().fold((0.0, 0.0), |(right, all), press| {
        (
            right + f64::from(u8::from(press.error <= tolerance)),
            all + 1.0,
        )
    });
    (count.0 / f64::max(count.1, 1.0), presses.len() as u64)
}

fn over_tolerance(presses: &[Press]) -> Vec<Level> {
    let all: Vec<&Press> = presses.iter().collect();
    let level = |step: u32| {
        let tolerance = f64::from(step) * STEP_NM;
        let (share, n) = share(&all, tolerance);
        Level {
            x: tolerance / NM,
            y: Some(share),
            n,
            band: None,
        }
    };
    (0..=STEPS).map(level).collect()
}

fn over_spacing(presses: &[Press]) -> Vec<Level> {
    // Spacings are positive, so their bits sort like their values.
    let mut by_spacing: BTreeMap<u64, Vec<&Press>> = BTreeMap::new();
    for press in presses {
        let key = press.spacing.max(0.0).to_bits();
        by_spacing.entry(key).or_default().push(press);
    }
    let level = |(bits, presses): (&u64, &Vec<&Press>)| {
        let (share, n) = share(presses, TOLERANCE_NM);
        Level {
            x: f64::from_bits(*bits) / NM,
            y: Some(share),
            n,
            band: None,
        }
    };
    by_spacing.iter().map(level).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_of_the_presses_within_the_tolerance() {
        let press = |spacing, error| Press { spacing, error };
        let presses = [
            press(250_000.0, 50_000.0),
            press(250_000.0, 60_000.0),
            press(350_000.0, 0.0),
        ];
        let levels = over_tolerance(&presses);
        let at = |step: usize| levels[step].y.unwrap_or(f64::NAN);
        assert!((at(0) - 1.0 / 3.0).abs() < 1e-12 && (at(5) - 2.0 / 3.0).abs() < 1e-12);
        assert!((at(6) - 1.0).abs() < 1e-12);
        let levels = over_spacing(&presses);
        assert_eq!(levels.len(), 2);
        assert!(levels[0].y.is_some_and(|share| (share - 0.5).abs() < 1e-12));
    }
}
