//! Benchmarks as tables with one row for each candidate and marks for the Pareto front.

use std::io::{self, Write};

use taceva_metrics::Better;
use taceva_report::{Align, Column, Direction, Table};
use taceva_study::bench::KernelBench;

/// Writes the table as text.
pub(super) fn text(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    let machine = &bench.machine;
    let load = machine
        .load
        .map_or_else(String::new, |load| format!(", load {load:.2} a core"));
    writeln!(out, "Summation kernels: time and correct digits")?;
    writeln!(
        out,
        "machine  {}, {} of {} cores{load}",
        machine.cpu, machine.threads, machine.cores
    )?;
    writeln!(
        out,
        "columns  6 channels × {} rows, best and median of {}",
        bench.rows_timed, bench.rounds
    )?;
    writeln!(
        out,
        "floor    {}: {:.3} ns a pair, {:.1} GB/s\n",
        bench.floor.name, bench.floor.ns_per_pair.best, bench.floor.gb_per_s
    )?;
    out.write_all(rows(bench).text().as_bytes())?;
    writeln!(
        out,
        "\ndigits: the fewest correct decimal digits of any score on any input; 17.3 means every bit"
    )?;
    for name in inputs(bench) {
        writeln!(out, "  {name}")?;
    }
    Ok(())
}

/// Table of every number, for programs.
pub(super) fn every_number(bench: &KernelBench) -> Table {
    let names = [
        "scores",
        "kernel",
        "isa",
        "ns_per_pair_best",
        "ns_per_pair_median",
        "thread_ns_per_pair_best",
        "thread_ns_per_pair_median",
        "times_floor",
        "digits_min",
        "order_free",
        "pareto",
    ];
    let mut table = Table::new("Kernels", names);
    for row in &bench.rows {
        let thread = row.thread_ns_per_pair.as_ref();
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        table.push([
            row.scores.to_owned(),
            row.name.clone(),
            row.isa.clone().unwrap_or_default(),
            row.ns_per_pair.best.to_string(),
            row.ns_per_pair.median.to_string(),
            number(thread.map(|time| time.best)),
            number(thread.map(|time| time.median)),
            row.times_floor.to_string(),
            row.digits_min.to_string(),
            row.order_free.to_string(),
            row.pareto.to_string(),
        ]);
    }
    table
}

/// Table with one row for each kernel.
pub(super) fn rows(bench: &KernelBench) -> Table {
    let number = |name: &str, better: Better| {
        let column = Column::new(name).direction(Direction::Is(better));
        column.align(Align::Right)
    };
    let columns = [
        Column::new("scores"),
        Column::new("kernel"),
        number("ns/pair", Better::Lower),
        number("median", Better::Lower),
        number("× floor", Better::Lower),
        number("digits", Better::Higher),
        Column::new("order-free"),
        Column::new("Pareto"),
    ];
    let mut table = Table::new("", columns);
    let word = |yes: bool| if yes { "yes" } else { "" }.to_owned();
    for row in &bench.rows {
        table.push([
            row.scores.to_owned(),
            row.name.clone(),
            format!("{:.3}", row.ns_per_pair.best),
            format!("{:.3}", row.ns_per_pair.median),
            format!("{:.2}", row.times_floor),
            format!("{:.1}", row.digits_min),
            word(row.order_free),
            word(row.pareto),
        ]);
    }
    table
}

/// Same as [`rows`], with the conditions in a sentence below the table.
pub(super) fn for_pages(bench: &KernelBench) -> Table {
    let mut table = rows(bench);
    table.note(format!(
        "{}, one thread, 6 channels × {} rows, best of {}; floor {:.3} ns a pair ({:.1} GB/s).",
        bench.machine.cpu,
        bench.rows_timed,
        bench.rounds,
        bench.floor.ns_per_pair.best,
        bench.floor.gb_per_s
    ));
    table
}

/// Sentence for each input: the candidate with the fewest correct digits.
fn inputs(bench: &KernelBench) -> Vec<String> {
    let names = bench.rows.first().map_or(&[][..], |row| &row.digits);
    let worst = |position: usize| {
        let digits = bench
            .rows
            .iter()
            .map(|row| (row.digits[position].digits, &row.name));
        digits.min_by(|left, right| left.0.total_cmp(&right.0))
    };
    let lines = names.iter().enumerate().map(|(position, input)| {
        let worst = worst(position).map_or_else(String::new, |(digits, name)| {
            format!("worst {digits:.1} digits ({name})")
        });
        format!("{:<22} {worst}", input.input)
    });
    lines.collect()
}
