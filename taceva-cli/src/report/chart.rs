//! A benchmark of kernels as a figure.

use std::io::{self, Write};

use taceva_report::{Race, RacePoint, race};
use taceva_study::bench::KernelBench;

/// Draws the benchmark of kernels that compute MAE, R² and sMAPE together. A line shows the lower bound of time.
pub(super) fn write(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    let rows = bench.rows.iter().filter(|row| row.scores != "mae");
    let points = rows.map(|row| RacePoint {
        name: match row.order_free {
            true => format!("{} (any order)", row.name),
            false => row.name.clone(),
        },
        gain: row.digits_min,
        cost: row.ns_per_pair.best,
        is_on_front: row.pareto,
    });
    let figure = race(&Race {
        title: "Summation kernels: time and correct digits".to_owned(),
        caption: format!(
            "{}; one thread; `any order`: the same bits in any order.",
            bench.machine.cpu
        ),
        gain: "correct digits, fewest over all inputs".to_owned(),
        cost: "ns a pair, MAE + R² + sMAPE".to_owned(),
        floor: Some((bench.floor.ns_per_pair.best, bench.floor.name.to_string())),
        points: points.collect(),
    });
    out.write_all(figure.svg().as_bytes())
}
