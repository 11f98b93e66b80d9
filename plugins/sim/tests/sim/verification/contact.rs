//! Friction, relaxation, the dome, and laws that every contact obeys.

use taceva_sim::contact::{Friction, Indentation, Relaxation, Solid};
use taceva_sim::elastic::hertz;
use taceva_sim::{Body, Model};

fn close(value: f64, reference: f64, relative: f64) {
    let error = (value - reference).abs();
    assert!(
        error <= relative * reference.abs(),
        "{value} instead of {reference}, off by {error:e}"
    );
}

/// Check V9 of `docs/validation.md`: a half-space with E = 0.325 MPa, ν = 1/2, R = 2 mm, d = 1 mm and friction μ = 1.
#[test]
fn mindlin_s_contact_resists_as_the_closed_form_says() {
    let normal_n = hertz::force(hertz::reduced_modulus(0.325, 0.5), 2.0, 1.0);
    close(normal_n, 0.817_101_169_4, 1e-9);
    let shear_modulus = 0.325 / 3.0;
    let friction = Friction {
        limit_n: normal_n,
        stiffness_n_per_mm: 8.0 * hertz::contact_radius(2.0, 1.0) * shear_modulus / 1.5,
    };
    close(friction.stiffness_n_per_mm, 0.817_101_169_4, 1e-9);
    close(friction.sliding_begins_mm(), 1.5, 1e-9);
    close(friction.load(0.3), 0.232_431_166_4, 1e-9);
}

/// Check V10 of `docs/validation.md`.
#[test]
fn a_contact_starts_stiff_and_ends_sliding() {
    let friction = Friction {
        limit_n: 0.7,
        stiffness_n_per_mm: 1.3,
    };
    let tiny = 1e-7;
    close(friction.load(tiny) / tiny, 1.3, 1e-6);
    for beyond in [1.0, 1.5, 100.0] {
        close(
            friction.load(beyond * friction.sliding_begins_mm()),
            0.7,
            1e-6,
        );
    }
}

/// Check V12 of `docs/validation.md`: stiffness 1, depth 1, duration 1, relaxing fraction 0.4 and time constant 0.5.
#[test]
fn a_linear_solid_on_a_ramp_does_the_work_of_the_closed_form() {
    let steps = 2000;
    let mut gel = Relaxation::new(0.4, 0.5);
    let decay = gel.decay(1.0 / f64::from(steps));
    let (mut area, mut last) = (0.0, 0.0);
    for step in 1..=steps {
        gel.step(f64::from(step) / f64::from(steps), decay);
        area += 0.5 * (last + gel.force_n()) / f64::from(steps);
        last = gel.force_n();
    }
    // The trapezoidal rule itself has an error of 2·10⁻⁸.
    close(area, 0.413_533_528_324, 1e-6);
}

/// Check V13 of `docs/validation.md`: a ramp of the force 0.09096 d^(3/2) to 3.38 mm and back. The relaxing fraction is 0.4636, the time constant
/// 1.5175 times the duration of the ramp.
#[test]
fn a_hertzian_solid_loses_the_work_of_the_hereditary_integral() {
    let (deepest, steps) = (3.38, 500);
    let mut gel = Relaxation::new(0.4636, 1.5175);
    let decay = gel.decay(1.0 / f64::from(steps));
    let mut branch = |depth_at: &dyn Fn(f64) -> f64| {
        let (mut area, mut last) = (0.0, gel.force_n());
        for step in 1..=steps {
            let depth: f64 = depth_at(f64::from(step) / f64::from(steps));
            gel.step(0.090_96 * depth.powf(1.5), decay);
            area += 0.5 * (last + gel.force_n()) * deepest / f64::from(steps);
            last = gel.force_n();
        }
        area
    };
    let loading = branch(&|share| deepest * share);
    let unloading = branch(&|share| deepest * (1.0 - share));
    close(loading, 0.706_194_62, 5e-3);
    close(unloading, 0.534_31, 5e-3);
    close(1.0 - unloading / loading, 0.243_395, 5e-3);
}

/// Indentation of a ball at `place_mm`, `depth_mm` below first touch, on a gel of uniform stiffness.
fn indentation(place_mm: [f64; 2], depth_mm: f64) -> Indentation {
    Indentation {
        place_mm,
        depth_mm,
        deepest_mm: depth_mm,
        shear_mm: [0.0; 2],
        indenter_radius_mm: 2.0,
        stiffness: 1.0,
    }
}

