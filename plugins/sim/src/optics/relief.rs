//! Visible relief of a grating pressed into a gel.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use taceva_core::GratingKind;

use super::error::OpticsError;
use super::stimulus::Board;
use crate::elastic::kernel::Kernel;
use crate::number::narrow;

/// Layer, lens and pixels between a grating and its picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Thickness of the gel that follows the grating; `None` if the camera sees the board through the gel.
    pub(super) layer_mm: Option<f64>,
    /// Standard deviation of the lens's blur, on the gel.
    pub(super) blur_mm: f64,
    /// Side of a pixel, on the gel.
    pub(super) pixel_mm: f64,
}

/// Visible grating: the first harmonics of its square waves, each attenuated by layer, lens and pixel.
///
/// Lines are sq(u), dots sq(u) sq(v), with sq the square wave of ±1 and period 2w (w the spacing), u and v along the board's sides.
///
/// * The layer follows a wave of amplitude A and wave number k under a pressure A k E / (1.5 L(k h)), with modulus E, thickness h and the
///   layer's kernel L. A lower pressure has a proportional effect.
/// * The lens with the blur σ passes exp(−k²σ²/2), for harmonic m exp(−2 (π σ m / 2w)²).
/// * A pixel of side p passes sin(k p/2) / (k p/2), the same in every direction.
#[derive(Clone, Debug)]
pub(super) struct Relief {
    /// Amplitudes of harmonics 1, 3 and 5 along one side of the board, for each harmonic along the other side, within ±1. Lines use only the first
    /// row.
    left: [[f32; 3]; 3],
    kind: GratingKind,
    wave_number: f32,
    centre: [f32; 2],
    /// Cosine and sine of the yaw.
    turn: [f32; 2],
}

/// Height of a board's relief above its middle, mm (literature).
const AMPLITUDE_MM: f64 = 0.2;
/// Half the side of a board, mm (from the board's geometry).
const HALF_SIDE_MM: f32 = 5.0;
/// Width of the fading edge of a board, mm.
const EDGE_MM: f32 = 0.15;
const HARMONICS: [f64; 3] = [1.0, 3.0, 5.0];

impl Relief {
    /// Visible part of the grating of `board`, seen through `window`.
    ///
    /// # Errors
    /// [`OpticsError::Value`] for a pressure or modulus that is not positive, or a place that is not finite.
    pub(super) fn new(board: &Board, window: Window) -> Result<Relief, OpticsError> {
        let kind = board.grating.kind();
        positive("pressure_mpa", board.pressure_mpa)?;
        positive("young_modulus_mpa", board.young_modulus_mpa)?;
        finite("depth_mm", board.depth_mm)?;
        finite("yaw_degree", board.pose.yaw_degree)?;
        for offset_mm in board.pose.offset_mm {
            finite("offset_mm", offset_mm)?;
        }
        let wave_number = 2.0 * PI / board.grating.period_mm();
        let left = HARMONICS.map(|across| {
            HARMONICS.map(|along| {
                let (part, k) = match kind {
                    GratingKind::Line if across > 1.0 => return 0.0,
                    GratingKind::Line => (square_wave(along), along * wave_number),
                    GratingKind::Dot => (
                        square_wave(along) * square_wave(across),
                        (along * along + across * across).sqrt() * wave_number,
                    ),
                };
                let followed = window.layer_mm.map_or(1.0, |thickness| {
                    followed(board, AMPLITUDE_MM * part.abs(), k, thickness)
                });
                narrow(part * followed * resolved(&window, k))
            })
        });
        let (sin, cos) = libm::sincos(board.pose.yaw_degree.to_radians());
        Ok(Relief {
            left,
            kind,
            wave_number: narrow(wave_number),
            centre: board.pose.offset_mm.map(narrow),
            turn: [narrow(cos), narrow(sin)],
        })
    }

    /// Centre of the board.
    pub(super) fn centre(&self) -> [f32; 2] {
        self.centre
    }

    /// Radius around the centre beyond which the board is invisible.
    pub(super) fn reach(&self) -> f32 {
        (HALF_SIDE_MM + 8.0 * EDGE_MM) * std::f32::consts::SQRT_2
    }

    /// Relief at a place, relative to the full relief, within ±1; positive towards the camera.
    pub(super) fn at(&self, x: f32, y: f32) -> f32 {
        let [u, v] = self.on_board(x, y);
        let [along, _] = waves(self.wave_number * u);
        let [across, _] = self.waves_across(v);
        board_edge(u) * board_edge(v) * self.sum(&along, &across)
    }

