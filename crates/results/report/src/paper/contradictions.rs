//! Contradictions in the published study, each with both contradictory numbers.

use super::beside::SENSORS;
use crate::catalogue::find;
use crate::number::fixed;
use crate::variables::VARIABLES;

/// Least spacing, greatest spacing and step of the gratings in the TacEva study, in micrometres. [`BOARDS`] is the number of boards that its text
/// states.
const GRATINGS_UM: [u32; 3] = [250, 1750, 50];
const BOARDS: u32 = 72;
/// Radius of the indenter in the text of the TacEva study and in the caption of a figure, mm.
const INDENTER_MM: [f64; 2] = [2.0, 10.0];
/// Ratio of light in scene S4 to reference light, in the text of the TacEva study.
const LIGHT: f64 = 7.0;
const ERROR: f64 = 10.0;
/// Published means in the table of lighting that differ from the mean of their rows, in percent.
const MEANS: [(&str, f64); 2] = [("Fxy", 9.3), ("Pxy", 5.0)];

/// All contradictions, one sentence each.
pub(super) fn all() -> Vec<String> {
    let [least, most, step] = GRATINGS_UM;
    let boards = 2 * ((most - least) / step + 1);
    let mut said = vec![format!(
        "Its text counts {BOARDS} boards, while lines and dots of {} to {} mm in steps of {} mm make {boards}.",
        fixed(f64::from(least) / 1e3, 2),
        fixed(f64::from(most) / 1e3, 2),
        fixed(f64::from(step) / 1e3, 2),
    )];
    said.extend(gratings());
    said.extend(spatial());
    said.extend(light());
    said.extend(means());
    said.push(format!(
        "Its text gives the radius of the indenter as {} mm, the caption of a figure as {} mm.",
        fixed(INDENTER_MM[0], 0),
        fixed(INDENTER_MM[1], 0)
    ));
    said
}

/// Contradiction on gratings: success rates in the text are not between the rates of lines and dots in the figure.
fn gratings() -> Option<String> {
    let words = SENSORS.iter().filter_map(|name| {
        let sensor = find(name)?;
        let rate = |channel| Some(sensor.result("sr", channel)?.value);
        let (text, lines, dots) = (rate("all")?, rate("line")?, rate("dot")?);
        let is_between = (lines.min(dots)..=lines.max(dots)).contains(&text);
        let [text, lines, dots] = [text, lines, dots].map(|rate| fixed(100.0 * rate, 1));
        (!is_between).then(|| {
            format!(
                "{text} % for {name}, where the figure has {lines} % of lines and {dots} % of dots"
            )
        })
    });
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| {
        format!(
            "Its text gives success rates that are not between those of lines and dots in figure 3c: {}.",
            words.join("; ")
        )
    })
}

/// Contradiction on Fz over the surface: the table differs from the formula applied to the numbers of the figure.
fn spatial() -> Option<String> {
    let words = SENSORS.iter().filter_map(|name| {
        let sensor = find(name)?;
        let number = |metric| Some(sensor.result(metric, "Fz")?.value);
        let printed = number("r_spatial")?;
        let half = f64::midpoint(
            number("r_spatial.std_distance")?,
            number("r_spatial.std_depth")?,
        );
        (printed > 1.5 * half).then(|| {
            format!(
                "{} for {name}, and {} by figure 5",
                fixed(printed, 3),
                fixed(half, 3)
            )
        })
    });
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| {
        format!(
            "Its Table III is half the sum of the standard deviations of figure 5, but prints for Fz, in N: {}.",
            words.join("; ")
        )
    })
}

/// Contradiction on bright light: the error in the text differs from the error in the table.
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
        "Its text says that errors of ViTacTip become about {} times as large in S4, where light is up to {} times as strong. Its Table IV says {} to {} times by its own formula, the ratio of light over the ratio of errors.",
        fixed(ERROR, 0),
        fixed(LIGHT, 0),
        fixed(low, 0),
        fixed(high, 0)
    ))
}

/// Contradiction on means: published means differ from the means of their rows.
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
            "99.0 % for GelSight, where the figure has 96.1 % of lines and 98.1 % of dots",
            "0.109 for GelSight, and 0.037 by figure 5",
            "2 mm, the caption of a figure as 10 mm",
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
        assert!(!said.contains("for MagicTac, where"), "{said}");
    }
}
