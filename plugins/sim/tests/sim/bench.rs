//! The bench as a whole: rejected presses, repeatability, and the force limit.

use std::thread;

use taceva_sim::{Bench, Contact, History, Label, Model, Parameters, Press, PressError};

fn bench(model: Model) -> Bench {
    Bench::new(model.parameters(), 0, 7)
}

/// Presses over the whole surface of a sensor, two per point.
fn presses(model: Model) -> Vec<Press> {
    let parameters = model.parameters();
    let outline = parameters.outline();
    (0..300)
        .map(|id| {
            let share = |step: f64| (id as f64 * step).fract();
            Press {
                id,
                point: id / 2,
                place_mm: outline.place(share(0.618_034), share(0.754_878)),
                depth_mm: parameters.probing.depth_max_mm * share(0.569_84),
                shear_mm: [share(0.3) - 0.5, share(0.7) - 0.5],
                ..Press::default()
            }
        })
        .collect()
}

fn record(bench: &Bench, press: &Press) -> (Contact, Label) {
    let contact = bench.press(press).expect("within the limits");
    (contact, bench.label(press, &contact))
}

#[test]
fn order_and_threads_change_no_bit() {
    for model in Model::ALL {
        let presses = presses(model);
        let forward: Vec<_> = presses
            .iter()
            .map(|press| record(&bench(model), press))
            .collect();
        let one = bench(model);
        let mut backward: Vec<_> = presses
            .iter()
            .rev()
            .map(|press| record(&one, press))
            .collect();
        backward.reverse();
        // `Debug` writes the shortest digits that parse back to the same bits.
        assert_eq!(format!("{forward:?}"), format!("{backward:?}"));
        let threaded: Vec<_> = thread::scope(|scope| {
            let workers: Vec<_> = presses
                .chunks(37)
                .map(|chunk| {
                    let one = &one;
                    scope.spawn(move || {
                        chunk
                            .iter()
                            .map(|press| record(one, press))
                            .collect::<Vec<_>>()
                    })
                })
                .collect();
            workers
                .into_iter()
                .flat_map(|worker| worker.join().expect("no panic"))
                .collect()
        });
        assert_eq!(format!("{forward:?}"), format!("{threaded:?}"));
    }
}

#[test]
fn another_seed_changes_labels_and_another_unit_changes_the_gel() {
    let press = Press {
        depth_mm: 0.5,
        ..Press::default()
    };
    let force = |unit, seed| {
        let bench = Bench::new(Model::GelSight.parameters(), unit, seed);
        record(&bench, &press).1.force_n[2].to_bits()
    };
    assert_eq!(force(0, 1), force(0, 1));
    assert_ne!(force(0, 1), force(0, 2));
    assert_ne!(force(0, 1), force(1, 1));
}

#[test]
fn presses_that_no_rig_would_make_are_refused_by_name() {
    let gelsight = bench(Model::GelSight);
    let refused = |press: Press| gelsight.press(&press).expect_err("refused").to_string();
    let plain = Press::default();
    for value in [f64::NAN, f64::INFINITY] {
        let press = Press {
            shear_mm: [0.0, value],
            ..plain
        };
        assert!(matches!(
            gelsight.press(&press),
            Err(PressError::NotFinite {
                name: "shear y",
                ..
            })
        ));
    }
    let place = Press {
        place_mm: [8.1, 0.0],
        ..plain
    };
    assert_eq!(
        refused(place),
        "a press at x = 8.1 mm and y = 0 mm, expected a place on a rectangle of ±8 × ±10 mm"
    );
    let depth = Press {
        depth_mm: 1.2,
        ..plain
    };
    assert_eq!(refused(depth), "a press 1.2 mm deep, expected 0 to 1 mm");
    let turned = Press {
        turned_mm: Some(2.0),
        ..plain
    };
    assert_eq!(refused(turned), "a press 2 mm deep, expected 0 to 1 mm");
    let negative = Press {
        depth_mm: -0.1,
        ..plain
    };
    assert_eq!(
        refused(negative),
        "a press -0.1 mm deep, expected 0 to 1 mm"
    );
    let shear = Press {
        shear_mm: [9.0, 0.0],
        ..plain
    };
    assert_eq!(
        refused(shear),
        "a shear of 9 mm, expected at most 5 mm in either direction"
    );
    let dome = bench(Model::ViTacTip).press(&Press {
        place_mm: [13.0, 13.0],
        ..plain
    });
    assert_eq!(
        dome.expect_err("outside").to_string(),
        "a press at x = 13 mm and y = 13 mm, expected a place on a disc of 17 mm radius"
    );
}