    /// Slope towards the camera at a place, along x and y.
    pub(super) fn slope(&self, x: f32, y: f32) -> [f32; 2] {
        let [u, v] = self.on_board(x, y);
        let [along, along_slope] = waves(self.wave_number * u);
        let [across, across_slope] = self.waves_across(v);
        let scale = narrow(AMPLITUDE_MM) * self.wave_number * board_edge(u) * board_edge(v);
        let slope_u = scale * self.sum(&along_slope, &across);
        let slope_v = scale * self.sum(&along, &across_slope);
        let [cos, sin] = self.turn;
        [cos * slope_u - sin * slope_v, sin * slope_u + cos * slope_v]
    }

    fn on_board(&self, x: f32, y: f32) -> [f32; 2] {
        let [x, y] = [x - self.centre[0], y - self.centre[1]];
        let [cos, sin] = self.turn;
        [cos * x + sin * y, cos * y - sin * x]
    }

    fn waves_across(&self, v: f32) -> [[f32; 3]; 2] {
        match self.kind {
            GratingKind::Line => [[1.0, 0.0, 0.0], [0.0; 3]],
            GratingKind::Dot => waves(self.wave_number * v),
        }
    }

    fn sum(&self, along: &[f32; 3], across: &[f32; 3]) -> f32 {
        self.left
            .iter()
            .zip(across)
            .map(|(left, across)| {
                let row: f32 = left
                    .iter()
                    .zip(along)
                    .map(|(left, along)| left * along)
                    .sum();
                row * across
            })
            .sum()
    }
}

/// Amplitude of harmonic m in a square wave of ±1 that is even about 0: ±4/(π m).
fn square_wave(m: f64) -> f64 {
    // cos((m − 1) π/2) is +1, −1, +1 for m = 1, 3, 5.
    libm::cos((m - 1.0) * FRAC_PI_2).signum() / (FRAC_PI_4 * m)
}

/// Fraction of a wave's amplitude that the layer follows.
fn followed(board: &Board, amplitude_mm: f64, k: f64, thickness_mm: f64) -> f64 {
    let kernel = Kernel::of_layer(k * thickness_mm, 0.5);
    let needed = amplitude_mm * k * board.young_modulus_mpa / (1.5 * kernel.normal);
    (board.pressure_mpa / needed).min(1.0)
}

/// Fraction of a wave's amplitude that passes lens and pixel.
fn resolved(window: &Window, k: f64) -> f64 {
    let blur = k * window.blur_mm;
    let half_pixel = 0.5 * k * window.pixel_mm;
    let pixel = if half_pixel > 1e-6 {
        libm::sin(half_pixel) / half_pixel
    } else {
        1.0
    };
    libm::exp(-0.5 * blur * blur) * pixel
}

/// cos φ, cos 3φ, cos 5φ and their derivatives with respect to φ, from one sine and cosine.
fn waves(phase: f32) -> [[f32; 3]; 2] {
    let (s, c) = libm::sincosf(phase);
    let square = c * c;
    [
        [
            c,
            c * (4.0 * square - 3.0),
            c * (square * (16.0 * square - 20.0) + 5.0),
        ],
        [
            -s,
            -3.0 * s * (4.0 * square - 1.0),
            -5.0 * s * (square * (16.0 * square - 12.0) + 1.0),
        ],
    ]
}

/// Weight of a place along one axis of the board: 1 on the board, 0 outside.
fn board_edge(along: f32) -> f32 {
    let beyond = (along.abs() - HALF_SIDE_MM) / EDGE_MM;
    if beyond > 8.0 {
        return 0.0;
    }
    1.0 / (1.0 + libm::expf(2.0 * beyond))
}

fn positive(quantity: &'static str, value: f64) -> Result<(), OpticsError> {
    let expected = "a number above 0";
    (value > 0.0 && value.is_finite())
        .then_some(())
        .ok_or(OpticsError::Value {
            quantity,
            value,
            expected,
        })
}

