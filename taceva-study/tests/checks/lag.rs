//! A clock of the forces that is not that of the pictures.

use super::{Recording, picture, readings};

#[test]
fn forces_that_go_with_earlier_pictures_are_a_lag_of_clocks() {
    let mut recording = Recording::sound();
    // Presses of 40 samples, no two alike; each force is that of five pictures before.
    let press = |number: u32| {
        let depth = 0.4 + 0.2 * f64::from(number / 40 * 3 % 4);
        depth * (1.0 - (f64::from(number % 40) / 20.0 - 1.0).abs())
    };
    for (number, sample) in (0..).zip(&mut recording.samples) {
        let before = press(u32::max(number, 5) - 5);
        sample.frame = Some(picture(number, press(number)));
        readings(sample, |channel, value| match channel {
            2 => Some(before),
            _ => Some(value),
        });
    }
    let report = recording.check("");
    let lag = report
        .findings
        .iter()
        .find(|finding| finding.code == "TAC019");
    let lag = lag.expect("a lag");
    assert!(
        lag.message
            .starts_with("Fz comes about 155 ms (5 steps) later than the pictures"),
        "{}",
        lag.message
    );
    assert!(lag.hint.contains("lag_ms"), "{}", lag.hint);
}
