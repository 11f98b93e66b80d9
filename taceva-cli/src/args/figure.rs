//! Options for the size and the font of figures.

use clap::Args;
use taceva_report::FigureStyle;

/// Units of length with their values in mm: point (1/72 in), millimetre, centimetre and inch.
const LENGTHS: [(&str, f64); 4] = [("pt", 25.4 / 72.0), ("mm", 1.0), ("cm", 10.0), ("in", 25.4)];

/// Size and font of every figure file.
#[derive(Debug, Args)]
pub(crate) struct FigureArgs {
    /// The width of each figure file, such as 88mm, 3.5in or 250pt; panels use as many columns as fit [default: as drawn for a screen]
    #[arg(id = "figure_width", long = "figure-width", value_name = "LENGTH", value_parser = width_mm)]
    width_mm: Option<f64>,
    /// The preferred font family of SVG figures; PDF figures embed Arimo, which has the widths of Arial
    #[arg(id = "figure_font", long = "figure-font", value_name = "FAMILY")]
    font: Option<String>,
    /// The font size in figure files, such as 7pt [default: 8pt with --figure-width, else 11pt]
    #[arg(id = "figure_size", long = "figure-size", value_name = "LENGTH", value_parser = letters_pt)]
    letters_pt: Option<f64>,
}

impl FigureArgs {
    /// True if at least one option is set.
    pub(crate) fn is_set(&self) -> bool {
        self.width_mm.is_some() || self.font.is_some() || self.letters_pt.is_some()
    }

    /// The style that the arguments describe.
    pub(crate) fn style(&self) -> FigureStyle {
        FigureStyle {
            width_mm: self.width_mm,
            letters_pt: self.letters_pt,
            font: self.font.clone(),
        }
    }
}

fn width_mm(text: &str) -> Result<f64, String> {
    length_mm(text, [20.0, 1000.0], "88mm")
}

fn letters_pt(text: &str) -> Result<f64, String> {
    let millimetres = length_mm(text, [1.0, 20.0], "7pt")?;
    Ok(millimetres * 72.0 / 25.4)
}

/// Parses a length with its unit and returns it in mm. `ends` are the least and the greatest accepted length, mm.
fn length_mm(text: &str, ends: [f64; 2], example: &str) -> Result<f64, String> {
    let parts = LENGTHS.iter().find_map(|(unit, length_mm)| {
        let number = text.trim().strip_suffix(unit)?.trim_end();
        Some(number.parse::<f64>().ok()? * length_mm)
    });
    let [least, most] = ends;
    match parts {
        Some(length) if (least..=most).contains(&length) => Ok(length),
        Some(_) => Err(format!(
            "expected a length from {least} to {most} mm, such as {example}"
        )),
        None => Err(format!(
            "expected a number with pt, mm, cm or in, such as {example}"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units_and_ends() {
        assert_eq!(width_mm("88mm"), Ok(88.0));
        assert!(width_mm("3.5 in").is_ok_and(|length| (length - 88.9).abs() < 1e-9));
        assert!(letters_pt("7pt").is_ok_and(|size| (size - 7.0).abs() < 1e-9));
        for wrong in ["88", "mm", "-3mm", "NaNmm", "5mm", "2m", "infin"] {
            assert!(width_mm(wrong).is_err(), "{wrong}");
        }
    }
}
