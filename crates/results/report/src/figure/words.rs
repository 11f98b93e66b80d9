//! Axis labels and shortened names for figures.

use taceva_core::Unit;
use taceva_metrics::Better;

/// Axis label with the unit: `indentation depth (mm)`; without a unit for a ratio.
pub(crate) fn axis_label(name: &str, unit: Unit) -> String {
    match unit {
        Unit::One => name.to_owned(),
        unit => format!("{name} ({unit})"),
    }
}

/// Axis label with the better direction of `metric`: `MAE (mm) ↓`.
pub(crate) fn directed(label: &str, metric: &str) -> String {
    Better::of(metric).map_or_else(|| label.to_owned(), |better| better.beside(label))
}

/// `name`, shortened to `most` letters, without control characters.
pub(crate) fn short(name: &str, most: usize) -> String {
    let plain = || name.chars().filter(|letter| !letter.is_control());
    if plain().count() <= most {
        return plain().collect();
    }
    let start: String = plain().take(most.saturating_sub(1)).collect();
    format!("{start}…")
}

/// `name`, shortened to `most` letters by omitting the middle, because ids often differ at the end.
pub(crate) fn middle_cut(name: &str, most: usize) -> String {
    let letters: Vec<char> = name.chars().filter(|letter| !letter.is_control()).collect();
    if letters.len() <= most {
        return letters.into_iter().collect();
    }
    let kept = most.saturating_sub(1);
    let (start, end) = (
        &letters[..kept - kept / 2],
        &letters[letters.len() - kept / 2..],
    );
    start.iter().chain(&['…']).chain(end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_keep_both_ends() {
        assert_eq!(middle_cut("663e115541e9e2ec/12", 9), "663e…c/12");
        assert_eq!(middle_cut("663e", 9), "663e");
        assert_eq!(middle_cut("663e", 1), "…");
    }

    #[test]
    fn long_names_are_cut_and_say_so() {
        assert_eq!(short("GelSight\u{7}", 8), "GelSight");
        assert_eq!(short("GelSightWM", 8), "GelSigh…");
    }
}