#[test]
fn a_press_that_meets_the_force_limit_stops_there_and_says_so() {
    let mut parameters = Model::GelSight.parameters();
    parameters.probing.force_max_n = 0.5;
    let bench = Bench::new(parameters, 0, 7);
    let press = Press {
        depth_mm: 0.9,
        ..Press::default()
    };
    let (contact, label) = record(&bench, &press);
    assert!(contact.limited);
    assert!(
        (contact.force_n[2] - 0.5).abs() < 1e-6,
        "{}",
        contact.force_n[2]
    );
    assert!(contact.travel_mm < 0.9 && contact.travel_mm > 0.1);
    assert_eq!(label.position_mm[2].to_bits(), contact.travel_mm.to_bits());
    let (shallow, _) = record(
        &bench,
        &Press {
            depth_mm: 0.1,
            ..press
        },
    );
    assert!(!shallow.limited && shallow.travel_mm.to_bits() == 0.1_f64.to_bits());
}

#[test]
fn contact_is_found_late_by_the_published_amounts() {
    // Expected mean and tolerance in mm, over many points.
    for (model, expected) in [
        (Model::GelSight, 0.12),
        (Model::MagicTac, 0.16),
        (Model::ViTacTip, 0.27),
    ] {
        let bench = bench(model);
        let presses = presses(model);
        let late: f64 = presses
            .iter()
            .map(|press| bench.touch(press).expect("within the limits").late_mm)
            .sum();
        let mean = late / presses.len() as f64;
        assert!((mean - expected).abs() < 0.03, "{model}: {mean}");
    }
}

#[test]
fn presses_at_one_point_share_one_search() {
    let bench = bench(Model::MagicTac);
    let press = Press {
        depth_mm: 0.4,
        ..Press::default()
    };
    let later = Press {
        id: 99,
        depth_mm: 0.7,
        ..press
    };
    assert_eq!(bench.touch(&press), bench.touch(&later));
}

#[test]
fn a_conditioned_gel_presses_back_less_and_a_resumed_run_meets_the_same_gel() {
    let table = Model::GelSight.table().replace(
        "conditioning_fraction = { value = 0.0",
        "conditioning_fraction = { value = 0.02",
    );
    let bench = Bench::new(Parameters::parse(&table).expect("a table"), 0, 7);
    let press = Press {
        depth_mm: 0.5,
        ..Press::default()
    };
    let virgin = bench.press(&press).expect("within the limits");
    let mut history = History::new();
    for depth_mm in [0.8, 0.6, 0.9] {
        history.finish(press.point, depth_mm);
    }
    let worn = bench
        .press_after(&history, &press)
        .expect("within the limits");
    let ratio = worn.force_n[2] / virgin.force_n[2];
    assert!(
        (ratio - (1.0 - 0.02 * (1.0 - (-1.0_f64).exp()))).abs() < 1e-9,
        "{ratio}"
    );
    let mut resumed = History::new();
    for depth_mm in [0.9, 0.8, 0.6] {
        resumed.finish(press.point, depth_mm);
    }
    assert_eq!(bench.press_after(&resumed, &press), Ok(worn));
    let elsewhere = Press { point: 1, ..press };
    assert_eq!(
        bench.press_after(&history, &elsewhere),
        bench.press(&elsewhere)
    );
}

#[test]
fn everything_says_that_it_is_simulated() {
    let provenance = bench(Model::GelSight).provenance();
    let text = provenance.to_string();
    assert!(text.starts_with(
        "source = simulated, model_version = 2, sensor = GelSight, unit = 0, seed = 7"
    ));
    assert!(text.ends_with(&provenance.parameters.to_string()));
}
