//! Gels of the bench: light, symmetry and motion, by sensor.

use taceva_core::random::fnv_1a;
use taceva_core::{GratingKind, Nanometre};
use taceva_sim::optics::{
    AmbientLight, Board, Camera, GelSpec, LampSpec, OpticsSpec, Stimulus, View,
};
use taceva_sim::{Grating, GratingPose, Model};

use super::support::{camera, contact, dn, quiet, take, view};

/// Mean gray of a sensor under a light scene, over several units.
fn mean_gray(model: Model, light: AmbientLight) -> f64 {
    let units = 0..6_u32;
    let spec = OpticsSpec::new(&model.parameters());
    let sum: f64 = units
        .clone()
        .map(|unit| {
            let mut camera = Camera::new(&spec, [96, 96], unit, 1).expect("small");
            take(
                &mut camera,
                &View {
                    light,
                    ..View::default()
                },
            )
            .1
            .mean_dn()
        })
        .sum();
    sum / f64::from(units.end)
}

#[test]
fn mean_grays_are_those_of_the_papers_lighting_figure() {
    let figure = [
        (Model::ViTacTip, [12.0, 17.0, 28.0, 34.5, 47.0]),
        (Model::MagicTac, [107.0, 107.0, 107.0, 105.0, 118.0]),
    ];
    for (model, expected) in figure {
        for (light, expected) in AmbientLight::ALL.into_iter().zip(expected) {
            let found = mean_gray(model, light);
            println!("{model} {light}: mean gray {found:.1} DN ({expected})");
            assert!(
                (found / expected - 1.0).abs() < 0.02,
                "{model} {light}: {found} {expected}"
            );
        }
    }
    for (model, expected) in [(Model::GelSight, 90.0), (Model::GelSightWm, 93.0)] {
        let found = mean_gray(model, AmbientLight::Normal);
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{model}: {found} {expected}"
        );
    }
}

/// An evenly coated gel without markers, with `lamps`.
fn even(lamps: Vec<LampSpec>) -> OpticsSpec {
    let mut spec = quiet(Model::GelSightWm);
    if let GelSpec::Gelsight(gel) = &mut spec.gel {
        gel.lamps = lamps;
        gel.lamp_gain_spread = 0.0;
        gel.coating_spread = 0.0;
    }
    spec
}

#[test]
fn a_press_in_the_middle_is_as_symmetric_as_the_lamps() {
    let lamp = |x: f64, y: f64, along| LampSpec {
        middle_mm: [x, y, 3.5],
        half_length_mm: along,
        colour_dn: [90.0, 70.0, 50.0],
    };
    let spec = even(vec![
        lamp(-12.0, 0.0, [0.0, 3.0]),
        lamp(12.0, 0.0, [0.0, 3.0]),
        lamp(0.0, -14.0, [2.0, 0.0]),
        lamp(0.0, 14.0, [2.0, 0.0]),
    ]);
    let press = contact(&Model::GelSightWm.parameters(), [0.0, 0.0], 0.8, [0.0, 0.0]);
    let (width, height) = (90, 120);
    let frame = dn(&take(&mut camera(&spec, [90, 120]), &view(press)).0);
    let at = |column: usize, row: usize, colour: usize| frame[3 * (row * width + column) + colour];
    for row in 0..height {
        for column in 0..width {
            for colour in 0..3 {
                let here = at(column, row, colour);
                let across = at(width - 1 - column, row, colour);
                let below = at(column, height - 1 - row, colour);
                assert!((here - across).abs() < 0.02 && (here - below).abs() < 0.02);
            }
        }
    }
    let [middle, beside] = [at(45, 60, 0), at(39, 60, 0)];
    assert!((middle - beside).abs() > 5.0, "{middle} {beside}");
}

#[test]
fn moving_the_press_moves_the_change() {
    // Lamps far enough away to illuminate a flat surface uniformly.
    let mut spec = even(vec![LampSpec {
        middle_mm: [-2e5, 0.0, 1e5],
        half_length_mm: [0.0, 0.0],
        colour_dn: [7e6, 8e6, 9e6],
    }]);
    if let GelSpec::Gelsight(gel) = &mut spec.gel {
        gel.sag_mm = [0.0, 0.0];
    }
    let size = [143, 186];
    let mut camera = camera(&spec, size);
    let parameters = Model::GelSightWm.parameters();
    let pixel = 0.1;
    let mut change = |place: [f64; 2]| {
        let press = contact(&parameters, place, 0.6, [0.3, 0.1]);
        let pressed = dn(&take(&mut camera, &view(press)).0);
        let untouched = dn(&take(&mut camera, &View::default()).0);
        pressed
            .iter()
            .zip(&untouched)
            .map(|(a, b)| a - b)
            .collect::<Vec<f64>>()
    };
    let [columns, rows] = [12, 20];
    let first = change([-1.0, 0.5]);
    let second = change([-1.0 + pixel * 12.0, 0.5 - pixel * 20.0]);
    let mut greatest = 0.0_f64;
    for row in 30..150 {
        for column in 20..110 {
            for colour in 0..3 {
                let here = first[3 * (row * 143 + column) + colour];
                let there = second[3 * ((row + rows) * 143 + column + columns) + colour];
                assert!((here - there).abs() < 0.1, "{column} {row}: {here} {there}");
                greatest = greatest.max(here.abs());
            }
        }
    }
    assert!(greatest > 10.0, "{greatest}");
}

