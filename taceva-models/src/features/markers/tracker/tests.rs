//! Tests on drawn grids of markers, moved by known amounts.

use super::*;
use crate::features::test_pictures::{Gel, grid, noise};
use taceva_core::PixelFormat;

const CLEAN: Gel = Gel {
    polarity: Polarity::Dark,
    noise: 1.0,
    seed: 1,
};

/// Root mean square distance of each of `found` from the nearest of `truth`, in pixels. Fails if any distance is large.
fn error_px(found: impl Iterator<Item = [f64; 2]>, truth: &[[f64; 2]]) -> f64 {
    let off = found.map(|found| {
        let off = truth.iter().map(|truth| distance(found, *truth));
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off < 1.0, "nothing was drawn near {found:?}");
        off * off
    });
    let squares: Vec<f64> = off.collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn every_grid() -> impl Iterator<Item = (Polarity, bool)> {
    [Polarity::Dark, Polarity::Bright]
        .into_iter()
        .flat_map(|polarity| [(polarity, false), (polarity, true)])
}

/// Largest displacement error of all markers, in pixels, and the number of unseen markers.
fn track(
    tracker: &MarkerTracker,
    frame: &Frame,
    truth: impl Fn([f64; 2]) -> [f64; 2],
) -> (f64, usize) {
    let tracked = tracker.track(frame).expect("same kind");
    let pairs = tracker.markers().iter().zip(&tracked);
    let off = pairs.map(|(marker, tracked)| {
        let rest = marker.place_px;
        let true_place = truth(rest);
        let found = [0, 1].map(|axis| rest[axis] + tracked.displacement_px[axis]);
        distance(found, true_place)
    });
    let worst = off.fold(0.0, f64::max);
    let unseen = tracked.iter().filter(|tracked| !tracked.is_seen).count();
    (worst, unseen)
}

#[test]
fn markers_of_any_grid_are_found_to_a_fraction_of_a_pixel() {
    for (polarity, is_hexagonal) in every_grid() {
        let places = grid(is_hexagonal);
        let gel = Gel { polarity, ..CLEAN };
        let tracker = MarkerTracker::new(&gel.frame(&places)).expect("markers");
        assert_eq!(tracker.polarity(), polarity);
        assert_eq!(
            tracker.markers().len(),
            places.len(),
            "{polarity:?} {is_hexagonal}"
        );
        assert!(
            (tracker.spacing_px() - Gel::SPACING).abs() < 0.2,
            "{}",
            tracker.spacing_px()
        );
        let error = error_px(tracker.markers().iter().map(|own| own.place_px), &places);
        assert!(error < 0.03, "{polarity:?} {is_hexagonal}: {error}");
    }
}

#[test]
#[expect(clippy::print_stdout, reason = "figures for the README")]
fn errors_of_places_grow_in_proportion_to_noise() {
    let error = |noise| {
        let squares: f64 = (0..8)
            .map(|seed| {
                let gel = Gel {
                    noise,
                    seed,
                    ..CLEAN
                };
                let tracker = MarkerTracker::new(&gel.frame(&grid(true))).expect("markers");
                assert_eq!(tracker.markers().len(), grid(true).len(), "noise {noise}");
                error_px(
                    tracker.markers().iter().map(|own| own.place_px),
                    &grid(true),
                )
                .powi(2)
            })
            .sum();
        (squares / 8.0).sqrt()
    };
    let errors = [0.0, 2.0, 4.0, 8.0].map(error);
    println!("noise of 0, 2, 4, 8 levels under markers of 100 to 164: {errors:?} px");
    let [bias, _, half, whole] = errors;
    // Bias of the pixel grid and uneven light.
    assert!(bias < 0.03, "{errors:?}");
    assert!(whole < 0.1, "{errors:?}");
    // Added errors are proportional to noise: twice, within a tenth.
    let added = |error: f64| (error * error - bias * bias).sqrt();
    let ratio = added(whole) / added(half);
    assert!((ratio - 2.0).abs() < 0.2, "{errors:?}");
}

#[test]
fn a_push_a_twist_and_a_stretch_are_recovered_beyond_the_distance_of_markers() {
    // Displacement up to 18 pixels at the rim, one and a half spacings, and 9 in the middle.
    let moved = |[x, y]: [f64; 2]| {
        let (right, down) = (x - 80.0, y - 60.0);
        [
            x + 4.0 + 0.06 * right - 0.1 * down,
            y - 3.0 + 0.08 * right - 0.05 * down,
        ]
    };
    for (polarity, is_hexagonal) in every_grid() {
        let inner = |place: &[f64; 2]| {
            (40.0..120.0).contains(&place[0]) && (30.0..90.0).contains(&place[1])
        };
        let places: Vec<[f64; 2]> = grid(is_hexagonal).into_iter().filter(inner).collect();
        let gel = Gel { polarity, ..CLEAN };
        let tracker = MarkerTracker::new(&gel.frame(&places)).expect("markers");
        let pressed: Vec<[f64; 2]> = places.iter().map(|place| moved(*place)).collect();
        let frame = Gel { seed: 2, ..gel }.frame(&pressed);
        let (worst, unseen) = track(&tracker, &frame, moved);
        assert!(
            worst < 0.2 && unseen == 0,
            "{polarity:?} {is_hexagonal}: {worst} px, {unseen} unseen"
        );
    }
}

