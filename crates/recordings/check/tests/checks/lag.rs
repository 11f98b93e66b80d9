//! Tests of forces and pictures whose clocks differ.

use super::{Recording, picture, readings};

/// Force of sample `number`, in presses of 40 samples whose depths vary.
fn press(number: u32) -> f64 {
    let depth = 0.4 + 0.2 * f64::from(number / 40 * 3 % 4);
    depth * (1.0 - (f64::from(number % 40) / 20.0 - 1.0).abs())
}

#[test]
fn forces_that_go_with_earlier_pictures_are_a_lag_of_clocks() {
    let mut recording = Recording::sound();
    // Each force belongs to the picture five samples earlier.
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
            .starts_with("Fz is about 155 ms (5 steps) later than the pictures"),
        "{}",
        lag.message
    );
    assert!(lag.hint.contains("lag_ms"), "{}", lag.hint);
}

#[test]
fn units_that_are_recorded_in_turn_have_the_lag_of_their_clock_and_none_of_their_order() {
    for (later, steps) in [(0, None), (4, Some("(4 steps) later"))] {
        let mut recording = Recording::sound();
        for (number, sample) in (0..).zip(&mut recording.samples) {
            // The second unit is pressed half a press later.
            let own = number / 2 + 20 * (number % 2);
            sample.unit_id = Some(format!("u{}", number % 2));
            sample.stamp = Some(taceva_core::Stamp {
                valid_s: 0.031 * f64::from(number / 2),
                received_s: None,
            });
            sample.frame = Some(picture(number, press(own)));
            readings(sample, |channel, value| match channel {
                2 => Some(press(u32::max(own, later) - later)),
                _ => Some(value),
            });
        }
        let report = recording.check("");
        let mut findings = report.findings.iter();
        let lag = findings.find(|finding| finding.code == "TAC019");
        match steps {
            None => assert!(lag.is_none(), "{lag:?}"),
            Some(steps) => {
                let message = &lag.expect("a lag").message;
                assert!(message.contains(steps), "{message}");
            }
        }
    }
}
