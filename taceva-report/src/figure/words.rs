//! Names as figures print them.

use taceva_core::Unit;

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
    fn long_names_are_cut_and_say_so() {
        assert_eq!(short("GelSight\u{7}", 8), "GelSight");
        assert_eq!(short("GelSightWM", 8), "GelSigh…");
    }
}
