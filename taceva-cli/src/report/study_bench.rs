//! Benchmarks of studies as tables with one row for each combination.

use taceva_core::counted;
use taceva_metrics::Better;
use taceva_report::{Column, Direction, FormattedValue, Table};
use taceva_results::not_measured;
use taceva_study::bench::{STUDY_CHANNELS, StudyBench, StudyTrial};

/// Cell without a value.
const NONE: &str = "–";

/// Table with one row for each combination.
pub(crate) fn rows(bench: &StudyBench) -> Table {
    let lower = |name: &str| Column::new(name).direction(Direction::Is(Better::Lower));
    let mut columns = vec![
        Column::new("points"),
        Column::new("folds"),
        Column::new("model"),
        lower("presses").unit("processor s"),
        lower("fits and scores").unit("processor s"),
        lower("all").unit("processor s"),
        Column::new("clusters"),
    ];
    columns.extend(STUDY_CHANNELS.iter().map(|channel| {
        let mut errors = bench.rows.iter().filter_map(|row| row.error(channel));
        Column {
            unit: errors.next().map(|error| error.unit.to_string()),
            ..lower(&format!("MAE {channel}"))
        }
    }));
    columns.extend([lower("mean width"), Column::new("front")]);
    if bench.seeds > 1 {
        let coverage = |channel: &&str| Column::new(format!("coverage {channel}"));
        columns.extend(STUDY_CHANNELS.iter().map(coverage));
    }
    let caption = format!("Studies of {} in scene {}", bench.study, bench.scene);
    let mut table = Table::new(caption, columns);
    for row in &bench.rows {
        let time = |time: Option<f64>| words(time, |time| format!("{time:.2}"));
        let mut cells = vec![
            row.variant.points.to_string(),
            folds(row),
            row.variant.model.clone(),
            time(row.press_cpu_s),
            time(row.assess_cpu_s),
            time(row.cpu_s()),
            words(row.clusters, |clusters| clusters.to_string()),
        ];
        cells.extend(STUDY_CHANNELS.iter().map(|channel| {
            words(row.error(channel), |error| {
                FormattedValue::number(error.mae, error.ci95).phrase("")
            })
        }));
        cells.push(words(row.mean_width, |width| format!("{width:.3}")));
        cells.push(if row.pareto { "yes" } else { NONE }.to_owned());
        if bench.seeds > 1 {
            cells.extend(STUDY_CHANNELS.iter().map(|channel| {
                let coverage = row.error(channel).and_then(|error| error.coverage);
                words(coverage, |coverage| {
                    let share = coverage.contained as f64 / coverage.intervals as f64;
                    FormattedValue::number(share, Some(coverage.ci95)).phrase("")
                })
            }));
        }
        table.push(cells);
    }
    if let Some(words) = not_measured(["simulated"]) {
        table.note(words);
    }
    let machine = &bench.machine;
    let load = words(machine.load, |load| format!("{load:.2}"));
    let seeds = match bench.seeds {
        1 => format!("Seed {}", bench.seed),
        seeds => format!("{} from {}", counted(seeds, "seed"), bench.seed),
    };
    table.note(format!(
        "{seeds}; {}, {} of {}, load {load} a core. Intervals of 95 % by contact point.",
        machine.cpu,
        machine.threads,
        counted(machine.cores, "core")
    ));
    table.note("mean width: mean of ln(upper end / lower end) over the channels; front: no other row has both less time and a lower mean width.");
    if bench.seeds > 1 {
        table.note("times and widths: means over the seeds. Errors: of the first seed. Coverage: share of the seeds whose interval contains the mean error of the other seeds, with its 95 % interval by Wilson.");
    }
    for row in &bench.rows {
        if let Some(why) = &row.failed {
            table.note(format!("{}: {why}", row.variant));
        }
    }
    table
}

fn folds(row: &StudyTrial) -> String {
    let folds = row.variant.folds;
    folds.map_or_else(|| "none".to_owned(), |folds| folds.to_string())
}

/// Text of `value`, or a dash.
fn words<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or_else(|| NONE.to_owned(), text)
}
