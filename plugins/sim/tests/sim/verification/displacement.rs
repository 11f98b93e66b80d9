//! Displacement fields under a contact.

use taceva_sim::displacement::{Field, Load, Profile, Quantity, Tables};

fn unit_press() -> Load {
    Load {
        contact_radius_mm: 1.0,
        // At this depth, the ball has the shape of the table, so the scale at the rim is 1.
        depth_mm: 0.464_237_244_2,
        indenter_radius_mm: 1.0 / (2.0 * (0.464_237_244_2 - 0.185_780_127_6)),
        young_modulus_mpa: 1.0,
        normal_force_n: 1.0,
        ..Load::default()
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a place needs no more than seven digits here"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}

fn row(thickness_mm: f64, depth_mm: f64, load: &Load) -> Profile {
    let mut profile = Profile::new();
    Tables::new(thickness_mm, depth_mm).profile(load, &mut profile);
    profile
}

/// Check V8 of `docs/validation.md`: force 1 N, modulus 1 MPa, thickness 4.25 mm and contact radius 1 mm.
#[test]
fn a_layer_sinks_and_spreads_as_the_quadrature_says() {
    let load = unit_press();
    let profile = row(4.25, 0.0, &load);
    let field = Field::new(&profile, &load);
    let centre = 0.464_237_244_2_f64;
    let sinks = [
        (0.0_f32, centre),
        (1.0, 0.185_780_127_6),
        (2.0, 0.034_772_653_38),
        (4.0, -0.005_804_569_721),
    ];
    for (r, expected) in sinks {
        let [_, _, up] = field.at(r, 0.0);
        assert!(
            (f64::from(-up) - expected).abs() < 2e-3 * centre,
            "sinks {up} at {r}"
        );
    }
    let spreads = [
        (1.0_f32, 0.006_681_234_099),
        (2.0, 0.011_898_297_08),
        (4.0, 0.015_484_349_36),
    ];
    for (r, expected) in spreads {
        let [_, outward, _] = field.at(0.0, r);
        assert!(
            (f64::from(outward) - expected).abs() < 2e-3 * centre,
            "spreads {outward} at {r}"
        );
    }
}

/// Check V8 of `docs/validation.md` for an infinitely thick layer.
#[test]
fn a_very_thick_layer_sinks_as_a_half_space() {
    let load = Load {
        depth_mm: 0.5625,
        indenter_radius_mm: 1.0 / 0.5625,
        ..unit_press()
    };
    let profile = row(1e4, 0.0, &load);
    let field = Field::new(&profile, &load);
    for (r, expected) in [
        (0.0_f32, 0.5625),
        (1.0, 0.281_25),
        (2.0, 0.122_622_503_7),
        (4.0, 0.060_063_841_43),
    ] {
        let [_, _, up] = field.at(r, 0.0);
        assert!(
            (f64::from(-up) - expected).abs() < 2e-3 * 0.5625,
            "{up} at {r}"
        );
    }
}

/// Check V8 of `docs/validation.md` between the rows and nodes of the tables: closed forms of the half-space at radii without a row.
#[test]
fn places_between_nodes_are_as_good_as_nodes() {
    for radius in [0.173, 0.9, 1.37] {
        let load = Load {
            contact_radius_mm: radius,
            depth_mm: 0.5625 / radius,
            indenter_radius_mm: radius.powi(3) / 0.5625,
            ..unit_press()
        };
        let profile = row(1e4, 0.0, &load);
        let field = Field::new(&profile, &load);
        for step in 1..200 {
            let rho = f64::from(step) * 0.037;
            let expected = load.depth_mm * taceva_sim::elastic::hertz::profile(rho);
            let [_, _, up] = field.at(narrow(rho * radius), 0.0);
            assert!(
                (f64::from(-up) - expected).abs() < 2e-4 * load.depth_mm,
                "{rho} {radius}"
            );
        }
    }
}

/// The slope is the derivative of the height with respect to x and y, shear included.
#[test]
fn slopes_are_the_gradient_of_the_height() {
    let load = Load {
        shear_force_n: [0.3, -0.4],
        ..unit_press()
    };
    let profile = row(4.25, 0.0, &load);
    let field = Field::new(&profile, &load);
    let h = 0.02;
    for (x, y) in [(0.3, 0.2), (-1.6, 0.4), (2.0, 2.5), (0.1, -5.0)] {
        let height = |x, y| field.at(x, y)[2];
        let difference = [
            (height(x + h, y) - height(x - h, y)) / (2.0 * h),
            (height(x, y + h) - height(x, y - h)) / (2.0 * h),
        ];
        for (slope, difference) in field.slope(x, y).into_iter().zip(difference) {
            assert!(
                (slope - difference).abs() < 3e-3,
                "{slope} {difference} at {x} {y}"
            );
        }
    }
}

/// Check V16 of `docs/validation.md`.
#[test]
fn turning_the_press_turns_the_field() {
    let load = Load {
        shear_force_n: [0.5, 0.0],
        ..unit_press()
    };
    let (sin, cos) = 0.7_f32.sin_cos();
    let turn = |[x, y]: [f32; 2]| [cos * x - sin * y, sin * x + cos * y];
    let turned = Load {
        shear_force_n: turn([0.5, 0.0]).map(f64::from),
        ..load
    };
    let profile = row(4.25, 0.0, &load);
    let (field, other) = (Field::new(&profile, &load), Field::new(&profile, &turned));
    for place in [[0.4, 0.3], [2.0, -1.0], [-6.0, 3.0]] {
        let [x, y] = turn(place);
        let [ux, uy, up] = field.at(place[0], place[1]);
        let [vx, vy, vp] = other.at(x, y);
        let [wx, wy] = turn([ux, uy]);
        for (left, right) in [(vx, wx), (vy, wy), (vp, up)] {
            assert!((left - right).abs() < 1e-6, "{left} {right}");
        }
    }
}

/// Check V16 of `docs/validation.md`.
#[test]
fn the_field_of_a_shear_is_its_own_mirror_image() {
    let load = Load {
        shear_force_n: [0.5, 0.0],
        ..unit_press()
    };
    let profile = row(15.0, 0.8, &load);
    let field = Field::new(&profile, &load);
    for (x, y) in [(0.4, 0.3), (2.0, -1.0), (-6.0, 3.0)] {
        let ([ux, uy, up], [vx, vy, vp]) = (field.at(x, y), field.at(x, -y));
        assert!((ux - vx).abs() < 1e-6 && (uy + vy).abs() < 1e-6 && (up - vp).abs() < 1e-6);
    }
}

/// Check V16 of `docs/validation.md`.
#[test]
fn twice_the_force_moves_the_gel_twice_as_far() {
    let load = Load {
        shear_force_n: [0.5, 0.2],
        ..unit_press()
    };
    let twice = Load {
        normal_force_n: 2.0,
        shear_force_n: [1.0, 0.4],
        ..load
    };
    let tables = Tables::new(15.0, 3.0);
    let (mut once, mut doubled) = (Profile::new(), Profile::new());
    tables.profile(&load, &mut once);
    tables.profile(&twice, &mut doubled);
    for quantity in Quantity::ALL {
        for (one, two) in once.table(quantity).iter().zip(doubled.table(quantity)) {
            assert!((2.0 * one - two).abs() <= 1e-6 * two.abs());
        }
    }
}

/// The field below a thick layer's surface under nearly a point load F is Boussinesq's for an incompressible half-space of modulus E: u_z = 3F/(4πE)
/// (1/R)(1 + z²/R²) and u_r = 3F/(4πE) z r/R³ with R² = r² + z².
#[test]
fn deep_below_a_small_contact_the_field_is_that_of_a_point_force() {
    let load = Load {
        contact_radius_mm: 0.1,
        ..unit_press()
    };
    let depth = 6.0;
    let profile = row(1e4, depth, &load);
    let field = Field::new(&profile, &load);
    let unit = 3.0 / (4.0 * std::f64::consts::PI);
    for r in [0.5_f64, 2.0, 5.0] {
        let distance = r.hypot(depth);
        let sink = unit / distance * (1.0 + (depth / distance).powi(2));
        let outward = unit * depth * r / distance.powi(3);
        let [x, _, up] = field.at(narrow(r), 0.0);
        assert!(
            (f64::from(-up) / sink - 1.0).abs() < 5e-3,
            "sink {up} {sink} at {r}"
        );
        assert!(
            (f64::from(x) / outward - 1.0).abs() < 5e-3,
            "outward {x} {outward} at {r}"
        );
    }
}
