//! Draws the tables of `examples/taxels`: presses of a magnetic skin and of a capacitive fingertip.
//!
//! ```text
//! cargo run --example draw_taxels -- examples/taxels
//! ```
//!
//! No sensor was pressed: taxels follow closed forms of the labels, with noise of a fixed seed. Only the number, arrangement and unit of the taxels
//! are as in real sensors.

use std::fmt::Write as _;
use std::path::Path;

/// Number of contact points.
const POINTS: u32 = 60;
/// Depths of the presses at a point, mm. At 0 the tip does not touch the sensor.
const DEPTHS_MM: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25];
/// Positions of five magnetometers, mm: one in the middle and four around it.
const CHIPS_MM: [[f64; 2]; 5] = [[0.0, 0.0], [6.0, 0.0], [-6.0, 0.0], [0.0, 6.0], [0.0, -6.0]];

/// A press: its point, position and depth in mm, and the forces along x and into the gel in N.
struct Press {
    point: u32,
    x_mm: f64,
    y_mm: f64,
    depth_mm: f64,
    shear_n: f64,
    force_n: f64,
}

impl Press {
    /// Response of a taxel at a position: exp(-d² / `reach_mm2`) for the distance d from the centre of the press.
    fn near(&self, [x_mm, y_mm]: [f64; 2], reach_mm2: f64) -> f64 {
        let (away_x, away_y) = (self.x_mm - x_mm, self.y_mm - y_mm);
        (-(away_x * away_x + away_y * away_y) / reach_mm2).exp()
    }

    /// Labels of the press as CSV cells.
    fn labels(&self) -> String {
        format!(
            "{},{:.3},{:.3},{:.2},{:.4},{:.4}",
            self.point, self.x_mm, self.y_mm, self.depth_mm, self.shear_n, self.force_n
        )
    }
}

/// Random numbers from -1 to 1, equal on every machine, by a linear congruential generator.
struct Noise(u64);

impl Noise {
    fn draw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        let high = u32::try_from(self.0 >> 40).unwrap_or_default();
        f64::from(high) / 8_388_608.0 - 1.0
    }

    /// All presses, at random points with |x| and |y| up to the two values of `half_mm`, mm.
    fn presses(&mut self, half_mm: [f64; 2]) -> Vec<Press> {
        let mut presses = Vec::new();
        for point in 0..POINTS {
            let [x_mm, y_mm] = half_mm.map(|half| half * self.draw());
            let shear = 0.2 * self.draw();
            for depth_mm in DEPTHS_MM {
                let force_n = 1.6 * depth_mm + 0.8 * depth_mm * depth_mm;
                presses.push(Press {
                    point,
                    x_mm,
                    y_mm,
                    depth_mm,
                    shear_n: shear * force_n,
                    force_n,
                });
            }
        }
        presses
    }
}

const LABELS: &str = "point,x_mm,y_mm,depth_mm,shear_N,force_N";

/// Table of a magnetic skin: five magnetometers with three axes each, in µT. A press moves the magnets above them.
pub(crate) fn magnetic() -> String {
    let mut noise = Noise(1);
    let mut text = LABELS.to_owned();
    for chip in 0..CHIPS_MM.len() {
        let _ = write!(text, ",b_x{chip},b_y{chip},b_z{chip}");
    }
    text.push('\n');
    for press in noise.presses([7.0, 7.0]) {
        text += &press.labels();
        for chip in CHIPS_MM {
            let near = press.near(chip, 60.0);
            let moved = 9.0 * press.depth_mm * near;
            for field in [
                moved * (press.x_mm - chip[0]) + 40.0 * press.shear_n * near,
                moved * (press.y_mm - chip[1]),
                -220.0 * press.depth_mm * near,
            ] {
                let _ = write!(text, ",{:.2}", field + 1.5 * noise.draw());
            }
        }
        text.push('\n');
    }
    text
}

/// Table of twelve taxels in four rows of three, in counts of 8 bits that decrease while a taxel is pressed.
pub(crate) fn capacitive() -> String {
    let mut noise = Noise(2);
    let mut text = LABELS.to_owned();
    for taxel in 0..12 {
        let _ = write!(text, ",taxel_{taxel}");
    }
    text.push('\n');
    for press in noise.presses([4.0, 6.0]) {
        text += &press.labels();
        for row in 0..4_u8 {
            for column in 0..3_u8 {
                let place = [
                    4.0 * (f64::from(column) - 1.0),
                    4.0 * (f64::from(row) - 1.5),
                ];
                let pressed = 1.0 - (-0.5 * press.force_n * press.near(place, 18.0)).exp();
                let count = 240.0 - 190.0 * pressed + 1.2 * noise.draw();
                let _ = write!(text, ",{:.0}", count.clamp(0.0, 255.0));
            }
        }
        text.push('\n');
    }
    text
}

#[expect(clippy::print_stderr, reason = "a program of its own")]
pub(crate) fn main() -> std::process::ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: draw_taxels FOLDER");
        return std::process::ExitCode::from(2);
    };
    for (name, text) in [("magnetic", magnetic()), ("capacitive", capacitive())] {
        let path = Path::new(&folder).join(name).join("presses.csv");
        if let Err(error) = std::fs::write(&path, text) {
            eprintln!("draw_taxels: {}: {error}", path.display());
            return std::process::ExitCode::from(3);
        }
    }
    std::process::ExitCode::SUCCESS
}
