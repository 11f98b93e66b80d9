//! TAC013: isolated labels far from all other labels.

use taceva_core::shown;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC013",
    name: "label-outliers",
    looks_for: "isolated labels more than 3 interquartile ranges beyond a quartile",
    hint: "look at these samples, whose transducer may have been overloaded or read during motion; drop them by [drop] of the map, or state why they are right",
    reads: None,
    find,
};

/// Remedy for a recording made by this program, which has no import map.
const OF_RECORDING: &str = "look at these samples: a transducer that was overloaded or read during motion gives such labels. State why they are right, or write the recording with `taceva export`, and import it without them by [drop] of its map.toml";

/// Distance of Tukey's outer fences from the quartiles, in interquartile ranges.
const FENCE: f64 = 3.0;
/// Minimum gap between outliers and other labels, as a fraction of the distance from the upper quartile to the greatest other label.
const GAP: f64 = 0.5;
/// Maximum frequency of outliers: one in this many labels. More values are a group.
const MOST: usize = 20;
/// Minimum number of values for quartiles.
const LEAST: usize = 20;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let mut found = Vec::new();
    for (position, channel) in table.channels().iter().enumerate() {
        let column = table.truth(position);
        let rows = (0..column.len()).filter_map(|row| Some((column.get(row)?, row)));
        let values: Vec<(f64, usize)> = rows.collect();
        let mirrored = values.iter().map(|(value, row)| (-value, *row)).collect();
        for (values, sign) in [(values.clone(), 1.0), (mirrored, -1.0)] {
            let Some(outliers) = above(values) else {
                continue;
            };
            let unit = channel.unit();
            let first = outliers.rows[0];
            let message = format!(
                "{channel}: {} of {} labels are more than 3 interquartile ranges beyond the quartiles, such as {} {unit} in sample {}; \
                 the next label is {} {unit}{}",
                outliers.rows.len(),
                column.len(),
                sign * outliers.least,
                shown(&table.samples()[first]),
                sign * outliers.next,
                drop_line(evidence, &outliers.rows),
            );
            let warning = evidence.found(Severity::Warning, message, &outliers.rows);
            found.push(match evidence.is_recording() {
                true => warning.with_hint(OF_RECORDING),
                false => warning,
            });
        }
    }
    found
}

/// Maximum number of pictures or rows in an import-map entry.
const LISTED: usize = 20;

/// Import-map entry that leaves out `rows`; empty if the rows were not imported.
fn drop_line(evidence: &Evidence<'_>, rows: &[usize]) -> String {
    let line = match pictures_of(evidence, rows) {
        Some(names) => Some(("frames_named", names)),
        None => numbers_of(evidence, rows).map(|numbers| ("rows", numbers)),
    };
    let Some((key, values)) = line else {
        return String::new();
    };
    let first = match values.len() > LISTED {
        true => format!("the first {LISTED} of "),
        false => String::new(),
    };
    let listed = values.into_iter().take(LISTED);
    format!(
        "; to leave {first}them out, write under [drop] of the map: {key} = [{}]",
        listed.collect::<Vec<_>>().join(", ")
    )
}

/// Pictures of `rows`, as an import map names them; `None` if the pictures are not single files, or if a row has several pictures.
fn pictures_of(evidence: &Evidence<'_>, rows: &[usize]) -> Option<Vec<String>> {
    let header = evidence.header;
    let pictures = header.mapping().pictures;
    let are_files = pictures
        .iter()
        .any(|own| matches!(own.by.as_str(), "column" | "pattern"));
    if !are_files || !header.views.is_empty() {
        return None;
    }
    let sources = evidence.table.source_frame();
    let names = rows.iter().map(|row| sources[*row].as_ref());
    names
        .map(|name| name.map(|name| format!("{name:?}")))
        .collect()
}

/// Numbers of `rows` in their tables, as an import map names them, with the table if there are several. `None` if a row has no such number.
fn numbers_of(evidence: &Evidence<'_>, rows: &[usize]) -> Option<Vec<String>> {
    let (tables, numbers) = (evidence.table.source_table(), evidence.table.source_row());
    let are_several = tables.windows(2).any(|pair| pair[0] != pair[1]);
    let number = |row: &usize| {
        let number = numbers[*row]? + 1;
        match are_several {
            true => {
                let table = tables[*row].as_ref()?;
                Some(format!("{{ row = {number}, table = {table:?} }}"))
            }
            false => Some(number.to_string()),
        }
    };
    rows.iter().map(number).collect()
}

/// Group of values far above all other values.
struct Outliers {
    /// Rows of the outliers, ordered by value.
    rows: Vec<usize>,
    /// Smallest outlier.
    least: f64,
    /// Greatest value below the outliers.
    next: f64,
}

/// Values above Tukey's outer fence and above a gap. The gap must exceed the interquartile range, and [`GAP`] times the distance from the upper
/// quartile to the gap. The second condition accepts long tails, such as a few presses with much shear.
fn above(mut values: Vec<(f64, usize)>) -> Option<Outliers> {
    if values.len() < LEAST {
        return None;
    }
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let quartile = |quarters: usize| values[(values.len() - 1) * quarters / 4].0;
    let range = quartile(3) - quartile(1);
    let fence = quartile(3) + FENCE * range;
    let is_gap = |pair: &[(f64, usize)]| {
        let [(below, _), (above, _)] = pair else {
            return false;
        };
        above - below > range.max(GAP * (below - quartile(3))) && *above > fence
    };
    let few = values.len() - values.len() / MOST;
    let apart = (few..values.len()).find(|at| is_gap(&values[at - 1..=*at]))? - 1;
    let outliers = &values[apart + 1..];
    (range > 0.0).then(|| Outliers {
        rows: outliers.iter().map(|(_, row)| *row).collect(),
        least: outliers[0].0,
        next: values[apart].0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(extra: &[f64]) -> Vec<(f64, usize)> {
        let usual = (0..200).map(|step| f64::from(step) * 0.025);
        usual.chain(extra.iter().copied()).zip(0..).collect()
    }

    #[test]
    fn one_force_of_15_newtons_above_5_is_found_with_its_row_and_its_neighbour() {
        let found = above(spread(&[14.87])).expect("an outlier");
        assert_eq!(found.rows, [200]);
        assert!((found.least - 14.87).abs() < 1e-12 && (found.next - 4.975).abs() < 1e-12);
    }

    #[test]
    fn a_long_tail_beside_a_narrow_middle_has_no_outliers_and_a_label_far_beyond_it_is_one() {
        // Three quarters of the presses have no shear, the others up to 0.6 N, with gaps wider than the middle.
        let still = (0..75).map(|row| f64::from(row) * 1e-5);
        let sheared = (1..=25).map(|row| 0.024 * f64::from(row));
        let values: Vec<(f64, usize)> = still.chain(sheared).zip(0..).collect();
        assert!(above(values.clone()).is_none());
        let with = [values, vec![(1.5, 100)]].concat();
        assert_eq!(above(with).expect("one").rows, [100]);
    }

    #[test]
    fn tails_without_a_gap_few_values_and_constants_are_no_outliers() {
        assert!(above(spread(&[])).is_none());
        let tail: Vec<f64> = (0..40).map(|step| 5.0 + f64::from(step) * 0.5).collect();
        assert!(above(spread(&tail)).is_none(), "a tail is no gap");
        assert!(above(vec![(0.0, 0), (0.1, 1), (900.0, 2)]).is_none());
        let still: Vec<(f64, usize)> = (0..50).map(|row| (1.0, row)).chain([(2.0, 50)]).collect();
        assert!(above(still).is_none(), "no range to measure by");
    }
}
