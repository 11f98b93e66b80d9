//! Three thumbnails of a sensor from its recording: untouched gel, pressed gel, and the difference.

use taceva_dataset::{Dataset, Table};
use taceva_report::Triple;

use super::thumbnail::{MEDIA_TYPE, Small};

/// Maximum amplification of the difference.
const MOST_GAIN: i64 = 8;
/// Grey level that means no difference.
const MIDDLE: i64 = 128;

/// Pictures of a hard press in `dataset`, for the study at position `study`; `None` if no press has a frame.
pub(crate) fn triple(dataset: &Dataset, study: usize) -> anyhow::Result<Option<Triple>> {
    let Some((row, words)) = hard_press(dataset.table()) else {
        return Ok(None);
    };
    let Some(frame) = dataset.frame(row)? else {
        return Ok(None);
    };
    let pressed = Small::of(&frame);
    let recording = dataset.recording_of(row).map_or(dataset, |(own, _)| own);
    let untouched = recording.reference()?.map(|frame| Small::of(&frame));
    let untouched = untouched.filter(|untouched| untouched.is_like(&pressed));
    let all = untouched.iter().chain([&pressed]);
    let ends = all.flat_map(|small| &small.means);
    let scale = [ends.clone().min(), ends.max()].map(|end| end.copied().unwrap_or(0));
    let bytes = |small: &Small| small.jpeg(|mean| stretched(mean, scale));
    let (difference, gain) = match &untouched {
        Some(untouched) => difference(&pressed, untouched, scale)?,
        None => (None, 1.0),
    };
    Ok(Some(Triple {
        study,
        media_type: MEDIA_TYPE,
        untouched: untouched.as_ref().map(bytes).transpose()?,
        pressed: bytes(&pressed)?,
        difference,
        gain,
        words,
    }))
}

/// Row at the ninth decile of the positive normal forces, or of depths if there is no force, and its labels as text. The greatest value may be an
/// outlier. Presses of gratings are skipped, because they show a relief instead of the usual tip.
fn hard_press(table: &Table) -> Option<(usize, String)> {
    let channels = table.channels();
    let place = |name: &str| channels.iter().position(|channel| channel.name() == name);
    let chosen = place("Fz").or_else(|| place("Pz"))?;
    let is_shown = |row: &usize| table.frames()[*row].is_some() && table.kind()[*row].is_none();
    let presses = (0..table.rows())
        .filter(is_shown)
        .filter_map(|row| Some((row, table.truth(chosen).get(row)?)));
    let row = ninth_decile(presses.collect())?;
    let words: Vec<String> = ["Fz", "Pz"]
        .into_iter()
        .filter_map(|name| {
            let at = place(name)?;
            let value = table.truth(at).get(row)?;
            let unit = channels.iter().nth(at)?.unit();
            Some(format!(
                "{name} {}",
                taceva_report::FormattedValue::number(value, None).phrase(&format!(" {unit}"))
            ))
        })
        .collect();
    Some((row, format!("pressed with {}", words.join(", "))))
}

/// Row whose value is the ninth decile of the positive values, or of all values if none is positive.
fn ninth_decile(mut rows: Vec<(usize, f64)>) -> Option<usize> {
    rows.sort_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    let positive = rows.split_off(rows.partition_point(|(_, value)| *value <= 0.0));
    let rows = if positive.is_empty() { rows } else { positive };
    rows.get(rows.len() * 9 / 10).map(|(row, _)| *row)
}

/// Scales the brightness `mean`, so that the darkest value of all pictures becomes 0 and the brightest 255.
fn stretched(mean: i64, [low, high]: [i64; 2]) -> i64 {
    (mean - low) * 255 / (high - low).max(1)
}

/// Difference of the pictures, pressed minus untouched, in the scale of both. Amplified at most eight times, without clipping.
fn difference(
    pressed: &Small,
    untouched: &Small,
    scale: [i64; 2],
) -> anyhow::Result<(Option<Vec<u8>>, f64)> {
    let pairs = pressed.means.iter().zip(&untouched.means);
    let apart: Vec<i64> = pairs
        .map(|(one, other)| stretched(*one, scale) - stretched(*other, scale))
        .collect();
    let most = apart.iter().map(|apart| apart.abs()).max().unwrap_or(0);
    let gain = ((MIDDLE - 1) / most.max(1)).clamp(1, MOST_GAIN);
    let small = pressed.with_means(apart);
    let bytes = small.jpeg(|apart| (MIDDLE + apart * gain).clamp(0, 255))?;
    Ok((Some(bytes), gain as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outlier_is_no_typical_press() {
        let forces = (0..40_u32).map(|row| (row as usize, f64::from(row) / 10.0));
        let rows: Vec<(usize, f64)> = forces.chain([(40, 14.87), (41, -3.0)]).collect();
        assert_eq!(ninth_decile(rows), Some(37));
        assert_eq!(ninth_decile(vec![(0, -2.0), (1, -1.0)]), Some(1));
        assert_eq!(ninth_decile(Vec::new()), None);
    }
}
