//! Compares the columns other than channels in a table of samples with the same columns of the recording.

use taceva_core::{Field, shown};
use taceva_dataset::Dataset;
use taceva_results::Samples;

use super::is_same;
use crate::rows::BESIDE_CHANNELS;

/// Description of the first difference between `samples` and `rows` of `dataset` in columns that are not channels; `None` without a difference. A
/// table may lack some of these columns.
pub(super) fn other_columns(
    dataset: &Dataset,
    rows: &[usize],
    samples: &Samples,
) -> Option<String> {
    let is_joined = !dataset.recordings().is_empty();
    let fields = BESIDE_CHANNELS.into_iter().chain([Field::FrameDigest]);
    let mut fields = fields.filter(|field| samples.has(field.name()));
    fields.find_map(|field| {
        let name = field.name();
        let texts = dataset.table().as_text(name);
        // A joined recording is named after its folder, which may have another name here.
        let own = |text: &str| match (is_joined && field == Field::Point, text.split_once('/')) {
            (true, Some((_, own))) => own.to_owned(),
            _ => text.to_owned(),
        };
        rows.iter().enumerate().find_map(|(at, row)| {
            let expected = texts.as_ref().and_then(|texts| texts[*row].as_deref());
            let expected = expected.filter(|text| !text.is_empty());
            let (word, number) = (samples.word(name, at), samples.number(name, at));
            let is_equal = match (expected, word) {
                (Some(expected), Some(word)) => own(expected) == own(word),
                (Some(expected), None) => {
                    number.is_some() && is_same(number, expected.parse().ok())
                }
                (None, word) => word.is_none() && number.is_none(),
            };
            let found = || number.map(|number| format!("{number:?}"));
            (!is_equal).then(|| {
                format!(
                    "`{name}` in line {}: {} in the table, {} in the recording",
                    at + 2,
                    named(word.map(str::to_owned).or_else(found)),
                    named(expected.map(str::to_owned))
                )
            })
        })
    })
}

fn named(cell: Option<String>) -> String {
    cell.map_or_else(|| "none".to_owned(), |cell| format!("`{}`", shown(&cell)))
}
