//! Checks the axes of signals against `[signals]`.

use super::SignalsMap;

impl SignalsMap {
    /// Checks that the axes of a row are in the stated order: taxel positions (rows, columns) before channels, or channels first. The positions, or all
    /// numbers, may share one axis. Axes of length 1 are ignored.
    ///
    /// # Errors
    /// Error message with the found shape, the expected shape, and the map key that would accept the found shape.
    pub(crate) fn check_axes(&self, shape: &[u64]) -> Result<(), String> {
        let info = self.spec.info;
        let [rows, columns, channels] = [info.rows, info.columns, info.channels].map(u64::from);
        let expected = shapes([rows, columns, channels], self.is_channel_first);
        let fits = |shapes: &[Vec<u64>]| shapes.iter().any(|own| is_alike(own, shape));
        if fits(&expected) {
            return Ok(());
        }
        let order = |is_channel_first| match is_channel_first {
            true => "order = \"channel-first\"",
            false => "order = \"place-first\"",
        };
        let turned = fits(&shapes([rows, columns, channels], !self.is_channel_first));
        let transposed = fits(&shapes([columns, rows, channels], self.is_channel_first));
        let mend = match (turned, transposed) {
            (true, _) => format!("; {} would fit it", order(!self.is_channel_first)),
            (_, true) => format!("; places = [{columns}, {rows}] would fit it"),
            _ => String::new(),
        };
        let mut expected: Vec<String> = expected.iter().map(|shape| said(shape)).collect();
        expected.dedup();
        let stated = match rows.saturating_mul(columns) > 1 && channels > 1 {
            true => format!(" and {}", order(self.is_channel_first)),
            false => String::new(),
        };
        Err(format!(
            "a row has the shape {}; places = [{rows}, {columns}] of {channels} number{}{stated} give {}{mend}",
            said(shape),
            if channels == 1 { "" } else { "s" },
            expected.join(" or ")
        ))
    }
}

/// Accepted shapes of a row.
fn shapes([rows, columns, channels]: [u64; 3], is_channel_first: bool) -> [Vec<u64>; 3] {
    let places = rows.saturating_mul(columns);
    let all = vec![places.saturating_mul(channels)];
    match is_channel_first {
        false => [vec![rows, columns, channels], vec![places, channels], all],
        true => [vec![channels, rows, columns], vec![channels, places], all],
    }
}

/// True if two shapes are equal except for axes of length 1.
fn is_alike(left: &[u64], right: &[u64]) -> bool {
    let sides = |shape: &[u64]| -> Vec<u64> {
        let long = shape.iter().copied().filter(|side| *side != 1);
        long.collect()
    };
    sides(left) == sides(right)
}

fn said(shape: &[u64]) -> String {
    let sides: Vec<String> = shape.iter().map(u64::to_string).collect();
    format!("({})", sides.join(", "))
}

#[cfg(test)]
mod tests {
    use taceva_core::{SignalInfo, SourceUnit, Unit};

    use super::*;
    use crate::import::map::SignalsFrom;
    use taceva_dataset::SignalsSpec;

    fn map(places: [u32; 2], channels: &[&str], is_channel_first: bool) -> SignalsMap {
        let count = u32::try_from(channels.len()).expect("few");
        let info = SignalInfo::new(places[0], places[1], count, Unit::Count).expect("few");
        let names = channels.iter().copied();
        SignalsMap {
            from: SignalsFrom::Columns(vec!["value".to_owned()]),
            unit: SourceUnit::parse("count").expect("known"),
            spec: SignalsSpec::new(info, names).expect("named"),
            placeholders: Vec::new(),
            is_channel_first,
            rest: Vec::new(),
        }
    }

    #[test]
    fn a_shape_is_what_the_map_says_with_places_on_two_axes_on_one_or_all_on_one() {
        let place_first = map([4, 3], &["x", "y"], false);
        for shape in [&[4, 3, 2][..], &[12, 2], &[24], &[1, 4, 3, 2], &[24, 1]] {
            assert_eq!(place_first.check_axes(shape), Ok(()), "{shape:?}");
        }
        let channel_first = map([4, 3], &["x", "y"], true);
        for shape in [&[2, 4, 3][..], &[2, 12], &[24]] {
            assert_eq!(channel_first.check_axes(shape), Ok(()), "{shape:?}");
        }
        let line = map([5, 1], &["x", "y", "z"], false);
        for shape in [&[5, 3][..], &[5, 1, 3], &[15]] {
            assert_eq!(line.check_axes(shape), Ok(()), "{shape:?}");
        }
        assert_eq!(map([4, 4], &["p"], false).check_axes(&[4, 4]), Ok(()));
        assert_eq!(map([1, 1], &["p"], false).check_axes(&[]), Ok(()));
    }

    #[test]
    fn what_does_not_fit_or_is_transposed_names_both_and_what_it_would_fit() {
        let place_first = map([4, 3], &["x", "y"], false);
        for (shape, words) in [
            (&[2, 4, 3][..], "order = \"channel-first\" would fit it"),
            (&[3, 4, 2], "places = [3, 4] would fit it"),
            (&[4, 6], "the shape (4, 6)"),
            (&[23], "the shape (23)"),
            (&[4, 3, 2, 2], "give (4, 3, 2) or (12, 2) or (24)"),
        ] {
            let problem = place_first.check_axes(shape).expect_err("refused");
            assert!(problem.contains(words), "{problem}");
            assert!(
                problem.contains("places = [4, 3] of 2 numbers"),
                "{problem}"
            );
        }
    }
}