#[test]
fn a_shear_that_grows_from_nothing_is_followed_past_the_next_marker() {
    // Fixed at the top, moved by one and a half spacings at the bottom. There each marker is nearest to the old position of another.
    let moved = |[x, y]: [f64; 2]| [x + 18.0 * (y / 110.0).powi(2), y];
    for (polarity, is_hexagonal) in every_grid() {
        let places: Vec<[f64; 2]> = grid(is_hexagonal)
            .into_iter()
            .filter(|place| place[0] < 130.0)
            .collect();
        let gel = Gel { polarity, ..CLEAN };
        let tracker = MarkerTracker::new(&gel.frame(&places)).expect("markers");
        let pressed: Vec<[f64; 2]> = places.iter().map(|place| moved(*place)).collect();
        let frame = Gel { seed: 3, ..gel }.frame(&pressed);
        let (worst, unseen) = track(&tracker, &frame, moved);
        assert!(
            worst < 0.2 && unseen == 0,
            "{polarity:?} {is_hexagonal}: {worst} px, {unseen} unseen"
        );
    }
}

#[test]
fn missing_and_merged_markers_are_reported_and_filled_from_their_neighbours() {
    let places = grid(false);
    let tracker = MarkerTracker::new(&CLEAN.frame(&places)).expect("markers");
    let moved = |[x, y]: [f64; 2]| [x + 2.4 + 0.02 * y, y - 1.2];
    let hidden = [17, 40, 41, 77];
    let mut pressed: Vec<[f64; 2]> = places.iter().map(|place| moved(*place)).collect();
    // Two markers that met half way.
    let merged = [0, 1].map(|axis| 0.5 * (pressed[25][axis] + pressed[26][axis]));
    pressed[25] = merged;
    pressed[26] = merged;
    let shown = pressed
        .iter()
        .enumerate()
        .filter(|(position, _)| !hidden.contains(position));
    let shown: Vec<[f64; 2]> = shown.map(|(_, place)| *place).collect();
    let (worst, unseen) = track(&tracker, &Gel { seed: 4, ..CLEAN }.frame(&shown), moved);
    assert_eq!(unseen, hidden.len() + 2);
    assert!(worst < 0.2, "{worst} px");
}

#[test]
fn markers_missing_from_the_untouched_gel_are_not_missed() {
    let mut places = grid(true);
    for gone in [70, 44, 43, 12] {
        places.remove(gone);
    }
    let tracker = MarkerTracker::new(&CLEAN.frame(&places)).expect("markers");
    assert_eq!(tracker.markers().len(), places.len());
    let moved = |[x, y]: [f64; 2]| [x - 0.8, y + 1.7];
    let pressed: Vec<[f64; 2]> = places.iter().map(|place| moved(*place)).collect();
    let (worst, unseen) = track(&tracker, &Gel { seed: 5, ..CLEAN }.frame(&pressed), moved);
    assert!(worst < 0.2 && unseen == 0, "{worst} px, {unseen} unseen");
}

#[test]
fn one_marker_is_enough() {
    for polarity in [Polarity::Dark, Polarity::Bright] {
        let gel = Gel { polarity, ..CLEAN };
        let tracker = MarkerTracker::new(&gel.frame(&[[70.4, 55.8]])).expect("a marker");
        assert_eq!((tracker.polarity(), tracker.markers().len()), (polarity, 1));
        let frame = Gel { seed: 6, ..gel }.frame(&[[73.1, 54.2]]);
        let (worst, unseen) = track(&tracker, &frame, |_| [73.1, 54.2]);
        assert!(worst < 0.1 && unseen == 0, "{worst} px");
        let tracked = tracker.track(&gel.frame(&[])).expect("same kind");
        let gone = Tracked {
            displacement_px: [0.0; 2],
            is_seen: false,
        };
        assert_eq!(tracked, [gone]);
    }
}

#[test]
fn a_gel_without_markers_is_refused_whatever_else_it_shows() {
    for noise in [0.0, 1.0, 8.0] {
        let bare = Gel { noise, ..CLEAN }.frame(&[]);
        let error = MarkerTracker::new(&bare).expect_err("nothing there");
        assert_eq!(error, FeatureError::NoMarkers { found: 0 }, "noise {noise}");
    }
    let random = noise(Gel::WIDTH, Gel::HEIGHT, PixelFormat::Rgb8, 7);
    let error = MarkerTracker::new(&random).expect_err("noise");
    assert!(matches!(error, FeatureError::NoMarkers { .. }), "{error}");
    // Scratches and dust at any position.
    let mut draws = taceva_core::random::SplitMix64::new(8);
    let mut place = || [8 + draws.below(144), 8 + draws.below(104)].map(|at| at as f64);
    let dust: Vec<[f64; 2]> = (0..60).map(|_| place()).collect();
    let error = MarkerTracker::new(&CLEAN.frame(&dust)).expect_err("no grid");
    assert!(error.to_string().contains("uneven distances"), "{error}");
}

#[test]
fn a_picture_that_is_moved_moves_its_markers_with_it() {
    let places = grid(true);
    let gel = Gel {
        noise: 0.0,
        ..CLEAN
    };
    let tracker = MarkerTracker::new(&gel.frame(&places)).expect("markers");
    for (right, down) in [(1.0, 0.0), (0.0, -2.0), (3.0, 1.0)] {
        let moved = |[x, y]: [f64; 2]| [x + right, y + down];
        let pressed: Vec<[f64; 2]> = places.iter().map(|place| moved(*place)).collect();
        let (worst, unseen) = track(&tracker, &gel.frame(&pressed), moved);
        // A shift by whole pixels changes only the rounding of a gel that is brighter to the right.
        assert!(worst < 0.03 && unseen == 0, "{worst} px, {unseen} unseen");
    }
}

#[test]
fn another_size_of_frame_is_refused() {
    let tracker = MarkerTracker::new(&CLEAN.frame(&grid(true))).expect("markers");
    let other = noise(Gel::WIDTH, 20, PixelFormat::Gray8, 1);
    assert!(matches!(
        tracker.track(&other),
        Err(FeatureError::Kind { .. })
    ));
}