/// Check V15 of `docs/validation.md`: a closed loop never gains work, and a gel without relaxation loses none.
#[test]
fn no_loop_gains_work_and_a_gel_without_memory_loses_none() {
    for model in Model::ALL {
        for forgets in [0.0, 0.42] {
            let mut parameters = model.parameters();
            parameters.material.relaxing_fraction = forgets;
            parameters.surface.friction = 0.0;
            let solid = Solid::new(&parameters);
            let deepest = parameters.probing.depth_max_mm;
            let lost: f64 = (0..=100)
                .map(|step| {
                    let depth_mm = deepest * f64::from(step) / 100.0;
                    let loads = indentation([3.0, 1.0], depth_mm);
                    let unloads = Indentation {
                        deepest_mm: deepest,
                        ..loads
                    };
                    solid.contact(&loads).force_n[2] - solid.contact(&unloads).force_n[2]
                })
                .sum();
            if forgets > 0.0 {
                assert!(lost > 0.0, "{model} gains {lost}");
            } else {
                assert!(lost.abs() < 1e-9, "{model} loses {lost}");
            }
        }
    }
}

/// Check V15 of `docs/validation.md`: the force on the sensor is the sum of the forces along normal and tangent.
#[test]
fn forces_along_normal_and_tangent_add_up() {
    for model in Model::ALL {
        let solid = Solid::new(&model.parameters());
        let contact = solid.contact(&Indentation {
            shear_mm: [0.2, -0.1],
            ..indentation([5.0, -3.0], 0.8)
        });
        assert!(contact.touches());
        for axis in 0..3 {
            let sign = if axis == 2 { -1.0 } else { 1.0 };
            let sum = contact.shear_force_n * contact.tangent[axis]
                - contact.normal_force_n * contact.normal[axis];
            assert!((contact.force_n[axis] - sign * sum).abs() < 1e-9);
        }
        let size = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((size(contact.normal) - 1.0).abs() < 1e-12);
        assert!((size(contact.tangent) - 1.0).abs() < 1e-12);
        let total = contact.normal_force_n.hypot(contact.shear_force_n);
        assert!((size(contact.force_n) - total).abs() < 1e-12);
    }
}

/// Check V15 of `docs/validation.md`: the sensitivity S at the angle θ from the apex, for depths that do not change the normal. S(θ)/S(0) is 1/(cos²
/// θ + μ sin θ cos θ) if everything slides, and 1/cos² θ without friction.
#[test]
fn a_dome_looks_softer_towards_its_rim_by_geometry_alone() {
    let depth_mm = 1e-4;
    for (friction, expected) in [(0.0, None), (0.5, Some(0.5))] {
        let mut parameters = Model::ViTacTip.parameters();
        parameters.surface.friction = friction;
        parameters.material.relaxing_fraction = 0.0;
        let Body::Dome(dome) = &mut parameters.body else {
            panic!("a dome");
        };
        // A linear law, and a tangential stiffness so high that the contact slides at once.
        dome.gel_n_per_mm_3_2 = 1e-4;
        dome.tangential_ratio = 1.0;
        let reach = dome.radius_mm + 2.0;
        let solid = Solid::new(&parameters);
        let force = |x: f64| solid.contact(&indentation([x, 0.0], depth_mm)).force_n[2];
        let sin: f64 = 16.0 / reach;
        let cos = (1.0 - sin * sin).sqrt();
        let stick = force(0.0) / force(16.0);
        if let Some(mu) = expected {
            // d_max = 1.5 μ F/k: a slide of d tan θ exceeds it if tan θ > 1.5 μ.
            assert!(sin / cos > 1.5 * mu);
            close(stick, 1.0 / (cos * cos + mu * sin * cos), 1e-4);
        } else {
            close(stick, 1.0 / (cos * cos), 1e-4);
        }
    }
}

/// Check V16 of `docs/validation.md`.
#[test]
fn turning_a_press_around_the_dome_turns_its_force() {
    let solid = Solid::new(&Model::ViTacTip.parameters());
    let (sin, cos) = 0.9_f64.sin_cos();
    let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let press = Indentation {
        shear_mm: [0.3, -0.2],
        ..indentation([7.0, 4.0], 1.5)
    };
    let turned = Indentation {
        place_mm: turn(press.place_mm),
        shear_mm: turn(press.shear_mm),
        ..press
    };
    let (one, other) = (solid.contact(&press), solid.contact(&turned));
    let [fx, fy, fz] = one.force_n;
    let [gx, gy] = turn([fx, fy]);
    for (left, right) in [
        (gx, other.force_n[0]),
        (gy, other.force_n[1]),
        (fz, other.force_n[2]),
    ] {
        assert!((left - right).abs() < 1e-9);
    }
}

/// Check V16 of `docs/validation.md`: force laws are linear in the modulus.
#[test]
fn twice_the_stiffness_is_twice_the_force() {
    for model in Model::ALL {
        let solid = Solid::new(&model.parameters());
        let press = indentation([2.0, 2.0], 0.6);
        let twice = Indentation {
            stiffness: 2.0,
            ..press
        };
        for axis in 0..3 {
            let [one, two] = [press, twice].map(|press| solid.contact(&press).force_n[axis]);
            assert!((2.0 * one - two).abs() < 1e-9);
        }
    }
}
