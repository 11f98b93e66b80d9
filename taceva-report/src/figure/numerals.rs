//! Numbers and names as figures print them.

use taceva_core::Unit;

/// A number with as many significant digits as a reader can use, and a true minus.
pub(crate) fn numeral(value: f64) -> String {
    let size = value.abs();
    if size <= 0.0 {
        return "0".to_owned();
    }
    let text = if !(1e-4..1e5).contains(&size) {
        format!("{size:.2e}")
    } else {
        let decimals = (0..8).find(|&decimals| size * 10_f64.powi(decimals) >= 99.5);
        let decimals = decimals.map_or(8, |decimals| decimals.unsigned_abs() as usize);
        let text = format!("{size:.decimals$}");
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    };
    if value < 0.0 {
        format!("−{text}")
    } else {
        text
    }
}

/// `indentation depth (mm)`; a ratio has no unit to name.
pub(crate) fn axis_label(name: &str, unit: Unit) -> String {
    match unit {
        Unit::One => name.to_owned(),
        unit => format!("{name} ({unit})"),
    }
}

/// `name`, cut to `most` letters: what is longer would leave its place. Control characters have no place in a picture.
pub(crate) fn short(name: &str, most: usize) -> String {
    let plain = || name.chars().filter(|letter| !letter.is_control());
    if plain().count() <= most {
        return plain().collect();
    }
    let start: String = plain().take(most.saturating_sub(1)).collect();
    format!("{start}…")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_no_idle_zeros() {
        let printed = [0.0, 12.0, 0.5, -0.012_34, 1234.4, 0.000_01, 250_000.0].map(numeral);
        assert_eq!(
            printed,
            ["0", "12", "0.5", "−0.0123", "1234", "1.00e-5", "2.50e5"]
        );
    }

    #[test]
    fn long_names_are_cut_and_say_so() {
        assert_eq!(short("GelSight\u{7}", 8), "GelSight");
        assert_eq!(short("GelSightWM", 8), "GelSigh…");
    }
}
