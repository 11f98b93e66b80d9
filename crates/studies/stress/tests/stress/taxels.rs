//! Tests that faults of taxels and times depend only on values, parameter, seed and sample.

use taceva_stress::{FAULTS, RECORDING_FAULTS, Stress, TAXEL_FAULTS, TIME_FAULTS, select};

use crate::taxel_drawing::{fault, pressed, signals};

#[test]
fn the_lists_of_taxels_and_times_are_apart_from_the_others() {
    let ids = |name: &str| -> Vec<&'static str> {
        let chosen = select(&[name.to_owned()]).expect("a list");
        chosen.into_iter().map(|fault| fault.id).collect()
    };
    assert_eq!(ids("taxel-3"), TAXEL_FAULTS.map(|fault| fault.id));
    assert_eq!(ids("time-1"), ["dropped_frames"]);
    let new = || TAXEL_FAULTS.into_iter().chain(TIME_FAULTS);
    for known in FAULTS.into_iter().chain(RECORDING_FAULTS) {
        assert!(new().all(|fault| fault.id != known.id), "{}", known.id);
    }
    for fault in new() {
        assert!(
            fault.table.is_sorted() && fault.table[4] <= fault.most,
            "{}",
            fault.id
        );
    }
}

#[test]
fn a_dead_taxel_gives_zero_in_all_its_numbers_and_the_others_keep_theirs() {
    let clean = pressed(1.0, 9.0, 3);
    let with = |share: f64| {
        let stress = Stress::new(fault("taxel_dead"), share, 1);
        stress.apply_to_signals(&clean, &[1.0, 1.0], 0.0)
    };
    assert!(with(1.0).values().iter().all(|number| *number == 0.0));
    let half = with(0.5);
    let pairs = half.values().chunks(2).zip(clean.values().chunks(2));
    let is_dead: Vec<bool> = pairs
        .map(|(found, before)| {
            let is_dead = found.iter().all(|number| *number == 0.0);
            assert!(is_dead || found == before, "{found:?}");
            is_dead
        })
        .collect();
    assert!(is_dead.contains(&true) && is_dead.contains(&false));
}

#[test]
fn gains_are_too_large_or_too_small_by_the_same_share() {
    let clean = signals(|_| 128.0);
    let stress = Stress::new(fault("taxel_gain"), 0.25, 1);
    let found = stress.apply_to_signals(&clean, &[1.0, 1.0], 0.0);
    let numbers = found.values();
    assert!(numbers.iter().all(|number| [160.0, 96.0].contains(number)));
    assert!(numbers.contains(&160.0) && numbers.contains(&96.0));
}

#[test]
fn an_offset_grows_with_time_in_shares_of_the_full_scale_of_each_channel() {
    let clean = signals(|_| 0.0);
    let stress = Stress::new(fault("taxel_drift"), 0.25, 1);
    let at = |hours: f64| stress.apply_to_signals(&clean, &[8.0, 16.0], hours);
    assert_eq!(at(0.0), clean);
    for (hours, offsets) in [(1.0, [2.0_f32, 4.0]), (0.5, [1.0, 2.0])] {
        for (position, number) in at(hours).values().iter().enumerate() {
            let expected = offsets[position % 2].to_bits();
            assert_eq!(number.abs().to_bits(), expected, "{position}");
        }
    }
    let (early, late) = (at(0.5), at(1.0));
    let pairs = early.values().iter().zip(late.values());
    for (early, late) in pairs {
        let twice = (2.0 * early).to_bits();
        assert_eq!(twice, late.to_bits(), "the direction stays");
    }
}

#[test]
fn signals_with_a_fault_depend_on_values_fault_parameter_and_seed_alone() {
    let clean = pressed(1.0, 9.0, 3);
    for fault in TAXEL_FAULTS {
        let with = |parameter: f64, seed: u64| {
            let stress = Stress::new(fault, parameter, seed);
            stress.apply_to_signals(&clean, &[10.0, 20.0], 1.0)
        };
        assert_eq!(with(0.0, 1), clean, "{}", fault.id);
        assert_eq!(with(0.5, 1), with(0.5, 1), "{}", fault.id);
        assert_ne!(with(0.5, 1), with(0.5, 2), "{}", fault.id);
    }
    for other in FAULTS.into_iter().chain(RECORDING_FAULTS) {
        let stress = Stress::new(other, other.most, 1);
        let same = stress.apply_to_signals(&clean, &[10.0, 20.0], 1.0);
        assert_eq!(same, clean, "{}", other.id);
    }
}

#[test]
fn numbers_at_the_end_of_single_precision_stay_finite() {
    let clean = signals(|position| {
        if position % 2 == 0 {
            f32::MAX
        } else {
            f32::MIN
        }
    });
    for fault in TAXEL_FAULTS {
        let stress = Stress::new(fault, fault.most, 1);
        let found = stress.apply_to_signals(&clean, &[1e300, 1e300], 1e9);
        assert_eq!(found.info(), clean.info(), "{}", fault.id);
    }
}
