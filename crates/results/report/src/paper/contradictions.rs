//! Places in which the printed study contradicts itself, with the numbers on both sides.

use crate::catalogue::find;
use crate::number::fixed;
use crate::variables::VARIABLES;

/// The least and the greatest spacing of its gratings and their step, in micrometres, and the boards that its text counts.
const GRATINGS_UM: [u32; 3] = [250, 1750, 50];
const BOARDS: u32 = 72;
/// The light and the error of scene S4 in its text, as ratios to those of untouched light.
const LIGHT: f64 = 7.0;
const ERROR: f64 = 10.0;
/// Printed means of its table of lighting that differ from the mean of their rows, in percent.
const MEANS: [(&str, f64); 2] = [("Fxy", 9.3), ("Pxy", 5.0)];

/// Every contradiction, a sentence each.
pub(super) fn all() -> Vec<String> {
    let [least, most, step] = GRATINGS_UM;
    let boards = 2 * ((most - least) / step + 1);
    let mut said = vec![format!(
        "Its text counts {BOARDS} boards, while lines and dots of {} to {} mm in steps of {} mm make {boards}.",
        fixed(f64::from(least) / 1e3, 2),
        fixed(f64::from(most) / 1e3, 2),
        fixed(f64::from(step) / 1e3, 2),
    )];
    said.extend(light());
    said.extend(means());
    said
}

/// The error in bright light by its text and by its table.
fn light() -> Option<String> {
    let sensor = find("ViTacTip")?;
    let shares = VARIABLES
        .iter()
        .filter_map(|channel| sensor.result("r_light.scene:S4", channel));
    let errors: Vec<f64> = shares
        .map(|result| LIGHT / result.value)
        .filter(|error| error.is_finite())
        .collect();
    let [low, high] = crate::figure::extent(errors)?;
    Some(format!(
        "Its text says that errors of ViTacTip become about {} times as large in S4, where light is up to {} times as strong; by its own formula, the ratio of light over the ratio of errors, its Table IV says {} to {} times.",
        fixed(ERROR, 0),
        fixed(LIGHT, 0),
        fixed(low, 0),
        fixed(high, 0)
    ))
}

/// Means that are not those of their rows.
fn means() -> Option<String> {
    let sensor = find("ViTacTip")?;
    let of_rows = |channel: &str| {
        let rows = ["S1", "S2", "S3", "S4"].iter().filter_map(|scene| {
            let result = sensor.result(&format!("r_light.scene:{scene}"), channel)?;
            Some(result.value)
        });
        let rows: Vec<f64> = rows.collect();
        let count = u32::try_from(rows.len()).ok().filter(|count| *count > 0)?;
        Some(100.0 * rows.iter().sum::<f64>() / f64::from(count))
    };
    let words: Vec<String> = MEANS
        .iter()
        .filter_map(|(channel, printed)| {
            let mean = of_rows(channel)?;
            Some(format!(
                "{} % for {channel}, where its rows have the mean {} %",
                fixed(*printed, 1),
                fixed(mean, 2)
            ))
        })
        .collect();
    (!words.is_empty()).then(|| {
        format!(
            "Table IV prints the means of ViTacTip as {}.",
            words.join(", and ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_of_every_contradiction_are_said_with_their_numbers() {
        let said = all().join("\n");
        for part in [
            "72 boards",
            "0.25 to 1.75 mm in steps of 0.05 mm make 62",
            "96 to 412 times",
            "9.3 % for Fxy",
            "9.22 %",
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}