fn finite(quantity: &'static str, value: f64) -> Result<(), OpticsError> {
    value.is_finite().then_some(()).ok_or(OpticsError::Value {
        quantity,
        value,
        expected: "a finite number",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimen::{Grating, GratingPose};
    use taceva_core::Nanometre;

    const SHARP: Window = Window {
        layer_mm: None,
        blur_mm: 0.0,
        pixel_mm: 0.0,
    };

    fn board(kind: GratingKind, spacing_nm: i64) -> Board {
        Board {
            grating: Grating::new(kind, Nanometre(spacing_nm)).expect("in the catalogue"),
            pose: GratingPose {
                yaw_degree: 0.0,
                offset_mm: [0.0, 0.0],
            },
            pressure_mpa: 0.1,
            depth_mm: 0.5,
            young_modulus_mpa: 0.325,
        }
    }

    #[test]
    fn harmonics_are_those_of_the_multiple_angle() {
        for phase in [0.0_f32, 0.3, 1.1, 2.9, -4.0] {
            let [cosines, slopes] = waves(phase);
            for (i, m) in [1.0_f32, 3.0, 5.0].into_iter().enumerate() {
                assert!((cosines[i] - (m * phase).cos()).abs() < 1e-5);
                assert!((slopes[i] + m * (m * phase).sin()).abs() < 3e-5);
            }
        }
    }

    #[test]
    fn a_sharp_line_grating_is_a_square_wave_of_twice_the_spacing() {
        let relief = Relief::new(&board(GratingKind::Line, 1_000_000), SHARP).expect("a board");
        for (x, expected) in [(0.0, 1.0), (1.0, -1.0), (2.0, 1.0), (0.5, 0.0)] {
            assert!((relief.at(x, 0.3) - expected).abs() < 0.15, "{x}");
        }
        assert!((relief.at(0.2, -3.0) - relief.at(0.2, 2.0)).abs() < 1e-6);
    }

    #[test]
    fn the_layer_follows_as_much_as_the_table_of_pressures_says() {
        // Pressures of the simulated bench for gratings: 0.2 mm needs 0.55, 0.27, 0.14, 0.08 MPa at 0.25, 0.5, 1, 1.75 mm on the GelSight gel.
        for (spacing, needed) in [(0.25, 0.55), (0.5, 0.27), (1.0, 0.14), (1.75, 0.08)] {
            let part = followed(&board(GratingKind::Line, 250_000), 0.2, PI / spacing, 4.25);
            let expected = (0.1_f64 / needed).min(1.0);
            assert!(
                (part - expected).abs() < 0.02 + 0.03 * expected,
                "{spacing}: {part}"
            );
        }
    }

    #[test]
    fn the_lens_blurs_by_the_formula_of_the_harmonics() {
        let window = Window {
            blur_mm: 0.36,
            ..SHARP
        };
        let (spacing, m) = (0.5, 1.0);
        let expected = libm::exp(-2.0 * (PI * 0.36 * m / (2.0 * spacing)).powi(2));
        assert!((resolved(&window, m * PI / spacing) - expected).abs() < 1e-12);
    }

    #[test]
    fn slopes_are_those_of_the_relief() {
        let mut board = board(GratingKind::Dot, 1_500_000);
        board.pose = GratingPose {
            yaw_degree: 17.0,
            offset_mm: [0.4, -0.2],
        };
        let relief = Relief::new(
            &board,
            Window {
                blur_mm: 0.2,
                ..SHARP
            },
        )
        .expect("a board");
        let step = 1e-2_f32;
        for (x, y) in [(0.3, 0.1), (-1.2, 0.7), (2.0, -1.5)] {
            let [slope_x, slope_y] = relief.slope(x, y);
            let by_x = (relief.at(x + step, y) - relief.at(x - step, y)) / (2.0 * step);
            let by_y = (relief.at(x, y + step) - relief.at(x, y - step)) / (2.0 * step);
            assert!((slope_x - 0.2 * by_x).abs() < 2e-3, "{slope_x} {by_x}");
            assert!((slope_y - 0.2 * by_y).abs() < 2e-3, "{slope_y} {by_y}");
        }
    }

    #[test]
    fn a_board_ends_at_its_edge() {
        let relief = Relief::new(&board(GratingKind::Line, 500_000), SHARP).expect("a board");
        assert!(relief.at(6.5, 0.0).abs() < 1e-6);
        assert!(relief.at(0.0, -6.5).abs() < 1e-6);
    }

    #[test]
    fn numbers_that_are_none_are_refused_by_name() {
        let mut board = board(GratingKind::Line, 250_000);
        board.pressure_mpa = 0.0;
        assert_eq!(
            Relief::new(&board, SHARP)
                .expect_err("no pressure")
                .to_string(),
            "pressure_mpa = 0: expected a number above 0"
        );
        board.pressure_mpa = 0.1;
        board.pose.yaw_degree = f64::NAN;
        assert!(Relief::new(&board, SHARP).is_err());
    }
}