#[test]
fn nothing_changes_far_from_a_press() {
    let parameters = Model::GelSightWm.parameters();
    let mut camera = camera(&quiet(Model::GelSightWm), [96, 125]);
    let press = contact(&parameters, [-4.0, -6.0], 0.5, [0.0, 0.0]);
    let [pressed, untouched] =
        [view(press), View::default()].map(|view| dn(&take(&mut camera, &view).0));
    let (mut inside, mut far) = (0, 0);
    for (index, (pressed, untouched)) in pressed.chunks(3).zip(untouched.chunks(3)).enumerate() {
        let [column, row] =
            [index % 96, index / 96].map(|at| f64::from(u32::try_from(at).expect("small")));
        let x = (column + 0.5) / 96.0 * 14.3 - 7.15;
        let y = 9.3 - (row + 0.5) / 125.0 * 18.6;
        let distance = ((x + 4.0) * (x + 4.0) + (y + 6.0) * (y + 6.0)).sqrt();
        let changed = pressed
            .iter()
            .zip(untouched)
            .any(|(a, b)| (a - b).abs() > 0.004);
        if distance > 11.0 {
            far += 1;
            assert!(!changed, "{x} {y}");
        }
        inside += usize::from(changed && distance < 1.0);
    }
    assert!(far > 500 && inside > 30, "{far} {inside}");
}

#[test]
fn the_skin_of_a_dome_changes_under_the_ball_and_not_beside_it() {
    let parameters = Model::ViTacTip.parameters();
    let mut camera = camera(&quiet(Model::ViTacTip), [96, 96]);
    let press = contact(&parameters, [3.0, 0.0], 2.0, [0.0, 0.0]);
    let [pressed, untouched] =
        [view(press), View::default()].map(|view| dn(&take(&mut camera, &view).0));
    let brightest = (0..96 * 96)
        .max_by(|a, b| {
            let change = |index: usize| pressed[index] - untouched[index];
            change(*a).total_cmp(&change(*b))
        })
        .expect("pixels");
    // A point 3 mm from the axis of the dome appears some five pixels right of the centre.
    let (column, row) = (brightest % 96, brightest / 96);
    assert!(
        (50..56).contains(&column) && (45..51).contains(&row),
        "{column} {row}"
    );
    // Nothing moves between the outermost markers and the rim.
    for index in (0..96 * 96).filter(|index| index % 96 > 84) {
        assert!((pressed[index] - untouched[index]).abs() < 0.004);
    }
}

#[test]
fn dragging_a_marked_gel_carries_its_markers_along() {
    let parameters = Model::GelSight.parameters();
    let mut camera = camera(&quiet(Model::GelSight), [286, 372]);
    let mut dark = |shear_mm: [f64; 2]| {
        // A marker lies in the centre. Its position is the weighted mean of darkness within 1 mm.
        let press = contact(&parameters, [0.0, 0.0], 0.9, shear_mm);
        let frame = dn(&take(&mut camera, &view(press)).0);
        let (mut sum, mut weight) = (0.0, 0.0);
        for row in 176..196 {
            for column in 113..173_u32 {
                let index = 3 * (row * 286 + usize::try_from(column).expect("small"));
                let darkness = (40.0 - frame[index + 1]).max(0.0);
                sum += darkness * (f64::from(column) - 142.5) * 0.05;
                weight += darkness;
            }
        }
        sum / weight
    };
    let (still, dragged) = (dark([0.0, 0.0]), dark([0.4, 0.0]));
    assert!((dragged - still - 0.4).abs() < 0.12, "{still} {dragged}");
}

#[test]
fn a_grating_is_seen_and_finer_ones_fainter() {
    for model in Model::ALL {
        let mut camera = camera(&quiet(model), [240, 240]);
        let untouched = dn(&take(&mut camera, &View::default()).0);
        let mut contrast = |kind, spacing_nm| {
            let board = Board {
                grating: Grating::new(kind, Nanometre(spacing_nm)).expect("in the catalogue"),
                pose: GratingPose {
                    yaw_degree: 11.0,
                    offset_mm: [0.3, 0.1],
                },
                pressure_mpa: 0.1,
                depth_mm: 1.0,
                young_modulus_mpa: 0.3,
            };
            let view = View {
                stimulus: Stimulus::Board(board),
                ..View::default()
            };
            let frame = dn(&take(&mut camera, &view).0);
            let squares: f64 = frame
                .iter()
                .zip(&untouched)
                .map(|(a, b)| (a - b) * (a - b))
                .sum();
            squares.sqrt()
        };
        for kind in GratingKind::ALL {
            let [fine, middle, coarse] =
                [250_000, 500_000, 1_500_000].map(|spacing| contrast(kind, spacing));
            assert!(fine < middle, "{model} {kind}: {fine} {middle}");
            assert!(coarse > 1.0, "{model} {kind}: {coarse}");
            if model == Model::ViTacTip {
                assert!(fine < 0.1 * coarse, "{kind}: {fine} {coarse}");
            }
        }
    }
}

/// Pictures are part of the reproducibility of a seed: a change requires a new model version.
#[test]
fn pictures_are_frozen() {
    let found: Vec<(&str, u64)> = Model::ALL
        .into_iter()
        .map(|model| {
            let parameters = model.parameters();
            let press = contact(&parameters, [1.0, 2.0], 0.9, [0.3, -0.2]);
            let view = View {
                press: 7,
                picture: 1,
                ..view(press)
            };
            let mut camera = camera(&OpticsSpec::new(&parameters), [72, 96]);
            (model.key(), fnv_1a(take(&mut camera, &view).0.bytes()))
        })
        .collect();
    assert_eq!(
        found,
        [
            ("vitactip", 377_034_665_463_575_951),
            ("magictac", 10_012_002_122_614_603_699),
            ("gelsight", 15_478_296_535_228_209_992),
            ("gelsight-wm", 6_839_770_477_047_997_908),
        ]
    );
}
