//! Benchmarks as tables: a row a candidate, the Pareto front marked.

use std::io::{self, Write};

use taceva_metrics::Better;
use taceva_study::bench::{KernelBench, KernelRow};

use super::latex::escape;
use super::text::table;

/// The names of the columns, with the direction of each number.
fn head() -> [String; 8] {
    let (lower, higher) = (Better::Lower, Better::Higher);
    [
        "scores".to_owned(),
        "kernel".to_owned(),
        lower.beside("ns/pair"),
        lower.beside("median"),
        lower.beside("× floor"),
        higher.beside("digits"),
        "order-free".to_owned(),
        "Pareto".to_owned(),
    ]
}

/// For people.
pub(super) fn text(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    let machine = &bench.machine;
    let load = machine
        .load
        .map_or_else(String::new, |load| format!(", load {load:.2} a core"));
    writeln!(out, "Ways to sum: time against right digits")?;
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
    table(head().each_ref().map(String::as_str), &cells(bench), out)?;
    writeln!(
        out,
        "\ndigits: the fewest right decimal digits of any score on any input; 17.3 is every bit"
    )?;
    for name in inputs(bench) {
        writeln!(out, "  {name}")?;
    }
    Ok(())
}

/// For programs that read tables.
pub(super) fn csv(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record([
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
    ])?;
    for row in &bench.rows {
        let thread = |pick: fn(&taceva_study::bench::Spread) -> f64| {
            let time = row.thread_ns_per_pair.as_ref().map(pick);
            time.map_or_else(String::new, |time| time.to_string())
        };
        writer.write_record([
            row.scores,
            &row.name,
            row.isa.as_deref().unwrap_or_default(),
            &row.ns_per_pair.best.to_string(),
            &row.ns_per_pair.median.to_string(),
            &thread(|time| time.best),
            &thread(|time| time.median),
            &row.times_floor.to_string(),
            &row.digits_min.to_string(),
            &row.order_free.to_string(),
            &row.pareto.to_string(),
        ])?;
    }
    writer.flush()
}

/// For pages.
pub(super) fn markdown(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "| {} |", head().join(" | "))?;
    writeln!(out, "|---|---|---:|---:|---:|---:|---|---|")?;
    for row in cells(bench) {
        writeln!(out, "| {} |", row.join(" | "))?;
    }
    writeln!(
        out,
        "\n{}, one thread, 6 channels × {} rows, best of {}; floor {:.3} ns a pair ({:.1} GB/s).",
        bench.machine.cpu,
        bench.rows_timed,
        bench.rounds,
        bench.floor.ns_per_pair.best,
        bench.floor.gb_per_s
    )
}

/// For papers.
pub(super) fn latex(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "% needs \\usepackage{{booktabs}}")?;
    writeln!(out, "\\begin{{tabular}}{{llrrrrll}}\n  \\toprule")?;
    let head = head().map(|name| escape(&name));
    writeln!(out, "  {} \\\\\n  \\midrule", head.join(" & "))?;
    for row in cells(bench) {
        writeln!(out, "  {} \\\\", row.map(|cell| escape(&cell)).join(" & "))?;
    }
    writeln!(out, "  \\bottomrule\n\\end{{tabular}}")
}

fn cells(bench: &KernelBench) -> Vec<[String; 8]> {
    let word = |yes: bool| if yes { "yes" } else { "" }.to_owned();
    let row = |row: &KernelRow| {
        [
            row.scores.to_owned(),
            row.name.clone(),
            format!("{:.3}", row.ns_per_pair.best),
            format!("{:.3}", row.ns_per_pair.median),
            format!("{:.2}", row.times_floor),
            format!("{:.1}", row.digits_min),
            word(row.order_free),
            word(row.pareto),
        ]
    };
    bench.rows.iter().map(row).collect()
}

/// For each input, the candidate that has fewest digits on it.
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
