//! Time against right digits as SVG: who stands right and low is fast and right.

use std::io::{self, Write};

use taceva_study::bench::{KernelBench, KernelRow};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 460.0;
const MARGIN: f64 = 60.0;
/// Digits at the right edge: every bit of a binary64 and a little room.
const DIGITS: f64 = 18.0;

/// Draws the race for all three scores; the floor is a line.
pub(super) fn write(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    let rows: Vec<&KernelRow> = bench
        .rows
        .iter()
        .filter(|row| row.scores != "mae")
        .collect();
    let floor = bench.floor.ns_per_pair.best;
    let slowest = rows
        .iter()
        .map(|row| row.ns_per_pair.best)
        .fold(floor, f64::max);
    let scale = Scale {
        low: (floor / 1.5).ln(),
        high: (slowest * 1.5).ln(),
    };
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">"
    )?;
    writeln!(
        out,
        "<title>Time against right digits of ways to sum</title>"
    )?;
    writeln!(
        out,
        "<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>"
    )?;
    axes(&scale, out)?;
    let y = scale.y(floor);
    writeln!(
        out,
        "<line x1=\"{MARGIN}\" x2=\"{}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"#999\" stroke-dasharray=\"4 3\"/>",
        WIDTH - MARGIN
    )?;
    writeln!(
        out,
        "<text x=\"{MARGIN}\" y=\"{:.1}\" fill=\"#666\">floor: {} {floor:.2} ns</text>",
        y - 4.0,
        bench.floor.name
    )?;
    for row in rows {
        point(row, &scale, out)?;
    }
    writeln!(
        out,
        "<text x=\"{MARGIN}\" y=\"20\">{}; one thread; filled: on the Pareto front; square: the same bits in any order</text>",
        escape(&bench.machine.cpu)
    )?;
    writeln!(out, "</svg>")
}

struct Scale {
    low: f64,
    high: f64,
}

impl Scale {
    fn y(&self, nanoseconds: f64) -> f64 {
        let share = (nanoseconds.ln() - self.low) / (self.high - self.low);
        HEIGHT - MARGIN - share * (HEIGHT - 2.0 * MARGIN)
    }
}

fn x(digits: f64) -> f64 {
    MARGIN + digits.clamp(0.0, DIGITS) / DIGITS * (WIDTH - 2.0 * MARGIN)
}

fn axes(scale: &Scale, out: &mut dyn Write) -> io::Result<()> {
    let bottom = HEIGHT - MARGIN;
    for digits in (0..=18).step_by(3).map(f64::from) {
        let x = x(digits);
        writeln!(
            out,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{MARGIN}\" y2=\"{bottom}\" stroke=\"#eee\"/><text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{digits}</text>",
            bottom + 16.0
        )?;
    }
    for nanoseconds in [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0_f64] {
        if nanoseconds.ln() < scale.low || nanoseconds.ln() > scale.high {
            continue;
        }
        let y = scale.y(nanoseconds);
        writeln!(
            out,
            "<line x1=\"{MARGIN}\" x2=\"{}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"#eee\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{nanoseconds}</text>",
            WIDTH - MARGIN,
            MARGIN - 6.0,
            y + 4.0
        )?;
    }
    writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">right digits, fewest over all inputs</text>",
        WIDTH / 2.0,
        HEIGHT - 20.0
    )?;
    writeln!(
        out,
        "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">ns a pair, MAE + R² + sMAPE</text>",
        HEIGHT / 2.0
    )
}

fn point(row: &KernelRow, scale: &Scale, out: &mut dyn Write) -> io::Result<()> {
    let (x, y) = (x(row.digits_min), scale.y(row.ns_per_pair.best));
    let fill = if row.pareto { "#1f5fa8" } else { "white" };
    let style = format!("fill=\"{fill}\" stroke=\"#1f5fa8\"");
    if row.order_free {
        let (left, top) = (x - 4.5, y - 4.5);
        writeln!(
            out,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"9\" height=\"9\" {style}/>"
        )?;
    } else {
        writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" {style}/>")?;
    }
    // Names of what is nearly all right stand on the left of their points, where there is room.
    let (anchor, offset) = if row.digits_min > DIGITS / 2.0 {
        ("end", -9.0)
    } else {
        ("start", 9.0)
    };
    writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
        x + offset,
        y + 4.0,
        escape(&row.name)
    )
}

/// Text that XML prints as it stands.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
