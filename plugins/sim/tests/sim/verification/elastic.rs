//! Closed forms, kernels and fits.

use taceva_sim::elastic::{hertz, kelvin, kernel::Kernel, layer};

fn close(value: f64, reference: f64, relative: f64) {
    let error = (value - reference).abs();
    assert!(
        error <= relative * reference.abs(),
        "{value} instead of {reference}, off by {error:e}"
    );
}

/// Checks V1 and V2 of `docs/validation.md`.
#[test]
fn hertz_force_is_the_closed_form() {
    close(hertz::force(1.0, 2.0, 1.0), 1.885_618_083_16, 1e-9);
    close(hertz::force(1.0, 10.0, 0.5), 1.490_711_985, 1e-9);
}

/// Check V3 of `docs/validation.md`.
#[test]
fn force_on_a_half_space_grows_with_depth_to_the_power_of_three_halves() {
    for depth in [0.1_f64, 0.5, 2.0] {
        let ratio = hertz::force(1.0, 2.0, depth * 1.01) / hertz::force(1.0, 2.0, depth);
        assert!((ratio.ln() / 1.01_f64.ln() - 1.5).abs() < 1e-6);
    }
}

/// Check V4 of `docs/validation.md`.
#[test]
fn the_surface_outside_the_contact_is_hertz_s() {
    let known = [
        (1.0, 0.5),
        (1.5, 0.297_811_389_909),
        (2.0, 0.217_995_562_088),
        (4.0, 0.106_780_162_551),
    ];
    for (rho, expected) in known {
        assert!((hertz::profile(rho) - expected).abs() < 1e-10, "{rho}");
    }
}

/// Check V5 of `docs/validation.md`: comparison with numerical integration of the layer's differential equation at high precision.
#[test]
fn the_layer_answers_waves_as_its_differential_equation_says() {
    let known = [
        (
            0.5,
            0.5,
            [0.057_573_628_394_6, 0.714_802_351_524, 0.082_153_590_391_2],
        ),
        (
            1.0,
            0.5,
            [0.240_581_681_183, 0.832_105_526_799, 0.147_880_961_404],
        ),
        (
            2.0,
            0.5,
            [0.641_450_034_275, 0.861_785_737_093, 0.110_167_851_409],
        ),
        (
            5.0,
            0.5,
            [0.994_486_735_245, 0.996_294_361_688, 0.002_259_533_053_99],
        ),
        (
            1.0,
            0.3,
            [0.415_751_798_456, 0.782_995_421_125, 0.000_515_017_976_966],
        ),
    ];
    for (zeta, poisson_ratio, expected) in known {
        let kernel = Kernel::of_layer(zeta, poisson_ratio);
        let answers = [kernel.normal, kernel.along, kernel.coupling];
        for (answer, expected) in answers.into_iter().zip(expected) {
            assert!(
                (answer - expected).abs() < 1e-10,
                "{zeta} {poisson_ratio}: {answer}"
            );
        }
        assert!((kernel.across - zeta.tanh()).abs() < 1e-14);
    }
}

/// Boundary-element solution with 200 rings, converged to 3·10⁻⁶: the ratio χ, the force ratio ψ and the ratio a/a_H of contact radii.
const BOUNDARY_ELEMENTS: [(f64, f64, f64); 7] = [
    (0.05, 1.060_24, 1.024),
    (0.10, 1.129_09, 1.045),
    (0.20, 1.297_96, 1.09),
    (0.333, 1.604_19, 1.16),
    (0.50, 2.156_25, 1.24),
    (0.70, 3.098_22, 1.32),
    (1.00, 5.115_37, 1.41),
];

/// Check V6 of `docs/validation.md`.
#[test]
fn the_force_on_a_layer_is_that_of_the_boundary_elements() {
    for (chi, force, radius) in BOUNDARY_ELEMENTS {
        close(layer::force_ratio(chi), force, 3e-3);
        assert!((layer::radius_ratio(chi) - radius).abs() < 0.012, "{chi}");
    }
}

/// Check V7 of `docs/validation.md`: the published polynomials agree for thin indentations, for which they were made, and are known to deviate
/// beyond.
#[test]
fn published_polynomials_agree_at_small_depths_and_part_at_large_ones() {
    // Dimitriadis et al., Biophysical Journal 82 (2002), bonded, ν = 1/2.
    let dimitriadis = |c: f64| 1.0 + c * (1.133 + c * (1.283 + c * (0.769 + c * 0.0975)));
    // Garcia and Garcia, Biophysical Journal 114 (2018).
    let garcia = |c: f64| 1.0 + c * (1.133 + c * (1.497 + c * (1.469 + c * 0.755)));
    for chi in [0.05, 0.1] {
        close(layer::force_ratio(chi), dimitriadis(chi), 3e-3);
    }
    for chi in [0.05, 0.1, 0.2, 0.333] {
        close(layer::force_ratio(chi), garcia(chi), 3e-3);
    }
    close(layer::force_ratio(0.5), garcia(0.5), 8e-3);
    let low_by = |chi: f64| 1.0 - dimitriadis(chi) / layer::force_ratio(chi);
    assert!((low_by(0.333) - 0.034).abs() < 0.003, "{}", low_by(0.333));
    assert!((low_by(1.0) - 0.163).abs() < 0.005, "{}", low_by(1.0));
}

/// Check V11 of `docs/validation.md`.
#[test]
fn the_tangential_stiffness_of_a_layer_is_the_quadrature_of_its_kernel() {
    for (chi, expected) in [(0.1, 1.046_066), (0.333, 1.167_851), (1.0, 1.598_374)] {
        close(layer::shear_ratio(chi), expected, 2e-4);
    }
}

/// Check V14 of `docs/validation.md`.
#[test]
fn kelvin_s_function_has_its_tabled_values() {
    for (x, expected) in [
        (0.0, -std::f64::consts::FRAC_PI_4),
        (1.0, -0.494_994_636_519),
        (3.0, -0.051_121_884_046),
        (12.0, -3.899_959_497_178_8e-5),
    ] {
        assert!((kelvin::kei(x) - expected).abs() < 1e-6, "{x}");
    }
}
